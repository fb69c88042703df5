// SPDX-License-Identifier: MIT
#include "oiler/compare/captures/comparison.hpp"

#include <unistd.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "capture/captures.hpp"
#include "oiler/capture/png.hpp"
#include "oiler/compare/captures/changes.hpp"
#include "support/folder.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

namespace fs = std::filesystem;

/// Compares a made-up capture of five frames with a changed copy.
class ComparisonOfFilms : public testing::Test {
protected:
    template <class Change>
    Comparison changed(const Change& change, const PixelTolerance& tolerance = {}) {
        Film actual = film_of(5);
        change(actual);
        write(golden, folder / "golden");
        write(actual, folder / "actual");
        return compare_captures(folder / "golden", folder / "actual", tolerance);
    }
    /// Returns the message with which the comparison of the folders is refused.
    std::string refusal() {
        return line_of_error(
            Exit::usage, [&] { (void)compare_captures(folder / "golden", folder / "actual", {}); });
    }
    Film golden = film_of(5);
    Folder folder;
};

TEST_F(ComparisonOfFilms, EqualFramesPass) {
    const Comparison same = changed([](Film&) {});
    EXPECT_TRUE(same.passed());
    EXPECT_EQ(same.verdict, "5 frames are equal");
    EXPECT_EQ(describe(same), "5 frames are equal\n");
    EXPECT_EQ(same.count(Cause::none), 5);
}

TEST_F(ComparisonOfFilms, ACaptureIsNamedByItsManifest) {
    (void)changed([](Film&) {});
    const Comparison same =
        compare_captures(folder / "golden/manifest.json", folder / "actual/manifest.json", {});
    EXPECT_EQ(same.verdict, "5 frames are equal");
}

// A path that names no capture is wrong usage; a capture that may not be read is an error of the
// machine, whichever part of it that is.
TEST_F(ComparisonOfFilms, OfWhatMayNotBeReadIsAnErrorOfReading) {
    (void)changed([](Film&) {});
    fs::permissions(folder.path(), fs::perms{0755});
    constexpr uid_t nobody = 65534;
    const bool is_root = geteuid() == 0;
    const auto refuse_parts = [&] {
        for (const char* part : {"manifest.json", "frames.jsonl.gz", ""}) {
            const fs::path path = folder / "golden" / part;
            const fs::perms before = fs::status(path).permissions();
            fs::permissions(path, fs::perms::none);
            if (is_root) {
                EXPECT_EQ(seteuid(nobody), 0);
            }
            EXPECT_TRUE(holds(line_of_error(Exit::io,
                                            [&] {
                                                (void)compare_captures(folder / "golden",
                                                                       folder / "actual", {});
                                            }),
                              "cannot be read"))
                << part;
            if (is_root) {
                EXPECT_EQ(seteuid(0), 0);
            }
            fs::permissions(path, before);
        }
    };
    refuse_parts();
    fs::remove(folder / "golden/manifest.json");
    EXPECT_TRUE(holds(refusal(), "no capture there"));
}

TEST_F(ComparisonOfFilms, AStateNamesTickBodyAndField) {
    const Comparison moved = changed([](Film& film) {
        film.shots[2].state_hash = 1;
        film.shots[2].picture_hash = 2;
        film.shots[2].rgb.assign(300, 99);
        film.shots[2].tick_hashes = "0004ffffffff";
        film.shots[2].record->bodies[0].velocity[1] = 3.5;
    });
    EXPECT_FALSE(moved.passed());
    EXPECT_EQ(moved.frames[2].cause, Cause::simulation);
    EXPECT_EQ(moved.count(Cause::none), 4);
    EXPECT_TRUE(moved.verdict.starts_with(
        "simulation changed at tick 5; frame 2 (tick 6) shows body 'bob', vy: 3 → 3.5, by 0.5 m/s"))
        << moved.verdict;
    EXPECT_EQ(moved.frames[2].differing, 100);
    EXPECT_EQ(moved.frames[2].largest, 99 - 20);
    EXPECT_EQ(moved.frames[2].time, 0.2);
}

