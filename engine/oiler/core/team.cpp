// SPDX-License-Identifier: MIT
#include "oiler/core/team.hpp"

#include <system_error>

#include "oiler/core/error.hpp"

namespace oiler {
namespace {

constexpr int spins = 4000;

void pause() {
#if defined(__x86_64__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    __asm__ volatile("yield");
#endif
}

/// Waits until the number differs from `old` and returns it.
std::uint32_t await_change(const std::atomic<std::uint32_t>& number, std::uint32_t old) {
    for (int i = 0; i < spins; ++i) {
        const std::uint32_t now = number.load(std::memory_order_acquire);
        if (now != old) return now;
        pause();
    }
    number.wait(old, std::memory_order_acquire);
    return number.load(std::memory_order_acquire);
}

}  // namespace

Team::Team(std::size_t size, bool required) {
    start_threads(threads_, size - 1, [this](std::size_t i) { wait_for_work(i + 1); });
    if (this->size() == size || !required) return;
    run_parts(nullptr, nullptr);
    for (std::thread& thread : threads_) thread.join();
    fail(Exit::usage, "{} threads: this machine gives {}; take fewer", size, this->size());
}

Team::~Team() {
    run_parts(nullptr, nullptr);
    for (std::thread& thread : threads_) thread.join();
}

void Team::run_parts(Part call, const void* work) {
    const std::lock_guard lock(one_at_a_time_);
    call_ = call;
    work_ = work;
    unfinished_.store(static_cast<std::uint32_t>(threads_.size()), std::memory_order_relaxed);
    started_.fetch_add(1, std::memory_order_release);
    started_.notify_all();
    if (call == nullptr) return;
    call(work, 0);
    for (std::uint32_t left = unfinished_.load(std::memory_order_acquire); left != 0;)
        left = await_change(unfinished_, left);
}

void Team::wait_for_work(std::size_t part) {
    for (std::uint32_t seen = 0;;) {
        seen = await_change(started_, seen);
        if (call_ == nullptr) return;
        call_(work_, part);
        if (unfinished_.fetch_sub(1, std::memory_order_release) == 1) unfinished_.notify_one();
    }
}

}  // namespace oiler
