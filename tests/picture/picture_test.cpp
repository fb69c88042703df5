// SPDX-License-Identifier: MIT
#include <fmt/core.h>
#include <stdlib.h>

#include <fstream>
#include <functional>

#include "oiler/picture/bitmap.hpp"
#include "oiler/picture/palette.hpp"
#include "oiler/picture/picture.hpp"
#include "oiler/picture/shapes.hpp"
#include "support/folder.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

Disc disc(ElementKey key, Point centre, float radius = 1, Colour colour = {}) {
    return {key, centre, radius, colour, Space::world};
}

Picture of_discs(std::vector<Disc> discs) {
    Picture picture;
    picture.discs = std::move(discs);
    return picture;
}

Picture of_line(ElementKey key, std::vector<Point> points) {
    Picture picture;
    picture.polylines.push_back({key, std::move(points), 1, {}, Space::world});
    return picture;
}

Point centre_at(const Picture& before, const Picture& after, float alpha) {
    return between(before, after, alpha).discs.at(0).centre;
}

TEST(Camera, PutsItsCentreInTheMiddleAndItsHeightOverTheCanvas) {
    const Camera camera{{100, -50}, 20};
    EXPECT_EQ(camera.to_canvas({100, -50}), (Point{320, 180}));
    EXPECT_EQ(camera.to_canvas({100, -40}), (Point{320, 360}));
    EXPECT_EQ(camera.to_canvas({101, -50}), (Point{338, 180}));
}

// The same camera follows the same motion at any rate: half of the way in each half-life.
TEST(Camera, FollowsByHalfOfTheWayInEachHalfLife) {
    for (const int rate : {10, 60, 240}) {
        Camera camera{{0, 8}, 10};
        for (int step = 0; step < rate; ++step) camera.follow({16, 8}, 0.5, 1.0 / rate);
        EXPECT_NEAR(camera.centre.x, 16 * (1 - 0.25), 16 * 1e-4) << rate;
        EXPECT_EQ(camera.centre.y, 8);
    }
}

TEST(Camera, FollowsAtOnceWithoutAHalfLife) {
    Camera camera{{3, 8}, 10};
    camera.follow({16, -1}, 0, 0.1);
    EXPECT_EQ(camera.centre, (Point{16, -1}));
    camera.follow({0, 0}, 1e-9, 0.1);
    EXPECT_NEAR(camera.centre.x, 0, 1e-5);
}

TEST(Camera, ZoomsAroundAPoint) {
    Camera camera{{100, -50}, 20};
    const Point before = camera.to_canvas({103, -47});
    camera.zoom(0.5F, {103, -47});
    EXPECT_EQ(camera.height, 10);
    EXPECT_NEAR(camera.to_canvas({103, -47}).x, before.x, 1e-3);
    EXPECT_NEAR(camera.to_canvas({103, -47}).y, before.y, 1e-3);
}

// From (1, 2) to (4, 6) are 5, along (0.6, 0.8); half of the width 2 is 1 along (-0.8, 0.6).
TEST(Shapes, ABarReachesFromPointToPoint) {
    const std::vector<Point> corners = bar({1, 2}, {4, 6}, 2);
    const Point expected[] = {{1.8F, 1.4F}, {4.8F, 5.4F}, {3.2F, 6.6F}, {0.2F, 2.6F}};
    ASSERT_EQ(corners.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(corners[i].x, expected[i].x, 1e-5) << i;
        EXPECT_NEAR(corners[i].y, expected[i].y, 1e-5) << i;
    }
}

// An arrow shorter than its head, 4 widths, has a smaller head. Coordinates below 10 are rounded a
// few times.
TEST(Shapes, AnArrowStaysBetweenItsEndsHoweverWide) {
    for (const float width : {0.1F, 1.0F, 2.0F, 100.0F})
        for (const Point at : arrow({1, 2}, {4, 6}, width)) {
            const float along = (at.x - 1) * 0.6F + (at.y - 2) * 0.8F;
            EXPECT_GE(along, -1e-5F) << width;
            EXPECT_LE(along, 5 + 1e-5F) << width;
        }
}

TEST(Palette, MixesEachPart) {
    constexpr Colour from{0, 100, 200, 255}, to{10, 0, 255, 55};
    EXPECT_EQ(palette::mix(from, to, 0), from);
    EXPECT_EQ(palette::mix(from, to, 1), to);
    EXPECT_EQ(palette::mix(from, to, 0.25F), (Colour{3, 75, 214, 205}));
}