// A change may end before the next frame.
TEST_F(ComparisonOfFilms, ATickBetweenEqualFramesIsNamed) {
    const Comparison other =
        changed([](Film& film) { film.shots[2].tick_hashes = "0004ffff0006"; });
    EXPECT_FALSE(other.passed());
    EXPECT_EQ(other.verdict, "simulation changed at tick 5; this frame shows the same bodies");
}

TEST_F(ComparisonOfFilms, EachTickOfAFrameCanBeTheFirst) {
    for (const auto& [hashes, tick] : {std::pair{"ffffffffffff", "4"},
                                       {"0004ffffffff", "5"},
                                       {"00040005ffff", "6"},
                                       {"000400050006", "6"}}) {
        const Comparison moved = changed([text = hashes](Film& film) {
            film.shots[2].state_hash = 1;
            film.shots[2].tick_hashes = text;
        });
        EXPECT_EQ(moved.verdict, std::string("simulation changed at tick ") + tick +
                                     "; this frame shows the same bodies");
    }
}

TEST_F(ComparisonOfFilms, WithoutTickHashesTheTicksAreBounded) {
    const Comparison moved = changed([](Film& film) {
        film.shots[2].state_hash = 1;
        film.shots[2].tick_hashes = "";
        film.shots[2].record.reset();
    });
    EXPECT_EQ(moved.verdict,
              "simulation changed between ticks 3 and 6: no bodies of this frame are recorded");
}

TEST_F(ComparisonOfFilms, AStateAtTheFirstTick) {
    const Comparison moved = changed([](Film& film) {
        film.shots[0].state_hash = 1;
        film.shots[0].record->bodies[0].name = "rob";
    });
    EXPECT_EQ(moved.verdict, "simulation changed at tick 0: body 'bob' is missing");
}

TEST_F(ComparisonOfFilms, AnotherTickIsNamed) {
    const Comparison late = changed([](Film& film) {
        film.shots[4].tick = 13;
        film.shots[4].tick_hashes = "";
        film.shots[4].record->bodies[0].velocity[1] = 3.5;
    });
    EXPECT_EQ(late.verdict, "frames show other ticks: frame 4 shows tick 13 instead of 12");
}

TEST_F(ComparisonOfFilms, APictureIsDescribed) {
    const Comparison other = changed([](Film& film) {
        film.shots[3].picture_hash = 1;
        film.shots[3].record->picture.discs[0].radius = 2;
    });
    EXPECT_EQ(other.verdict, "picture changed at frame 3: 1 disc: radius 1 → 2");
    EXPECT_EQ(other.frames[3].cause, Cause::picture);
    EXPECT_EQ(other.frames[3].differing, 0) << "the pixels were compared";
    EXPECT_TRUE(other.frames[3].has_images);
}

TEST(PictureChanges, NameSpritesPolygonsLayersAndBars) {
    Picture golden;
    golden.sprites = {{.key = {1}, .bitmap = make_bitmap({1, 1}, {1, 2, 3, 4})}};
    golden.polygons = {{.key = {2}, .points = {{0, 0}, {1, 0}, {0, 1}}}};
    golden.labels = {{.key = {3}, .text = "a"}};
    const auto words = [&](const std::function<void(Picture&)>& change) {
        Picture actual = golden;
        change(actual);
        return describe_picture_change(golden, actual, {640, 360});
    };
    EXPECT_EQ(words([](Picture& p) { p.sprites[0].angle = 2; }), "1 sprite: angle 0 → 2");
    EXPECT_EQ(words([](Picture& p) { p.sprites.clear(); }).substr(0, 16), "1 sprite missing");
    EXPECT_TRUE(words([](Picture& p) {
                    p.sprites[0].bitmap = make_bitmap({1, 1}, {9, 2, 3, 4});
                }).starts_with("1 sprite: text '"));
    EXPECT_TRUE(words([](Picture& p) {
                    p.sprites[0].part = BitmapPart{0, 0, {1, 1}};
                }).ends_with(" 1x1 at (0, 0)'"));
    EXPECT_EQ(words([](Picture& p) { p.polygons[0].outline = 2; }), "1 polygon: outline 0 → 2");
    EXPECT_EQ(words([](Picture& p) { p.polygons[0].points.pop_back(); }),
              "1 polygon: 3 → 2 points");
    EXPECT_EQ(words([](Picture& p) { p.polygons[0].layer = 1; }),
              "1 polygon placed in another way");
    EXPECT_EQ(words([](Picture& p) { p.labels[0].size_in = Space::world; }),
              "1 label placed in another way");
    EXPECT_EQ(words([](Picture& p) { p.labels[0].space = Space::upper_left; }),
              "1 label placed in another way");
    EXPECT_EQ(words([](Picture& p) { p.has_bars = true; }), "bars beside the canvas new");
}

