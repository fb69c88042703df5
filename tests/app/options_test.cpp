// SPDX-License-Identifier: MIT
#include "oiler/app/options.hpp"

#include "capture/captures.hpp"
#include "support/folder.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr About about{.name = "demo", .title = "A demo", .rate = 50};

CommandLine parse(const std::string& words) {
    std::istringstream stream("demo " + words);
    std::vector<std::string> list;
    for (std::string word; stream >> word;) list.push_back(word);
    std::vector<char*> argv;
    for (std::string& word : list) argv.push_back(word.data());
    return parse_command_line(static_cast<int>(argv.size()), argv.data(), about);
}

TEST(Options, AreTheGamesOwnUnlessGiven) {
    const Options options = parse("").options;
    EXPECT_EQ(options.settings.stepping.rate, Rate{50});
    EXPECT_EQ(options.settings.stepping.method->name, "semi_implicit_euler");
    EXPECT_EQ(options.settings.stepping.precision, Precision::double_);
    EXPECT_EQ(options.size, (Size{1280, 720}));
    EXPECT_EQ(options.settings.seed, 0U);
    EXPECT_EQ(options.settings.threads, 1);
    EXPECT_FALSE(options.settings.stepping.damping);
    EXPECT_EQ(options.out, "frames/demo");
    EXPECT_FALSE(options.headless);
    EXPECT_FALSE(options.frames || options.fps || options.steps);
}

TEST(Options, AreReadAsGiven) {
    const Options options =
        parse(
            "--headless --surface egl --frames 7 --fps 30 --size 641x3 --out o --method "
            "explicit_euler --rate 1000000 --precision float --seed 18446744073709551615 "
            "--threads 3 --damping drift --trace t.csv --energy e.csv --json - --quiet")
            .options;
    EXPECT_TRUE(options.headless);
    EXPECT_EQ(options.offscreen, Offscreen::egl);
    EXPECT_EQ(options.frames, 7);
    EXPECT_EQ(options.fps, 30);
    EXPECT_EQ(options.size, (Size{641, 3}));
    EXPECT_EQ(options.out, "o");
    EXPECT_EQ(options.settings.stepping.method->name, "explicit_euler");
    EXPECT_EQ(options.settings.stepping.rate, Rate{1'000'000});
    EXPECT_EQ(options.settings.stepping.precision, Precision::single);
    EXPECT_EQ(options.settings.seed, ~std::uint64_t{0});
    EXPECT_EQ(options.settings.threads, 3);
    EXPECT_EQ(options.settings.stepping.damping, Damping::in_drift);
    EXPECT_EQ(options.trace, "t.csv");
    EXPECT_EQ(options.energy, "e.csv");
    EXPECT_EQ(options.json, "-");
    EXPECT_TRUE(options.quiet);
}

// The other values of the words above, and the largest allowed numbers.
TEST(Options, AreReadUpToTheirLimits) {
    const Options options =
        parse(
            "--headless --surface osmesa --frames 1000000 --fps 1000 --size 16384x1 "
            "--precision double --threads 256 --damping kick")
            .options;
    EXPECT_EQ(options.offscreen, Offscreen::osmesa);
    EXPECT_EQ(options.frames, 1'000'000);
    EXPECT_EQ(options.fps, 1000);
    EXPECT_EQ(options.size, (Size{16384, 1}));
    EXPECT_EQ(options.settings.stepping.precision, Precision::double_);
    EXPECT_EQ(options.settings.threads, 256);
    EXPECT_EQ(options.settings.stepping.damping, Damping::in_kick);
    EXPECT_EQ(parse("--steps 1000000000000").options.steps, 1'000'000'000'000);
}

TEST(Options, ALeadingZeroIsNoOctal) {
    EXPECT_EQ(parse("--rate 010").options.settings.stepping.rate, Rate{10});
}

CommandLine parse_file(std::vector<std::string> words) {
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    return parse_command_line(static_cast<int>(argv.size()), argv.data(), about,
                              [](const std::string& path, const std::optional<Manifest>&) {
                                  EXPECT_EQ(path, "some scene.toml");
                                  return About{.name = "scene",
                                               .title = "A scene",
                                               .rate = 7,
                                               .method = "rk4",
                                               .precision = Precision::single,
                                               .duration = 12,
                                               .damping = "kick"};
                              });
}