TEST(Between, TurnsSpritesTheShorterWay) {
    const auto at = [](float angle) {
        Picture picture;
        picture.sprites = {{.key = {1}, .centre = {0, 2}, .size = {1, 4}, .angle = angle}};
        return picture;
    };
    EXPECT_NEAR(between(at(3.0F), at(-3.0F), 0.5F).sprites[0].angle, 3.14159265F, 1e-6F);
    EXPECT_NEAR(between(at(0.5F), at(1.0F), 0.25F).sprites[0].angle, 0.625F, 1e-6F);
    Picture after = at(0);
    after.sprites[0].centre = {8, 2};
    after.sprites[0].size = {3, 4};
    after.sprites[0].colour = {55, 255, 255, 255};
    const Sprite moved = between(at(0), after, 0.25F).sprites[0];
    EXPECT_EQ(moved.centre, (Point{2, 2}));
    EXPECT_EQ(moved.size, (Point{1.5F, 4}));
    EXPECT_EQ(moved.colour, (Colour{205, 255, 255, 255}));
}

TEST(Between, MirrorsSpritesAtOnce) {
    Picture before;
    before.sprites = {{.key = {1}, .size = {2, 4}}};
    Picture after = before;
    after.sprites[0].size = {-4, 4};
    EXPECT_EQ(between(before, after, 0.5F).sprites[0].size, (Point{3, 4}));
    EXPECT_EQ(between(after, before, 0.5F).sprites[0].size, (Point{-3, 4}));
}

TEST(Pictures, RefuseAPartBesideItsBitmap) {
    const auto line = [](const BitmapPart& part) {
        Picture picture;
        picture.sprites = {
            {.bitmap = make_bitmap({2, 1}, {0, 0, 0, 255, 0, 0, 0, 255}), .part = part}};
        return line_of_error(Exit::usage, [&] { require_drawable(picture); });
    };
    EXPECT_EQ(line({1, 0, {2, 1}}),
              "a sprite's part of 2x1 texels at (1, 0): give one within its bitmap of 2x1");
    for (const BitmapPart& part :
         {BitmapPart{-1, 0, {1, 1}}, BitmapPart{0, 1, {1, 1}}, BitmapPart{0, 0, {0, 1}},
          BitmapPart{2147483647, 0, {2147483647, 1}}})
        EXPECT_NE(line(part), "") << part.left;
}

TEST(Between, MovesPolygonsPointByPoint) {
    Picture before;
    before.polygons = {{.key = {1}, .points = {{0, 0}, {4, 0}, {0, 4}}, .outline = 1}};
    Picture after = before;
    after.polygons[0].points[2] = {8, 4};
    after.polygons[0].outline = 3;
    after.polygons[0].outline_colour = {100, 0, 0, 255};
    const Polygon moved = between(before, after, 0.5F).polygons[0];
    EXPECT_EQ(moved.points[2], (Point{4, 4}));
    EXPECT_EQ(moved.outline, 2);
    EXPECT_EQ(moved.outline_colour, (Colour{50, 0, 0, 255}));
    after.polygons[0].points.push_back({-1, 2});
    EXPECT_EQ(between(before, after, 0.5F).polygons[0].points, before.polygons[0].points);
}

TEST(Between, IsExactlyBeforeAtZeroAndAfterAtOne) {
    // 0.1 and 0.7 have no exact sum or difference in float, so interpolation alone would miss.
    const Picture before = of_discs({disc({1, 0, 0}, {0.1F, 1e7F})});
    const Picture after = of_discs({disc({1, 0, 0}, {0.7F, -3e-7F}), disc({2, 0, 0}, {5, 5})});
    EXPECT_EQ(centre_at(before, after, 0), (Point{0.1F, 1e7F}));
    EXPECT_EQ(centre_at(before, after, 1), (Point{0.7F, -3e-7F}));
    EXPECT_EQ(between(before, after, 0).discs.size(), 1U);
    EXPECT_EQ(between(before, after, 1).discs.size(), 2U);
}

TEST(Between, KeepsAlphaWithinTheStep) {
    const Picture before = of_discs({disc({1, 0, 0}, {1, 0})});
    const Picture after = of_discs({disc({1, 0, 0}, {2, 0})});
    EXPECT_EQ(centre_at(before, after, -1).x, 1);
    EXPECT_EQ(centre_at(before, after, 2).x, 2);
    EXPECT_EQ(centre_at(before, after, std::numeric_limits<float>::quiet_NaN()).x, 1);
}

