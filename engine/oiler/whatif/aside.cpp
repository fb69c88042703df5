// SPDX-License-Identifier: MIT
#include "oiler/whatif/aside.hpp"

#include <utility>

namespace oiler {

Aside::Aside() : thread_([this](const std::stop_token& stop) { run(stop); }) {}

void Aside::begin(AlongFrom from) {
    const std::lock_guard lock(mutex_);
    mail_ = {.from = std::move(from)};
    figures_ = {};
    posted_.notify_one();
}

void Aside::add(const Recording::Event& event) {
    const std::lock_guard lock(mutex_);
    mail_.events.push_back(event);
}

LiveFigures Aside::play_until(std::int64_t steps, std::chrono::nanoseconds time) {
    std::unique_lock lock(mutex_);
    if (std::exchange(mail_.steps, steps) != steps) posted_.notify_one();
    published_.wait_for(lock, time,
                        [&] { return figures_.played > steps || figures_.has_stopped; });
    return figures_;
}

void Aside::run(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (wait(lock, stop)) {
        Posted posted{.from = std::exchange(mail_.from, std::nullopt),
                      .events = std::exchange(mail_.events, {}),
                      .steps = mail_.steps};
        lock.unlock();
        work(std::move(posted));
        lock.lock();
        if (!mail_.from) figures_ = along_->figures();
        published_.notify_one();
    }
}

bool Aside::wait(std::unique_lock<std::mutex>& lock, const std::stop_token& stop) {
    const auto has_work = [&] { return mail_.from || (along_ && along_->is_behind(mail_.steps)); };
    if (along_ && !along_->is_judged())
        posted_.wait_until(lock, stop, next_verdict_, has_work);
    else
        posted_.wait(lock, stop, has_work);
    return !stop.stop_requested();
}

void Aside::work(Posted posted) {
    constexpr std::chrono::milliseconds time_of_verdict{100};
    if (posted.from) along_ = std::make_unique<PlayAlong>(std::move(*posted.from), along_.get());
    for (const Recording::Event& event : posted.events) along_->add(event);
    along_->has_come_to(posted.steps);
    if (along_->is_behind(posted.steps)) along_->take_step();
    if (const Clock::time_point now = Clock::now(); now >= next_verdict_) {
        along_->judge();
        next_verdict_ = now + time_of_verdict;
    }
}

}  // namespace oiler