TEST(Options, AreThoseOfTheSceneUnlessGiven) {
    const CommandLine own = parse_file({"demo", "some scene.toml"});
    EXPECT_EQ(own.about.name, "scene");
    EXPECT_EQ(own.about.duration, 12);
    EXPECT_EQ(own.options.settings.stepping.rate, Rate{7});
    EXPECT_EQ(own.options.settings.stepping.method->name, "rk4");
    EXPECT_EQ(own.options.settings.stepping.precision, Precision::single);
    EXPECT_EQ(own.options.settings.stepping.damping, Damping::in_kick);
    EXPECT_EQ(own.options.out, "frames/scene");
    const Settings given = parse_file({"demo", "--rate", "8", "--method", "exact", "--damping",
                                       "drift", "some scene.toml", "--precision", "double"})
                               .options.settings;
    EXPECT_EQ(given.stepping.rate, Rate{8});
    EXPECT_EQ(given.stepping.method->name, "exact");
    EXPECT_EQ(given.stepping.precision, Precision::double_);
    EXPECT_EQ(given.stepping.damping, Damping::in_drift);
    EXPECT_TRUE(holds(parse_file({"demo", "--help"}).text, "SCENE"));
}

TEST(Options, AreThoseOfTheManifestUnlessGiven) {
    const Folder folder;
    Manifest manifest = Film{}.header;
    manifest.scene = about.name;
    manifest.planned_frames = 9;
    put(folder / "m", to_json(manifest));
    const std::string from = "--headless --from " + (folder / "m").string();
    const Options all = parse(from).options;
    EXPECT_EQ(all.frames, 9);
    EXPECT_EQ(all.fps, 10);
    EXPECT_EQ(all.size, (Size{10, 10}));
    EXPECT_EQ(all.settings.stepping.rate, Rate{30});
    EXPECT_EQ(all.settings.stepping.method->name, "rk4");
    const Options given = parse(from + " --frames 8 --fps 7 --size 6x5 --rate 4").options;
    EXPECT_EQ(given.frames, 8);
    EXPECT_EQ(given.fps, 7);
    EXPECT_EQ(given.size, (Size{6, 5}));
    EXPECT_EQ(given.settings.stepping.rate, Rate{4});
}

TEST(Options, HelpAndVersionAreText) {
    EXPECT_TRUE(holds(parse("--help").text, "--headless"));
    EXPECT_EQ(parse("--version").text.rfind("demo ", 0), 0U);
}

TEST(Options, MayNeedTheStepsOfARunOrItsSetting) {
    EXPECT_EQ(no_way_back(parse("--steps 3 --json -").options), "");
    EXPECT_EQ(no_way_back(parse("--steps 3 --energy e --trace t").options), "--trace");
    EXPECT_EQ(no_way_back(parse("--steps 3 --trace t --record r").options), "--record");
    EXPECT_EQ(fixing_option(parse("--steps 3 --profile p").options), "");
    EXPECT_EQ(why_fixed(parse("--steps 3 --profile p").options, about), "");
    EXPECT_EQ(why_fixed(parse("--steps 3 --record r --json j").options, about),
              "--json keeps this setting.");
    EXPECT_EQ(why_fixed(parse("--steps 3 --energy e").options, about),
              "--energy keeps this setting.");
    About fixed = about;
    fixed.fixed_setting = "Keys choose it.";
    EXPECT_EQ(why_fixed(parse("--steps 3 --json j").options, fixed), "Keys choose it.");
}

TEST(Options, TheLineIsOfAWindow) {
    EXPECT_FALSE(parse("").options.no_line);
    EXPECT_TRUE(parse("--no-line").options.no_line);
    for (const char* run : {"--no-line --headless", "--no-line --steps 3"})
        EXPECT_THROW((void)parse(run), Error) << run;
}

// Each option that writes a file is compared with each other one.
TEST(Options, WriteFilesOfTheirOwn) {
    const std::vector<std::string> outputs{"--record", "--video",  "--sheet", "--junit",
                                           "--trace",  "--energy", "--json",  "--profile"};
    for (const std::string& one : outputs)
        for (const std::string& other : outputs) try {
                if (one == other) continue;
                (void)parse("--headless --golden g --update-golden --force " + one + " f.mp4 " +
                            other + " ./f.mp4");
                ADD_FAILURE() << one << " and " << other;
            } catch (const Error& error) {
                const std::string line = error.what();
                EXPECT_TRUE(line.find("both write") != line.npos ||
                            line.find("--junit: --update-golden writes g only") != line.npos)
                    << line;
            }
}