TEST_F(ComparisonOfFilms, ThereAreAlwaysWords) {
    EXPECT_EQ(changed([](Film& film) { film.shots[1].picture_hash = 1; }).verdict,
              "picture changed at frame 1: numbers of other bits that are equal, such as 0 and -0");
    EXPECT_EQ(changed([](Film& film) { film.shots[1].alpha = 0.25; }).verdict,
              "picture changed at frame 1: alpha 0 → 0.25");
    EXPECT_EQ(changed([](Film& film) {
                  film.shots[1].picture_hash = 1;
                  film.shots[1].record.reset();
              }).verdict,
              "picture changed at frame 1: no records of this frame");
}

/// Replaces each picture, or each state, by that of the frame `shift` later.
void shift_pictures(Film& film, int shift) {
    const Film later = film_of(20);
    for (std::size_t i = 0; i < film.shots.size(); ++i) {
        const Shot& shot = later.shots[i + static_cast<std::size_t>(shift)];
        film.shots[i].picture_hash = shot.picture_hash;
        film.shots[i].record->picture = shot.record->picture;
    }
}

TEST_F(ComparisonOfFilms, AShiftIsNamed) {
    EXPECT_EQ(changed([](Film& film) { shift_pictures(film, 1); }).verdict,
              "picture changed at frame 0: it shows frame 1 of the golden (tick 3): shifted by 1 "
              "frame");
    EXPECT_EQ(changed([](Film& film) { shift_pictures(film, 3); }).verdict,
              "picture changed at frame 0: it shows frame 3 of the golden (tick 9): shifted by 3 "
              "frames");
    golden = film_of(5);
    shift_pictures(golden, 1);
    EXPECT_EQ(changed([](Film&) {}).verdict,
              "picture changed at frame 0: 1 disc moved by at most 0.56 px");
    EXPECT_EQ(changed([](Film& film) { shift_pictures(film, 2); }).verdict.substr(0, 44),
              "picture changed at frame 0: it shows frame 1");
}

TEST_F(ComparisonOfFilms, AShiftOfTheStateIsNamed) {
    const Comparison late = changed([](Film& film) {
        const Film later = film_of(6);
        for (std::size_t i = 0; i < 5; ++i) {
            film.shots[i].state_hash = 1000 + i;
            film.shots[i].record->bodies = later.shots[i + 1].record->bodies;
        }
    });
    EXPECT_EQ(late.verdict,
              "simulation changed at tick 0: frame 0 shows frame 1 of the golden (tick 3): shifted "
              "by 1 frame");
}

/// Adds to the first channel of the first pixels of frame 2.
template <int Count, int Difference>
void paint(Film& film) {
    for (std::size_t i = 0; i < Count; ++i)
        film.shots[2].rgb[3 * i] = static_cast<std::uint8_t>(20 + Difference);
}