TEST(Between, MovesDiscsOnStraightLines) {
    const Picture before = of_discs({disc({1, 0, 0}, {0, 8}, 2, {0, 255, 10, 255})});
    const Picture after = of_discs({disc({1, 0, 0}, {4, 0}, 4, {255, 0, 20, 0})});
    const Disc moved = between(before, after, 0.25F).discs.at(0);
    EXPECT_EQ(moved.centre, (Point{1, 6}));
    EXPECT_EQ(moved.radius, 2.5F);
    // 63.75, 191.25, 12.5 and 191.25, rounded to the nearest, halves away from zero.
    EXPECT_EQ(moved.colour, (Colour{64, 191, 13, 191}));
}

TEST(Between, KeepsElementsThatDoNotMoveExactly) {
    const Picture still = of_discs({disc({1, 0, 0}, {0.1F, 1.0F / 3})});
    for (int i = 0; i <= 100; ++i) {
        EXPECT_EQ(centre_at(still, still, static_cast<float>(i) / 100), (Point{0.1F, 1.0F / 3}));
    }
}

TEST(Between, DoesNotStreakTeleportedElements) {
    const Picture before = of_discs({disc({1, 0, 0}, {0, 0})});
    const Picture after = of_discs({disc({1, 0, 1}, {100, 0})});
    EXPECT_EQ(centre_at(before, after, 0.99F), (Point{0, 0}));
    EXPECT_EQ(centre_at(before, after, 1), (Point{100, 0}));
    EXPECT_EQ(between(before, after, 0.99F).discs.size(), 1U);
}

TEST(Between, AddsNewAndRemovesOldElementsOnlyAtTheEnd) {
    const Picture before = of_discs({disc({1, 0, 0}, {0, 0}), disc({2, 0, 0}, {10, 0})});
    const Picture after = of_discs({disc({2, 0, 0}, {20, 0}), disc({3, 0, 0}, {30, 0})});
    const Picture half = between(before, after, 0.5F);
    ASSERT_EQ(half.discs.size(), 2U);
    EXPECT_EQ(half.discs[0].centre.x, 0);
    EXPECT_EQ(half.discs[1].centre.x, 15);
}

TEST(Between, MatchesByKeyInAnyOrderAndKeepsTheFirstOrder) {
    Picture before;
    Picture after;
    for (std::uint64_t i = 1; i <= 50; ++i) {
        before.discs.push_back(disc({i % 10 + 1, static_cast<std::uint32_t>(i), 0}, {0, 0}));
        after.discs.insert(after.discs.begin(), before.discs.back());
        after.discs.front().centre.x = static_cast<float>(i) * 2;
    }
    const Picture half = between(before, after, 0.5F);
    for (std::size_t i = 0; i < 50; ++i) {
        EXPECT_EQ(half.discs.at(i).key, before.discs[i].key);
        EXPECT_EQ(half.discs.at(i).centre.x, static_cast<float>(i + 1));
    }
}

TEST(Between, DoesNotMatchWithoutAnObjectOrInAnotherSpace) {
    Picture before = of_discs({disc({0, 7, 0}, {0, 0}), disc({1, 0, 0}, {0, 0})});
    Picture after = of_discs({disc({0, 7, 0}, {8, 0}), disc({1, 0, 0}, {8, 0})});
    after.discs[1].space = Space::canvas;
    const Picture half = between(before, after, 0.5F);
    EXPECT_EQ(half.discs.at(0).centre.x, 0);
    EXPECT_EQ(half.discs.at(1).centre.x, 0);
    EXPECT_EQ(half.discs.at(1).space, Space::world);
}

TEST(Between, GrowsATrailOutOfItsLastPoint) {
    const Picture before = of_line({1, 0, 0}, {{0, 0}, {1, 0}});
    const Picture after = of_line({1, 0, 0}, {{0, 2}, {1, 0}, {3, 4}});
    const std::vector<Point> grown{{0, 1}, {1, 0}, {2, 2}};
    EXPECT_EQ(between(before, after, 0.5F).polylines.at(0).points, grown);
}

TEST(Between, KeepsALineThatShrinksUntilTheEnd) {
    const Picture before = of_line({1, 0, 0}, {{0, 0}, {1, 0}, {2, 0}});
    const Picture after = of_line({1, 0, 0}, {{5, 5}});
    EXPECT_EQ(between(before, after, 0.9F).polylines[0].points, before.polylines[0].points);
    EXPECT_EQ(between(before, after, 1).polylines[0].points, after.polylines[0].points);
    const Picture empty = of_line({1, 0, 0}, {});
    EXPECT_TRUE(between(empty, after, 0.9F).polylines[0].points.empty());
}

