// SPDX-License-Identifier: MIT
// Tests the number of frames of a film, and its manifest.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "oiler/app/loops.hpp"
#include "oiler/core/error.hpp"
#include "support/folder.hpp"

namespace oiler::test {
namespace {

struct Walker {
    static constexpr About about{.name = "walker", .title = "Walker"};
    World world;
    explicit Walker(const Settings& settings) : world(1, settings) {
        (void)world.spawn(Body{.velocity = {1}});
    }
    Picture picture() const { return {}; }
};

Options options_for(int fps) {
    Options options;
    options.settings = {.stepping = {.method = &find_method("rk4"), .rate = {7}}, .seed = 11};
    options.headless = options.quiet = true;
    options.size = {16, 9};
    options.fps = fps;
    return options;
}

class Film : public testing::Test {
protected:
    /// Returns the manifest of a film. Skips the test without OSMesa and EGL.
    template <class G = Walker>
    nlohmann::json film(Options options, double seconds) {
        const Folder folder;
        options.out = folder / "film";
        AnyGameOf<G> game(options.settings);
        Recorder none({}, {}, game.world());
        Playback playback(game, none, Keep::hashes);
        About about = Walker::about;
        about.duration = seconds;
        LiveInput nobody;
        const MakeGame make = [](const Settings& settings) {
            return std::make_unique<AnyGameOf<G>>(settings);
        };
        EXPECT_EQ(run_headless(playback, nobody, options, about, make, nullptr), Exit::done);
        const auto manifest = nlohmann::json::parse(text_of(folder / "film/manifest.json"));
        EXPECT_EQ(names_in(folder / "film").size(), manifest["frames"].size() + 2);
        return manifest;
    }
    std::size_t frames(double seconds, int fps) {
        return film(options_for(fps), seconds)["frames"].size();
    }
    void SetUp() override {
        try {
            (void)open_offscreen(Offscreen::automatic);
        } catch (const Error& error) {
            GTEST_SKIP() << error.what();
        }
    }
};

// In double 0.29·100 is 28.999999999999996, and 0.07·100 is 7.000000000000001.
TEST_F(Film, HasTheFramesOfItsDuration) {
    EXPECT_EQ(frames(0.29, 100), 29U);
    EXPECT_EQ(frames(0.07, 100), 7U);
    EXPECT_EQ(frames(0.5, 30), 15U);
}

/// Leaves before its eighth step.
struct Leaver : Walker {
    using Walker::Walker;
    void update(const Input&, Loop& loop) {
        if (world.tick() == 7) loop.quit();
    }
};

// At 7 steps per second the eighth one would end at 8/7 s, before frame 12 of 10 per second.
TEST_F(Film, EndsWhenTheGameQuits) {
    const nlohmann::json manifest = film<Leaver>(options_for(10), 3);
    EXPECT_EQ(manifest["frames"].size(), 12U);
    EXPECT_EQ(manifest["frames"][11]["tick"], 7);
    EXPECT_EQ(manifest["finished"], true);
}

TEST_F(Film, HasAtLeastOneFrame) { EXPECT_EQ(frames(1e-9, 60), 1U); }

TEST_F(Film, HasTheFramesOfTheOption) {
    Options options = options_for(10);
    options.frames = 2;
    EXPECT_EQ(film(options, 1.1)["frames"].size(), 2U);
}

// Frame 28 shows 28/100 s. At 7 steps per second this is tick 1.96.
TEST_F(Film, ManifestHasTheFrameRateAndTheStepRate) {
    const auto manifest = film(options_for(100), 0.29);
    EXPECT_EQ(manifest["fps"], 100);
    EXPECT_EQ(manifest["rate"], 7);
    EXPECT_EQ(manifest["frames"][28]["tick"], 1);
    EXPECT_EQ(manifest["frames"][28]["alpha"], 0.96);
}

TEST_F(Film, HasAManifestOfItsOptions) {
    Options options = options_for(60);
    options.fps.reset();
    options.settings.stepping.precision = Precision::single;
    const auto manifest = film(options, 1 / 60.0);
    EXPECT_EQ(manifest["fps"], 60) << "if not given";
    EXPECT_EQ(manifest["width"], 16);
    EXPECT_EQ(manifest["height"], 9);
    EXPECT_EQ(manifest["method"], "rk4");
    EXPECT_EQ(manifest["precision"], "float");
    EXPECT_EQ(manifest["scene"], "walker");
    EXPECT_EQ(manifest["seed"], 11);
}

}  // namespace
}  // namespace oiler::test