// The frame has 100 pixels: one is 1 %.
TEST_F(ComparisonOfFilms, PixelsHaveATolerance) {
    const Comparison within = changed(paint<1, 2>);
    EXPECT_TRUE(within.passed());
    EXPECT_EQ(within.verdict, "5 frames are equal, 1 of them within the tolerance of the pixels");
    EXPECT_TRUE(within.frames[2].tolerated);
    EXPECT_EQ(within.frames[2].share, 0.01);
    EXPECT_TRUE(changed(paint<1, -2>).passed());

    EXPECT_EQ(changed(paint<1, 3>).verdict,
              "only pixels changed, at frame 2: 1 of 100 pixels differ (1 %), by at most 3; "
              "tolerated are 1 %, by at most 2");
    EXPECT_EQ(changed(paint<2, 2>).verdict,
              "only pixels changed, at frame 2: 2 of 100 pixels differ (2 %), by at most 2; "
              "tolerated are 1 %, by at most 2");
    EXPECT_FALSE(changed(paint<1, -3>).passed());
    EXPECT_TRUE(changed(paint<2, 5>, {.channel = 5, .share = 0.02}).passed());
    EXPECT_FALSE(changed(paint<1, 1>, {.channel = 0, .share = 1}).passed());
    EXPECT_FALSE(changed(paint<1, 1>, {.channel = 255, .share = 0}).passed());
}

// A tolerance never hides another state or another picture.
TEST_F(ComparisonOfFilms, ToleratedFramesAreNotCountedAsFailures) {
    const Comparison both = changed([](Film& film) {
        film.shots[1].rgb[0] += 1;
        film.shots[2].rgb[0] += 9;
    });
    EXPECT_TRUE(holds(describe(both), "\n5 frames: 3 equal; 1 pixels; 1 tolerated\n"));
}

TEST_F(ComparisonOfFilms, OnlyPixelsAreTolerated) {
    const auto state = [](Film& film) { film.shots[2].state_hash = 1; };
    EXPECT_FALSE(changed(state, {.channel = 255, .share = 1}).passed());
    const auto image = [](Film& film) { film.shots[2].picture_hash = 1; };
    EXPECT_FALSE(changed(image, {.channel = 255, .share = 1}).passed());
}

TEST_F(ComparisonOfFilms, TheRendererIsNamed) {
    const auto drawn_elsewhere = [](Film& film) {
        film.header.gl_renderer = "softpipe";
        paint<5, 9>(film);
    };
    const Comparison other = changed(drawn_elsewhere);
    EXPECT_EQ(other.renderer, "llvmpipe → softpipe");
    EXPECT_EQ(describe(other).substr(0, 40), "renderer differs: llvmpipe → softpipe\n");
    EXPECT_TRUE(other.verdict.ends_with(
        "by at most 9; tolerated are 1 %, by at most 2; the renderer differs"))
        << other.verdict;
}

TEST_F(ComparisonOfFilms, SettingsAreNamed) {
    const Comparison other = changed([](Film& film) {
        film.header.method = "rk3_kutta";
        film.header.rate = 60;
        film.header.fps = 20;
        film.header.damping = "kick";
        film.header.precision = "float";
        film.header.seed = 4;
        film.header.scene_text = "[scene]\naxes = 1\n";
    });
    EXPECT_TRUE(other.passed()) << "the frames are equal";
    for (const char* line :
         {"\nmethod: rk4 → rk3_kutta\n", "\nrate: 30 → 60\n", "\nfps: 10 → 20\n",
          "\ndamping: the method's own → kick\n", "\nprecision: double → float\n",
          "\nseed: 0 → 4\n", "\nscene file changed, line 1: added `[scene]` and 1 more\n"})
        EXPECT_TRUE(holds(describe(other), line)) << line << describe(other);
}

