// SPDX-License-Identifier: MIT
#include "oiler/core/beside.hpp"

#include <gtest/gtest.h>
#include <pthread.h>

#include <chrono>
#include <cstddef>
#include <stdexcept>
#include <thread>

namespace oiler::test {
namespace {

/// While it lives, no thread can start: none has room for its stack.
class NoThreads {
public:
    NoThreads() {
        pthread_getattr_default_np(&before_);
        pthread_attr_t huge = before_;
        pthread_attr_setstacksize(&huge, std::size_t{1} << 47);
        pthread_setattr_default_np(&huge);
    }
    ~NoThreads() { pthread_setattr_default_np(&before_); }
    NoThreads(const NoThreads&) = delete;
    NoThreads& operator=(const NoThreads&) = delete;

private:
    pthread_attr_t before_;
};

TEST(CallBeside, CallsOnAThreadThatIsJoined) {
    std::thread::id called;
    {
        std::jthread thread;
        const auto result = call_beside(thread, [&called] {
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
            called = std::this_thread::get_id();
        });
    }
    EXPECT_NE(called, std::thread::id());
    EXPECT_NE(called, std::this_thread::get_id());
}

TEST(CallBeside, CallsAtOnceWhereNoThreadStarts) {
    const NoThreads none;
    std::jthread thread;
    std::future<std::thread::id> result =
        call_beside(thread, [] { return std::this_thread::get_id(); });
    EXPECT_FALSE(thread.joinable());
    EXPECT_EQ(result.get(), std::this_thread::get_id());
}

TEST(CallBeside, HandsOverWhatIsThrown) {
    std::jthread thread;
    std::future<void> result = call_beside(thread, [] { throw std::runtime_error("no"); });
    EXPECT_THROW(result.get(), std::runtime_error);
}

}  // namespace
}  // namespace oiler::test
