// SPDX-License-Identifier: MIT
#include "oiler/whatif/aside.hpp"

#include <algorithm>
#include <iterator>
#include <system_error>
#include <utility>

#include "oiler/process/priority.hpp"

namespace oiler {

Aside::Aside(bool wants_thread) {
    if (wants_thread) try {
            thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
        } catch (const std::system_error&) {
        }
}

void Aside::begin(AlongFrom from) {
    const std::lock_guard lock(mutex_);
    if (from.may_repeat)
        figures_.begin_repeat();
    else
        figures_ = {};
    mail_.push_back({.from = std::move(from)});
    posted_.notify_one();
}

void Aside::add(const Recording::Event& event) {
    const std::lock_guard lock(mutex_);
    mail_.back().events.push_back(event);
}

LiveFigures Aside::play_until(std::int64_t steps, std::chrono::nanoseconds time) {
    std::unique_lock lock(mutex_);
    if (std::exchange(mail_.back().steps, steps) != steps) posted_.notify_one();
    if (!thread_.joinable()) {
        Clock::time_point now = Clock::now();
        share_.begin_frame(now);
        while (share_.has_time() && (has_work() || is_verdict_due(now))) {
            go_on(lock);
            const Clock::time_point before = std::exchange(now, Clock::now());
            share_.spend(now - before);
        }
        return figures_;
    }
    published_.wait_for(lock, time,
                        [&] { return figures_.played > steps || figures_.has_stopped; });
    return figures_;
}

void Aside::run(const std::stop_token& stop) {
    lower_priority_of_thread();
    std::unique_lock lock(mutex_);
    while (wait(lock, stop)) go_on(lock);
}

void Aside::go_on(std::unique_lock<std::mutex>& lock) {
    std::vector<Posted> posted(1);
    posted.back().steps = mail_.back().steps;
    posted.swap(mail_);
    lock.unlock();
    for (Posted& one : posted) take(std::move(one));
    const bool is_news = work();
    lock.lock();
    if (!is_news) return;
    if (mail_.size() == 1) figures_ = known();
    published_.notify_one();
}

bool Aside::has_work() const {
    return mail_.size() > 1 || next_ || (along_ && along_->is_behind(mail_.back().steps));
}

bool Aside::is_verdict_due(Clock::time_point now) const {
    return along_ && !along_->is_judged() && now >= next_verdict_;
}

bool Aside::wait(std::unique_lock<std::mutex>& lock, const std::stop_token& stop) {
    const auto has_any = [this] { return has_work(); };
    if (along_ && !along_->is_judged())
        posted_.wait_until(lock, stop, next_verdict_, has_any);
    else
        posted_.wait(lock, stop, has_any);
    return !stop.stop_requested();
}

void Aside::take(Posted posted) {
    if (posted.from) {
        next_ = std::move(posted);
    } else if (next_) {
        next_->steps = posted.steps;
        std::ranges::move(posted.events, std::back_inserter(next_->events));
    } else if (along_) {
        along_->has_come_to(posted.steps);
        for (const Recording::Event& event : posted.events) along_->add(event);
    }
}

bool Aside::goes_on_before_next() const {
    return next_->from->may_repeat && along_ && along_->is_behind() && along_->can_repeat() &&
           !has_player_input(next_->events);
}

bool Aside::work() {
    constexpr std::chrono::milliseconds time_of_verdict{100};
    bool is_news = false;
    if (next_ && !goes_on_before_next()) {
        along_ = std::make_unique<PlayAlong>(std::move(*next_->from), along_.get());
        Posted begun = *std::exchange(next_, std::nullopt);
        begun.from.reset();
        take(std::move(begun));
        is_news = true;
    }
    if (along_->is_behind() && along_->go_on()) is_news = true;
    if (const Clock::time_point now = Clock::now(); now >= next_verdict_) {
        along_->judge();
        next_verdict_ = now + time_of_verdict;
        is_news = true;
    }
    return is_news;
}

LiveFigures Aside::known() const {
    LiveFigures figures = along_->figures();
    if (next_) figures.begin_repeat();
    return figures;
}

}  // namespace oiler