// A # in quotes starts no comment.
TEST_F(ComparisonOfFilms, ALineOfTheSceneIsComparedUpToItsComment) {
    const std::array<std::array<const char*, 3>, 5> lines{{
        {R"(colour = "#102030")", R"(colour = "#102033"  # new)",
         R"(`colour = "#102030"` → `colour = "#102033"`)"},
        {R"(name = 'a#b')", R"(name = 'a#c')", R"(`name = 'a#b'` → `name = 'a#c'`)"},
        {R"(name = "a\"#b")", R"(name = "a\"#c")", R"(`name = "a\"#b"` → `name = "a\"#c"`)"},
        {R"(mass = 1 # "kg")", R"(mass = 2 # "kg")", "`mass = 1` → `mass = 2`"},
        {R"(mass = 1 # it's)", R"(mass = 1 # "t")", nullptr},
    }};
    for (const auto& [before, after, change] : lines) {
        golden.header.scene_text = before;
        const Comparison other =
            changed([text = after](Film& film) { film.header.scene_text = text; });
        std::vector<std::string> expected;
        if (change != nullptr) expected = {std::string("scene file changed, line 1: ") + change};
        EXPECT_EQ(other.findings, expected);
    }
}

TEST_F(ComparisonOfFilms, AddedAndRemovedLinesOfTheSceneAreNamed) {
    const auto finding = [&](const char* before, const char* after) {
        golden.header.scene_text = before;
        const Comparison other = changed([after](Film& film) { film.header.scene_text = after; });
        return other.findings.empty() ? "" : other.findings.front().substr(20);
    };
    EXPECT_EQ(finding("a\nb\nc\n", "a\nx\nb\nc\n"), "line 2: added `x`");
    EXPECT_EQ(finding("a\nb\nc\n", "a\nc\n"), "line 2: removed `b`");
    EXPECT_EQ(finding("a\n", "a\nx\ny\nz\n"), "line 2: added `x` and 2 more");
    EXPECT_EQ(finding("a\nb\nc\nd\n", "a\nx\nd\n"), "line 2: removed `b` and 1 more, added `x`");
    EXPECT_EQ(finding("a\nb\nc\nd\n", "x\nb\ny\nd\n"), "line 1: `a` → `x`, and 1 more");
    EXPECT_EQ(finding("a\na\n", "a\na\na\n"), "line 3: added `a`");
    EXPECT_EQ(finding("a\nb\n", "a\r\nb"), "");
    EXPECT_EQ(finding("a\nb\n", "\na\n # c\n\nb\n"), "");
    EXPECT_EQ(finding("a\nb\n", "\na\n\nc\n"), "line 4: `b` → `c`");
}

TEST_F(ComparisonOfFilms, FramesOfAnotherSizeDiffer) {
    const Comparison other = changed([](Film& film) { film.header.size = {20, 5}; });
    EXPECT_EQ(other.verdict, "only pixels changed, at frame 0: frames of another size");
    EXPECT_TRUE(holds(describe(other), "\nsize: 10x10 → 20x5\n"));
}

TEST_F(ComparisonOfFilms, MissingFramesAreCounted) {
    const Comparison shorter = changed([](Film& film) { film.shots.resize(2); });
    EXPECT_EQ(shorter.verdict,
              "3 frames are missing, the first is frame 2: the frame was not captured");
    EXPECT_EQ(shorter.frames.size(), 5U);
    const Comparison longer = changed([](Film& film) { film = film_of(6); });
    EXPECT_EQ(longer.verdict,
              "1 frame is missing, the first is frame 5: the golden has no such frame");
}

TEST_F(ComparisonOfFilms, AMissingFileOfTheGoldenIsNamed) {
    (void)changed([](Film&) {});
    std::filesystem::remove(folder / "golden/frame_000003.png");
    const Comparison gap = compare_captures(folder / "golden", folder / "actual", {});
    EXPECT_FALSE(gap.passed());
    EXPECT_TRUE(holds(gap.verdict, "frame_000003.png of the golden is missing"));
}

TEST_F(ComparisonOfFilms, AMissingFileOfTheActualCaptureIsNamed) {
    (void)changed([](Film&) {});
    std::filesystem::remove(folder / "actual/frame_000001.png");
    const Comparison gap = compare_captures(folder / "golden", folder / "actual", {});
    EXPECT_FALSE(gap.passed());
    EXPECT_TRUE(holds(gap.verdict, "frame_000001.png of the actual capture is missing"));
}

// The manifests of both are equal, but somebody put another picture in a file.
TEST_F(ComparisonOfFilms, FilesHoldWhatTheirManifestSays) {
    for (const char* const owner : {"golden", "actual"}) {
        (void)changed([](Film&) {});
        std::filesystem::copy_file(folder / owner / "frame_000001.png",
                                   folder / owner / "frame_000002.png",
                                   std::filesystem::copy_options::overwrite_existing);
        EXPECT_TRUE(holds(refusal(), std::string(owner) + "/frame_000002.png: its pixels are not"));
    }
}

// Goldens may have hashes only: then pixels of another renderer cannot be compared.
TEST_F(ComparisonOfFilms, HashesSuffice) {
    for (Shot& shot : golden.shots) shot.has_png = false;
    EXPECT_TRUE(changed([](Film&) {}).passed());
    EXPECT_EQ(changed(paint<1, 1>).verdict,
              "only pixels changed, at frame 2: pixels differ, but a PNG is missing");
    const Comparison elsewhere = changed([](Film& film) {
        film.header.gl_renderer = "softpipe";
        paint<1, 1>(film);
    });
    EXPECT_TRUE(elsewhere.passed());
    EXPECT_EQ(elsewhere.frames[2].words, "pixels of another renderer, not compared without a PNG");
    EXPECT_EQ(elsewhere.verdict,
              "5 frames are equal, 1 of them but for pixels that could not be compared: another "
              "renderer drew them, and they have no PNG");
}

TEST_F(ComparisonOfFilms, DamagedFilesAreRefused) {
    (void)changed(paint<1, 1>);
    const std::string png = text_of(folder / "golden/frame_000002.png");
    put(folder / "golden/frame_000002.png", png.substr(0, png.size() / 2));
    EXPECT_TRUE(holds(refusal(), "golden/frame_000002.png: not a valid PNG"));
    std::filesystem::copy_file(folder / "golden/frame_000001.png",
                               folder / "golden/frame_000002.png",
                               std::filesystem::copy_options::overwrite_existing);
    EXPECT_TRUE(holds(refusal(), "frame_000002.png: its pixels are not those of manifest.json"));
    put(folder / "actual/frames.jsonl.gz", "text");
    EXPECT_TRUE(holds(refusal(), "actual/frames.jsonl.gz: damaged gzip file"));
    std::filesystem::remove(folder / "actual/manifest.json");
    EXPECT_TRUE(holds(refusal(), "actual: no capture there"));
}

TEST_F(ComparisonOfFilms, AnUnfinishedGoldenIsRefused) {
    golden.header.planned_frames = 9;
    write(golden, folder / "golden");
    write(film_of(5), folder / "actual");
    EXPECT_TRUE(holds(refusal(), "golden: the capture was not finished (5 of 9 frames)"));
}

TEST_F(ComparisonOfFilms, JsonHasTheFacts) {
    const Comparison moved = changed([](Film& film) {
        film.shots[2].state_hash = 1;
        film.shots[3].picture_hash = 1;
        paint<1, 1>(film);
        film.shots[4].rgb[0] += 1;
        film.header.seed = 3;
    });
    const auto json = nlohmann::json::parse(to_json(moved).dump(0));
    EXPECT_EQ(json.at("passed"), false);
    EXPECT_EQ(json.at("verdict"), moved.verdict);
    EXPECT_EQ(json.at("renderer"), nullptr);
    EXPECT_EQ(json.at("counts"),
              nlohmann::json::parse(R"({"frames": 5, "equal": 2, "simulation": 1, "picture": 1,
                                        "pixels": 0, "missing": 0, "tolerated": 1})"));
    EXPECT_EQ(json.at("settings")[0],
              nlohmann::json::parse(R"({"name": "seed", "golden": "0", "actual": "3"})"));
    ASSERT_EQ(json.at("frames").size(), 3U);
    EXPECT_EQ(json.at("frames")[0].at("cause"), "simulation");
    EXPECT_EQ(json.at("frames")[2].at("tolerated"), true);
    EXPECT_EQ(json.at("frames")[2].at("largest"), 1);
}

}  // namespace
}  // namespace oiler::test