struct Wrong {
    const char* words;
    const char* named;  ///< text that the message must have

    friend void PrintTo(const Wrong& wrong, std::ostream* out) { *out << wrong.words; }
};

class WrongOptions : public testing::TestWithParam<Wrong> {};

TEST_P(WrongOptions, AreRefusedInOneLineThatNamesThem) {
    const std::string line = line_of_error(Exit::usage, [&] { (void)parse(GetParam().words); });
    EXPECT_TRUE(holds(line, GetParam().named));
    EXPECT_FALSE(holds(line, "\n"));
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongOptions,
    testing::Values(
        Wrong{"--frobnicate", "--frobnicate"}, Wrong{"stray", "stray"}, Wrong{"--rate 0", "--rate"},
        Wrong{"--rate -5", "--rate"}, Wrong{"--rate 1000001", "--rate"},
        Wrong{"--rate 1.5", "--rate"}, Wrong{"--rate", "--rate"}, Wrong{"--fps 0", "--fps"},
        Wrong{"--fps 1001", "--fps"}, Wrong{"--frames 0", "--frames"},
        Wrong{"--frames x", "--frames"}, Wrong{"--steps -1", "--steps"},
        Wrong{"--size 99999x1", "99999x1"}, Wrong{"--size 0x10", "0x10"},
        Wrong{"--size 640", "--size"}, Wrong{"--size 640x", "--size"},
        Wrong{"--size x480", "--size"}, Wrong{"--size 640x480x2", "--size"},
        Wrong{"--size 99999999999x1", "--size"},
        Wrong{"--method rk5", "did you mean `rk4`?; `oiler methods` lists all"},
        Wrong{"--method verlet", "did you mean `velocity_verlet` or `position_verlet`?"},
        Wrong{"--method xyz", "xyz: no such method; `oiler methods`"},
        Wrong{"--steps 3 --trase t",
              "--trase: no such option; did you mean `--trace`? (see demo --help)"},
        Wrong{"--trase=t", "--trase: no such option; did you mean `--trace`?"},
        Wrong{"stray", "stray: unexpected argument (see demo --help)"},
        Wrong{"--precision half", "--precision"}, Wrong{"--surface vulkan", "--surface"},
        Wrong{"--seed -1", "--seed"}, Wrong{"--seed 18446744073709551616", "--seed"},
        Wrong{"--rate 1e3", "--rate"}, Wrong{"--rate 0x10", "--rate"},
        Wrong{"--headless=3", "headless"}, Wrong{"--trace a.csv --energy ./a.csv", "--energy"},
        Wrong{"--json - --trace -", "--trace"}, Wrong{"--json=", "--json"},
        Wrong{"--surface osmesa", "--headless"}, Wrong{"--surface egl", "--headless"},
        Wrong{"--headless --surface window", "--headless"}, Wrong{"--out o", "--headless"},
        Wrong{"--steps 5 --headless", "--headless"}, Wrong{"--steps 5 --frames 2", "--frames"},
        Wrong{"--steps 5 --size 10x10", "--size"}, Wrong{"--recorder f", "--recorder"},
        Wrong{"--golden d", "--golden"}, Wrong{"--video f", "--video"},
        Wrong{"--headless --video -1e308", ".mp4, .gif or .apng"},
        Wrong{"--threads 0", "--threads"}, Wrong{"--threads 257", "--threads"},
        Wrong{"--frames 1000001", "--frames"}, Wrong{"--steps 1000000000001", "--steps"},
        Wrong{"--size 16385x1", "16385x1"}, Wrong{"--size 1x16385", "1x16385"},
        Wrong{"--damping none", "--damping"},
        Wrong{"--headless --golden none",
              "--golden: none has no capture; write it with --update-golden"},
        Wrong{"--rate 30 --rate 60", "--rate: given 2 times; give it once (see demo --help)"}));

}  // namespace
}  // namespace oiler::test
