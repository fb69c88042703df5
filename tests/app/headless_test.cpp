// SPDX-License-Identifier: MIT
// Tests the number of frames of a film, and its manifest.
#include <nlohmann/json.hpp>

#include "oiler/app/run_game.hpp"
#include "support/folder.hpp"
#include "support/test.hpp"

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
    nlohmann::json film(Options options, double seconds, Profile* profile = nullptr) {
        const Folder folder;
        options.out = folder / "film";
        AnyGameOf<G> game(options.settings);
        TraceWriter none({}, {}, game.world());
        Playback playback(game, none, Keep::hashes, profile);
        About about = Walker::about;
        about.duration = seconds;
        LiveInput nobody;
        const MakeGame make = [](const Settings& settings) {
            return std::make_unique<AnyGameOf<G>>(settings);
        };
        GameRun run{.options = options,
                    .about = about,
                    .make = make,
                    .playback = playback,
                    .live = nobody,
                    .inputs = nobody,
                    .profile = profile};
        EXPECT_EQ(run_headless(run), Exit::done);
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

// Frame i of 3 per second shows 7·i/3 steps.
TEST_F(Film, ProfilesEachStageOfEachFrame) {
    Options options = options_for(3);
    options.inspector = true;
    const Folder folder;
    options.sheet = folder / "sheet.png";
    Profile profile;
    film(options, 4 / 3.0, &profile);
    std::map<std::string, int> spans;
    std::vector<double> shown;
    const auto events = nlohmann::json::parse(profile.to_json()).at("traceEvents");
    for (const auto& event : events)
        if (event.at("ph") == "X")
            ++spans[event.at("name")];
        else
            shown.push_back(event.at("args").at("shown step"));
    EXPECT_EQ(shown, (std::vector<double>{0, 2 + 1 / 3.0, 4 + 2 / 3.0, 7}));
    EXPECT_GE(spans["step"], 3);
    EXPECT_GE(spans["picture"], 4);
    for (const char* stage : {"frame", "play along", "inspector", "draw", "read", "sheet",
                              "hand over", "encode", "write", "record"})
        EXPECT_EQ(spans[stage], 4) << stage;
    EXPECT_EQ(spans["hash"], 8) << "of the state, and of the pixels";
    const auto is_frame = [](const nlohmann::json& event) { return event["name"] == "frame"; };
    const auto in_frame = [&](const nlohmann::json& event) {
        const double begin = event.at("ts");
        return std::ranges::any_of(events, [&](const nlohmann::json& frame) {
            return is_frame(frame) && frame.at("ts") <= begin &&
                   frame.at("ts").get<double>() + frame.at("dur").get<double>() >=
                       begin + event.at("dur").get<double>();
        });
    };
    const auto thread = std::ranges::find_if(events, is_frame)->at("tid");
    for (const auto& event : events)
        if (event.at("ph") == "X" && event.at("tid") == thread) {
            EXPECT_TRUE(in_frame(event)) << event.at("name");
        }
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