TEST(Between, MovesLabelsAndChangesTheirTextAtTheEnd) {
    Picture before;
    Picture after;
    before.labels.push_back({{1, 0, 0}, {0, 0}, "1.0 s", 10, {}, Align::left, Space::canvas});
    after.labels.push_back({{1, 0, 0}, {4, 2}, "1.1 s", 10, {}, Align::left, Space::canvas});
    const Label moved = between(before, after, 0.5F).labels.at(0);
    EXPECT_EQ(moved.at, (Point{2, 1}));
    EXPECT_EQ(moved.text, "1.0 s");
    EXPECT_EQ(between(before, after, 1).labels.at(0).text, "1.1 s");
}

TEST(Between, MovesTheCamera) {
    Picture before;
    Picture after;
    before.camera = {{0, 0}, 10};
    after.camera = {{2, 4}, 20};
    const Camera moved = between(before, after, 0.5F).camera;
    EXPECT_EQ(moved.centre, (Point{1, 2}));
    EXPECT_EQ(moved.height, 15);
}

using Texels = std::vector<std::uint8_t>;

/// A PNG of 2 × 2 texels with alpha, written by Python's zlib.
constexpr std::array<unsigned char, 81> png{
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48,
    0x44, 0x52, 0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x02, 0x08, 0x06, 0x00, 0x00,
    0x00, 0x72, 0xb6, 0x0d, 0x24, 0x00, 0x00, 0x00, 0x18, 0x49, 0x44, 0x41, 0x54, 0x78,
    0x9c, 0x63, 0xf8, 0xcf, 0xc0, 0xf0, 0x1f, 0x08, 0x1b, 0x18, 0x18, 0x99, 0x98, 0x59,
    0x58, 0xd9, 0xd8, 0x39, 0x00, 0x30, 0x5f, 0x03, 0xa2, 0x0b, 0xd4, 0x2c, 0x6f, 0x00,
    0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
const Texels texels{255, 0, 0, 255, 0, 255, 0, 128,  // the top row
                    1,   2, 3, 4,   5, 6,   7, 8};

void write(const std::filesystem::path& path, std::size_t bytes) {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(bytes));
}

void expect_error(Exit exit, const std::string& words, const std::function<void()>& call) {
    try {
        call();
        ADD_FAILURE() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.exit(), exit);
        EXPECT_TRUE(holds(error.what(), words));
    }
}

TEST(Bitmap, IsReadFromItsTopRowWithItsAlpha) {
    const Folder folder;
    write(folder / "ship.png", png.size());
    const auto bitmap = load_bitmap(folder / "ship.png");
    EXPECT_EQ(bitmap->size, (Size{2, 2}));
    EXPECT_EQ(bitmap->rgba, texels);
    EXPECT_EQ(bitmap->hash, make_bitmap({2, 2}, texels)->hash);
}

TEST(Bitmap, HasAHashOfItsSizeAndTexels) {
    Texels other = texels;
    other[15] = 9;
    const std::uint64_t hash = make_bitmap({2, 2}, texels)->hash;
    EXPECT_NE(make_bitmap({2, 2}, other)->hash, hash);
    EXPECT_NE(make_bitmap({4, 1}, texels)->hash, hash);
}

TEST(Bitmap, NamesWhatIsWrong) {
    const Folder folder;
    write(folder / "cut.png", 40);
    expect_error(Exit::usage, "cut.png: not a PNG or JPEG image",
                 [&] { (void)load_bitmap(folder / "cut.png"); });
    expect_error(Exit::usage, "missing.png: cannot read the image: No such file",
                 [&] { (void)load_bitmap(folder / "missing.png"); });
    expect_error(Exit::usage, "cannot read the image: Is a directory",
                 [&] { (void)load_bitmap(folder / ""); });
    expect_error(Exit::usage, "2x2 texels has 16 bytes, four per texel, not 12", [&] {
        (void)make_bitmap({2, 2}, Texels(12));
    });
    expect_error(Exit::usage, "sides of 1 to 8192 texels, not 8193x1", [&] {
        (void)make_bitmap({8193, 1}, Texels(std::size_t{4} * 8193));
    });
    expect_error(Exit::usage, "not 0x2", [&] { (void)make_bitmap({0, 2}, {}); });
}

