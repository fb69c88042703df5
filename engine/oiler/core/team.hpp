// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace oiler {

/// Starts threads that call f(index) until there are `count`, or as many as the machine gives.
template <class Thread, class F>
void start_threads(std::vector<Thread>& threads, std::size_t count, F f) {
    try {
        while (threads.size() < count) threads.emplace_back(f, threads.size());
    } catch (const std::system_error&) {
    }
}

/// Threads for short pieces of work. Between two pieces they spin for some tens of microseconds,
/// because waking a thread takes longer than most pieces. Then they sleep, so that an idle team
/// uses no core.
class Team {
public:
    /// `size` threads, including the caller of `run`. If the machine gives fewer, has those or, if
    /// they are `required`, throws Error{usage}.
    explicit Team(std::size_t size, bool required = true);
    ~Team();
    Team(const Team&) = delete;
    Team& operator=(const Team&) = delete;

    [[nodiscard]] std::size_t size() const { return threads_.size() + 1; }

    /// Calls work(part) for each part from 0 to size() − 1, each on its own thread, and returns
    /// when all are done. `work` must not throw.
    template <class Work>
    void run(const Work& work) {
        run_parts([](const void* it, std::size_t part) { (*static_cast<const Work*>(it))(part); },
                  &work);
    }

private:
    using Part = void (*)(const void* work, std::size_t part);

    void run_parts(Part call, const void* work);
    void wait_for_work(std::size_t part);

    std::mutex one_at_a_time_;
    Part call_ = nullptr;
    const void* work_ = nullptr;
    alignas(64) std::atomic<std::uint32_t> started_{0};     ///< number of pieces
    alignas(64) std::atomic<std::uint32_t> unfinished_{0};  ///< parts of the current piece
    std::vector<std::thread> threads_;
};

}  // namespace oiler
