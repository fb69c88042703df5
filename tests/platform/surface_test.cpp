// SPDX-License-Identifier: MIT
#include "oiler/platform/surface.hpp"

#include <cfenv>
#include <cstdlib>
#include <filesystem>

#include <sys/resource.h>
#ifdef __SSE__
#include <xmmintrin.h>
#endif

#include "oiler/platform/providers.hpp"
#include "render/drawing.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

/// The control bits that affect sums: rounding, and whether subnormal numbers are flushed. The six
/// lowest bits of MXCSR are status flags.
unsigned arithmetic() {
    auto mode = static_cast<unsigned>(std::fegetround());
#ifdef __SSE__
    mode ^= _mm_getcsr() & ~0x3FU;
#endif
    return mode;
}

class Provider : public testing::TestWithParam<Offscreen> {
protected:
    [[nodiscard]] static std::string expected_name() {
        return GetParam() == Offscreen::osmesa ? "osmesa" : "egl";
    }
};

TEST_P(Provider, DrawsAPictureWithOpenGl33) {
    const auto studio = open_studio(GetParam());
    if (!studio) GTEST_SKIP() << expected_name() << " is not installed";
    EXPECT_EQ(studio->surface->provider(), expected_name());
    EXPECT_NE(studio->surface->procedure("glDrawElements"), nullptr);
    EXPECT_GE(studio->renderer.gl_version(), "3.3");
    EXPECT_FALSE(studio->renderer.gl_renderer().empty());
    EXPECT_EQ(total_coverage(studio->draw(Picture{}, {3, 2})), 0);
}

TEST_P(Provider, OpensAgainAndAgain) {
    Pixels first;
    for (int i = 0; i < 5; ++i) {
        const auto studio = open_studio(GetParam());
        if (!studio) GTEST_SKIP() << expected_name() << " is not installed";
        const Pixels pixels = studio->draw(rich_picture(), {160, 90});
        if (i == 0) first = pixels;
        EXPECT_EQ(pixels.rgb, first.rgb);
    }
}

TEST_P(Provider, DoesNotChangeTheArithmetic) {
    const unsigned before = arithmetic();
    const auto studio = open_studio(GetParam());
    if (!studio) GTEST_SKIP() << expected_name() << " is not installed";
    EXPECT_EQ(arithmetic(), before);
    static_cast<void>(studio->draw(rich_picture()));
    EXPECT_EQ(arithmetic(), before);
}

INSTANTIATE_TEST_SUITE_P(Offscreen, Provider, testing::Values(Offscreen::osmesa, Offscreen::egl),
                         [](const auto& chosen) {
                             return chosen.param == Offscreen::osmesa ? "osmesa" : "egl";
                         });

TEST(Automatic, SelectsAnInstalledProvider) {
    const auto studio = open_studio(Offscreen::automatic);
    if (!studio) GTEST_SKIP() << "neither OSMesa nor EGL is installed";
    const auto osmesa = open_studio(Offscreen::osmesa);
    EXPECT_EQ(studio->surface->provider(), osmesa ? "osmesa" : "egl");
}

void expect_no_window() {
    try {
        static_cast<void>(open_window({64, 36}, "test", Fit::none));
        EXPECT_TRUE(std::filesystem::exists("/dev/dri/card0")) << "an invisible window";
    } catch (const Error& error) {
        EXPECT_EQ(error.exit(), Exit::no_display);
        const std::string line = error.what();
        EXPECT_TRUE(holds(line, "--headless"));
        EXPECT_TRUE(holds(line, "no display"));
        EXPECT_FALSE(holds(line, "\n"));
    }
}

TEST(Window, WithoutADisplayNamesHeadless) {
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    unsetenv("SDL_VIDEODRIVER");
    // SDL falls back to an invisible driver only if this folder is set.
    setenv("XDG_RUNTIME_DIR", "/nonexistent", 1);
    expect_no_window();
    unsetenv("XDG_RUNTIME_DIR");
    expect_no_window();
}

TEST_P(Provider, IsRefusedWhereMesaWouldCrashForLackOfMemory) {
    const auto is_refused = [] {
        const rlimit limit{440 << 20, 440 << 20};
        setrlimit(RLIMIT_AS, &limit);
        return holds(line_of_error(Exit::no_display, [] { (void)open_offscreen(GetParam()); }),
                     "see `ulimit -v`");
    };
    EXPECT_EXIT(_exit(is_refused() ? 0 : 1), testing::ExitedWithCode(0), "");
}

TEST(Library, NamesThePackageToInstall) {
    const std::string line = line_of_error(Exit::no_display, [&] {
        const Library library("libOilerHasNoSuchThing.so.9", "install the Debian package x");
    });
    EXPECT_TRUE(holds(line, "libOilerHasNoSuchThing.so.9"));
    EXPECT_TRUE(holds(line, "install the Debian package x"));
}

TEST(Llvmpipe, IsLimitedUnlessTheUserSetsAWidth) {
    unsetenv("LP_NATIVE_VECTOR_WIDTH");
    unsetenv("LP_NUM_THREADS");
    limit_llvmpipe();
    EXPECT_EQ(std::getenv("LP_NUM_THREADS"), nullptr);
    EXPECT_STREQ(std::getenv("LP_NATIVE_VECTOR_WIDTH"), "256");
    setenv("LP_NATIVE_VECTOR_WIDTH", "128", 1);
    limit_llvmpipe();
    EXPECT_STREQ(std::getenv("LP_NATIVE_VECTOR_WIDTH"), "128");
}

}  // namespace
}  // namespace oiler::test
