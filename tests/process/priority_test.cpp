// SPDX-License-Identifier: MIT
#include "oiler/process/priority.hpp"

#include "support/test.hpp"

#include <sys/resource.h>
#include <thread>

namespace oiler::test {
namespace {

int nice() { return getpriority(PRIO_PROCESS, 0); }

TEST(Priority, IsLowerForOneThreadAlone) {
    const int before = nice();
    int lowered = 0;
    std::thread([&] {
        lower_priority_of_thread();
        lowered = nice();
    }).join();
    EXPECT_EQ(lowered, std::max(before, 10));
    EXPECT_EQ(nice(), before);
}

}  // namespace
}  // namespace oiler::test