/// A folder beside this program, removed with its contents.
class FolderBesideProgram {
public:
    FolderBesideProgram() {
        std::string pattern = (program() / "oiler-test-XXXXXX").string();
        path_ = mkdtemp(pattern.data());
    }
    ~FolderBesideProgram() { std::filesystem::remove_all(path_); }
    FolderBesideProgram(const FolderBesideProgram&) = delete;
    FolderBesideProgram& operator=(const FolderBesideProgram&) = delete;

    [[nodiscard]] static std::filesystem::path program() {
        return std::filesystem::read_symlink("/proc/self/exe").parent_path();
    }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

/// Works in another folder for the lifetime of the object.
class WorkingIn {
public:
    explicit WorkingIn(const std::filesystem::path& folder)
        : former_(std::filesystem::current_path()) {
        std::filesystem::current_path(folder);
    }
    ~WorkingIn() { std::filesystem::current_path(former_); }
    WorkingIn(const WorkingIn&) = delete;
    WorkingIn& operator=(const WorkingIn&) = delete;

private:
    std::filesystem::path former_;
};

// The same name is an image in all three places, and a cut file in the last: so each error tells
// which file was read.
TEST(Bitmap, IsLookedForBesideTheProgramTheSourceAndInTheWorkingDirectory) {
    const FolderBesideProgram program;
    const Folder source, working;
    const WorkingIn here(working.path());
    const std::string name = program.path().filename() / "ship.png";
    const auto load = [&] { return load_bitmap(name, (source / "game.cpp").c_str()); };
    const std::vector<std::filesystem::path> places{program.path().parent_path(), source.path(),
                                                    working.path()};
    for (const std::filesystem::path& place : places) {
        std::filesystem::create_directories((place / name).parent_path());
        write(place / name, 40);
    }
    for (const std::filesystem::path& place : places) {
        expect_error(Exit::usage, (place / name).string() + ": not a PNG", load);
        write(place / name, png.size());
        EXPECT_EQ(load()->rgba, texels);
        std::filesystem::remove(place / name);
    }
    expect_error(Exit::usage,
                 fmt::format("{}: cannot read the image: No such file or directory; looked in {}, "
                             "{}, {}",
                             name, places[0].string(), places[1].string(), places[2].string()),
                 load);
}

TEST(Bitmap, IsLookedForBesideTheSourceThatCalls) {
    const std::string source = std::filesystem::path(__FILE__).parent_path().string();
    expect_error(Exit::usage, source, [] { (void)load_bitmap("missing.png"); });
}

TEST(Bitmap, OfAnAbsolutePathIsInOnePlace) {
    const Folder folder;
    const std::string path = folder / "missing.png";
    EXPECT_EQ(line_of_error(Exit::usage, [&] { (void)load_bitmap(path); }),
              path + ": cannot read the image: No such file or directory");
}

float length_of(const std::vector<Point>& line) {
    float sum = 0;
    for (std::size_t i = 1; i < line.size(); ++i)
        sum += std::hypot(line[i].x - line[i - 1].x, line[i].y - line[i - 1].y);
    return sum;
}

TEST(Rope, HangsBetweenItsEndsWithItsLength) {
    // 5 m apart: straight from a length of 5 m down, then sagging.
    for (const float length : {1.0F, 5.0F}) {
        const std::vector<Point> taut = rope({0, 0}, {3, 4}, length);
        EXPECT_NEAR(length_of(taut), 5, 1e-5);
        EXPECT_NEAR(taut[12].y, 2, 1e-6);
    }
    for (const float length : {5.1F, 6.0F, 20.0F, 500.0F}) {
        const std::vector<Point> slack = rope({0, 0}, {3, 0}, length);
        EXPECT_EQ(slack.size(), rope({0, 0}, {3, 4}, 5).size());
        EXPECT_LE(length_of(slack), length);
        EXPECT_GE(length_of(slack), length * 6 / 7);
        EXPECT_LT(slack[12].y, 0);
        EXPECT_NEAR(slack.back().x, 3, 1e-6);
    }
    // The arc length of a parabola of chord 1 and sag 0.1, from its integral: 1.02606.
    EXPECT_NEAR(length_of(rope({0, 0}, {1, 0}, std::sqrt(1 + 0.16F / 3))), 1.02606F, 1e-4);
}

}  // namespace
}  // namespace oiler::test
