// SPDX-License-Identifier: MIT
#include "house/rules.hpp"
#include "support/test.hpp"

namespace oiler::house {
namespace {

/// Whether the rule objects to `file` when `text` is the CMake file `cmake`.
bool is_uncompiled(const char* file, const char* cmake, const std::string& text) {
    return !find_uncompiled({file}, {"tests/sim/energy_test.cpp"}, {{cmake, text}}).empty();
}

TEST(HouseCompiles, FindsATestThatIsNotListed) {
    const char* cmake = "tests/CMakeLists.txt";
    EXPECT_FALSE(is_uncompiled("tests/sim/energy_test.cpp", cmake, ""));
    EXPECT_TRUE(is_uncompiled("tests/sim/sleep_test.cpp", cmake, ""));
    EXPECT_TRUE(is_uncompiled("tests/sim/sleep_test.cpp", cmake, "# oiler_test(sim sleep)\n"));
    EXPECT_TRUE(
        is_uncompiled("tests/sim/sleep_test.cpp", cmake, "add_executable(a sleep_test.cpp)"));
    EXPECT_TRUE(is_uncompiled("engine/oiler/sim/body.cpp", cmake, "body.cpp"));
    EXPECT_FALSE(is_uncompiled("engine/oiler/sim/body.hpp", cmake, ""));
}

TEST(HouseCompiles, AcceptsOptionalFilesThatCMakeNames) {
    const char* bench = "tests/bench/CMakeLists.txt";
    EXPECT_FALSE(is_uncompiled("tests/bench/main.cpp", bench, "add_executable(b main.cpp)"));
    EXPECT_TRUE(is_uncompiled("tests/bench/main.cpp", bench, "add_executable(b domain.cpp)"));
    EXPECT_TRUE(is_uncompiled("tests/bench/main.cpp", bench, "# add_executable(b main.cpp)\n"));
    EXPECT_TRUE(is_uncompiled("tests/bench/main.cpp", bench, "#[[\nmain.cpp\n]]\n"));
    EXPECT_TRUE(is_uncompiled("tests/fuzz/main.cpp", bench, "add_executable(b main.cpp)"));
    EXPECT_TRUE(is_uncompiled("tests/bench/main.cpp", "tests/CMakeLists.txt", "main.cpp"));
    EXPECT_FALSE(is_uncompiled("tests/bits/hash.cpp", "tests/bits/bits.cmake",
                               "set(sources ${CMAKE_CURRENT_LIST_DIR}/hash.cpp)"));
}

TEST(HouseCompiles, AcceptsFilesNamedByAVariable) {
    const char* bench = "tests/bench/CMakeLists.txt";
    const std::string peer = "target_sources(b PRIVATE peer_${name}.cpp)\n";
    EXPECT_FALSE(is_uncompiled("tests/bench/peer_ode.cpp", bench, peer + "oiler_peer(ode A::a)"));
    EXPECT_TRUE(is_uncompiled("tests/bench/peer_ode.cpp", bench, peer + "oiler_peer(gsl A::a)"));
    EXPECT_TRUE(is_uncompiled("tests/bench/peer_ode.cpp", bench, peer + "# oiler_peer(ode A::a)"));
}

}  // namespace
}  // namespace oiler::house
