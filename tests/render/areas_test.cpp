// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "oiler/picture/shapes.hpp"
#include "oiler/render/mesh.hpp"
#include "render/drawing.hpp"

// Polygons, sprites, layers and bars.
namespace oiler::test {
namespace {

constexpr Colour white{255, 255, 255, 255};

Picture of_polygon(std::vector<Point> points, Colour colour = {}) {
    Picture picture;
    picture.polygons.push_back(
        {.points = std::move(points), .colour = colour, .space = Space::canvas});
    return picture;
}

std::vector<Point> shifted(std::vector<Point> points, Point by) {
    for (Point& point : points) point = {point.x + by.x, point.y + by.y};
    return points;
}

/// Shoelace formula.
double area_of(const std::vector<Point>& points) {
    double twice = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Point a = points[i];
        const Point b = points[(i + 1) % points.size()];
        twice += double{a.x} * b.y - double{b.x} * a.y;
    }
    return std::abs(twice) / 2;
}

double perimeter_of(const std::vector<Point>& points) {
    double sum = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Point a = points[i];
        const Point b = points[(i + 1) % points.size()];
        sum += std::hypot(b.x - a.x, b.y - a.y);
    }
    return sum;
}

std::vector<std::vector<Point>> shapes() {
    std::vector<Point> star;
    for (int i = 0; i < 10; ++i) {
        const double angle = std::numbers::pi * i / 5 + 0.1;
        const double radius = i % 2 == 0 ? 80 : 35;
        star.push_back({static_cast<float>(200 + radius * std::cos(angle)),
                        static_cast<float>(150 + radius * std::sin(angle))});
    }
    return {rectangle({300, 200}, {120, 60}),
            rectangle({300, 200}, {120, 60}, 0.4F),
            rectangle({300.3F, 200.2F}, {7, 5}, 0.7F),
            regular_polygon({200, 150}, 60, 3),
            regular_polygon({200, 150}, 60, 24),
            arrow({100, 100}, {260, 180}, 10),
            star,
            {{100, 100}, {100, 200}, {180, 200}, {180, 180}, {120, 180}, {120, 100}}};  // clockwise
}

TEST_F(Drawing, APolygonCoversItsArea) {
    for (const std::vector<Point>& shape : shapes()) {
        const double area =
            mean_coverage([&](Point shift) { return of_polygon(shifted(shape, shift)); });
        // The soft edge rounds at most each pixel of the outline. At a corner it covers too much or
        // too little of a fraction of a pixel.
        const double corners = 0.15 * static_cast<double>(shape.size());
        EXPECT_NEAR(area, area_of(shape), perimeter_of(shape) * blend_rounding + corners)
            << shape.size() << " corners, the first at " << shape[0].x;
    }
}

TEST_F(Drawing, APolygonOnPixelEdgesIsSharp) {
    const Pixels pixels = draw(of_polygon(rectangle({150, 120}, {20, 10})));
    for (const int x : {140, 150, 159})
        for (const int y : {115, 124}) EXPECT_EQ(coverage(pixels, x, y), 1) << x << ' ' << y;
    const Ink box = ink(pixels);
    EXPECT_EQ(box.left, 140);
    EXPECT_EQ(box.right, 160);
    EXPECT_EQ(box.bottom, 115);
    EXPECT_EQ(box.top, 125);
}

// Its triangles meet without a seam and do not overlap: a translucent area has one shade.
TEST_F(Drawing, ATranslucentPolygonHasOneShade) {
    const Pixels pixels = draw(of_polygon(shapes()[6], {0, 0, 0, 100}));
    int inside = 0;
    for (int y = 110; y < 190; ++y)
        for (int x = 160; x < 240; ++x)
            if (std::hypot(x + 0.5 - 200, y + 0.5 - 150) < 26) {
                EXPECT_NEAR(coverage(pixels, x, y), 100 / 255.0, blend_rounding) << x << ' ' << y;
                ++inside;
            }
    EXPECT_GT(inside, 2000);
}

TEST_F(Drawing, ANarrowPolygonFades) {
    for (const float width : {0.1F, 0.3F, 0.6F}) {
        const double area = mean_coverage([&](Point shift) {
            return of_polygon(shifted(rectangle({200, 100}, {100, width}, 0.3F), shift));
        });
        // Its outline is drawn on both sides: two lines of the strength s cover 1 - (1 - s)², up to
        // s² less than twice as much, and their ends are round.
        EXPECT_NEAR(area, 100.0 * width, 100.0 * width * width / 4 + 100 * 2 * blend_rounding + 1)
            << width;
    }
}

TEST_F(Drawing, APolygonLargerThanTheFrameFillsIt) {
    for (const float size : {1e4F, 1e9F, 1e30F})
        for (const float side : {-size, size}) {
            const Pixels pixels =
                draw(of_polygon({{-size, side}, {size, side}, {size, 180}, {-size, 180}}));
            EXPECT_EQ(total_coverage(pixels), 640.0 * 180) << side;
        }
}

TEST_F(Drawing, APolygonThatIsNotFiniteIsNotDrawn) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const std::vector<Point>& points : std::vector<std::vector<Point>>{
             {},
             {{1, 1}},
             {{1, 1}, {90, 1}},
             {{1, 1}, {90, 1}, {nan, 90}},
             {{1, 1}, {90, 1}, {50, std::numeric_limits<float>::infinity()}}})
        EXPECT_EQ(total_coverage(draw(of_polygon(points))), 0) << points.size();
}

// An outline that crosses itself is wrong input; it must end, and stay within its box.
TEST_F(Drawing, ABowTieStaysWithinItsBox) {
    const Pixels pixels = draw(of_polygon({{100, 100}, {200, 180}, {200, 100}, {100, 180}}));
    const Ink box = ink(pixels);
    EXPECT_GE(box.left, 95);
    EXPECT_LE(box.right, 205);
}

TEST_F(Drawing, AnOutlineLiesOnTheEdge) {
    Picture picture = of_polygon(rectangle({150, 120}, {40, 40}), {0, 0, 0, 0});
    picture.polygons[0].outline = 4;
    const Pixels pixels = draw(picture);
    EXPECT_EQ(coverage(pixels, 150, 120), 0) << "the area has no colour";
    for (const int x : {128, 131, 168, 171}) EXPECT_EQ(coverage(pixels, x, 120), 1) << x;
    for (const int x : {127, 132, 167, 172}) EXPECT_EQ(coverage(pixels, x, 120), 0) << x;
}

/// A bitmap of 2 × 2 texels: black and white on top, grey and transparent black below.
std::shared_ptr<const Bitmap> four_texels() {
    return make_bitmap({2, 2}, {0, 0, 0, 255, 255, 255, 255, 255,  //
                                128, 128, 128, 255, 0, 0, 0, 0});
}

Picture of_sprite(Sprite sprite) {
    Picture picture;
    if (!sprite.bitmap) sprite.bitmap = four_texels();
    sprite.space = Space::canvas;
    picture.sprites.push_back(std::move(sprite));
    return picture;
}

TEST_F(Drawing, ASpriteShowsItsTexelsTheRightWayUp) {
    const Pixels pixels =
        draw(of_sprite({.centre = {100, 100}, .size = {20, 20}, .is_smooth = false}));
    EXPECT_EQ(red(pixels, 92, 108), 0) << "top left";
    EXPECT_EQ(red(pixels, 108, 108), 255);
    EXPECT_EQ(red(pixels, 92, 92), 128);
    EXPECT_EQ(red(pixels, 108, 92), 255) << "transparent";
    EXPECT_EQ(red(pixels, 89, 108), 255) << "beside it";
    EXPECT_EQ(red(pixels, 90, 109), 0) << "its corner";
    EXPECT_EQ(red(pixels, 99, 101), 0) << "a sharp edge between texels";
    EXPECT_EQ(red(pixels, 100, 101), 255);
}

TEST_F(Drawing, ASpriteOfNegativeSizeIsMirrored) {
    Picture picture = of_sprite({.centre = {100, 100}, .size = {-20, 20}, .is_smooth = false});
    Pixels pixels = draw(picture);
    EXPECT_EQ(red(pixels, 108, 108), 0) << "the top left texel is at the top right";
    EXPECT_EQ(red(pixels, 92, 108), 255);
    EXPECT_EQ(red(pixels, 108, 92), 128);
    picture.sprites[0].size = {20, -20};
    pixels = draw(picture);
    EXPECT_EQ(red(pixels, 92, 92), 0) << "the top left texel is at the lower left";
    EXPECT_EQ(red(pixels, 92, 108), 128);
}

// Smooth or not, the texels beside the part do not shine through its border.
TEST_F(Drawing, ASpriteShowsAPartOfItsBitmap) {
    for (const bool is_smooth : {false, true})
        for (const float mirror : {1.0F, -1.0F}) {
            const Pixels pixels = draw(of_sprite({.centre = {100, 100},
                                                  .size = {20 * mirror, 20},
                                                  .is_smooth = is_smooth,
                                                  .part = BitmapPart{0, 1, {1, 1}}}));
            for (const int x : {91, 100, 108})
                for (const int y : {91, 100, 108}) EXPECT_EQ(red(pixels, x, y), 128) << x;
        }
}

// Each of two soft edges would cover half a pixel, and let a quarter of the background through.
TEST_F(Drawing, TilesOfPixelArtHaveNoSeams) {
    Picture picture;
    for (int i = 0; i < 40; ++i)
        picture.sprites.push_back({.centre = {50 + 7.3F * static_cast<float>(i), 100.4F},
                                   .size = {7.3F, 9.7F},
                                   .bitmap = make_bitmap({1, 1}, {0, 0, 0, 255}),
                                   .space = Space::canvas,
                                   .is_smooth = false});
    const Pixels pixels = draw(picture);
    for (int x = 50; x < 320; ++x) EXPECT_EQ(red(pixels, x, 100), 0) << x;
    for (const int y : {94, 95, 96, 104, 105, 106}) {
        const int edge = red(pixels, 100, y);
        EXPECT_TRUE(edge == 0 || edge == 255) << "a whole pixel at " << y;
    }
    picture.sprites.resize(1);
    picture.sprites[0].size = {0.1F, 0.1F};
    const Pixels small = draw(picture);
    EXPECT_EQ(red(small, 50, 100), 0) << "it does not vanish";
    EXPECT_EQ(red(small, 49, 100) + red(small, 51, 100), 2 * 255);
}

TEST_F(Drawing, ASpriteTurnsCounterClockwise) {
    const Pixels pixels = draw(of_sprite({.centre = {100, 100},
                                          .size = {20, 20},
                                          .angle = std::numbers::pi_v<float> / 2,
                                          .is_smooth = false}));
    EXPECT_EQ(red(pixels, 92, 92), 0) << "the top left texel is now at the lower left";
    EXPECT_EQ(red(pixels, 92, 108), 255);
    EXPECT_EQ(red(pixels, 108, 92), 128);
}

TEST_F(Drawing, ASpriteCoversItsAreaAtAnyAngle) {
    const auto black = make_bitmap({1, 1}, {0, 0, 0, 255});
    for (const float angle : {0.0F, 0.3F, 1.1F}) {
        const double area = mean_coverage([&](Point shift) {
            return of_sprite({.centre = {200 + shift.x, 100 + shift.y},
                              .size = {60, 31},
                              .bitmap = black,
                              .angle = angle});
        });
        EXPECT_NEAR(area, 60 * 31, 2 * (60 + 31) * blend_rounding + 1) << angle;
    }
}

TEST_F(Drawing, ASpriteHasATintAndAnOpacity) {
    Picture picture = of_sprite({.centre = {100, 100},
                                 .size = {20, 20},
                                 .bitmap = make_bitmap({1, 1}, {200, 100, 50, 255}),
                                 .colour = {128, 255, 0, 255}});
    Pixels pixels = draw(picture);
    const auto at = [&](std::size_t channel) {
        return int{pixels.rgb[(std::size_t{100} * 640 + 100) * 3 + channel]};
    };
    EXPECT_NEAR(at(0), 100, 1);  // 200 · 128/255
    EXPECT_NEAR(at(1), 100, 1);
    EXPECT_EQ(at(2), 0);
    picture.sprites[0].colour = {255, 255, 255, 51};
    pixels = draw(picture);
    EXPECT_NEAR(at(0), 255 - 55 * 0.2, 1);
    EXPECT_NEAR(at(2), 255 - 205 * 0.2, 1);
}

// A chequerboard that is shrunk to less than a pixel per field is grey without a pattern.
TEST_F(Drawing, AShrunkenSpriteShowsTheMeanOfItsTexels) {
    std::vector<std::uint8_t> rgba;
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 256; ++x) {
            const std::uint8_t shade = (x + y) % 2 == 0 ? 0 : 255;
            rgba.insert(rgba.end(), {shade, shade, shade, 255});
        }
    const auto board = make_bitmap({256, 256}, std::move(rgba));
    for (const float size : {40.0F, 70.0F, 130.0F}) {
        const Pixels pixels =
            draw(of_sprite({.centre = {100, 100}, .size = {size, size}, .bitmap = board}));
        for (int x = 85; x < 115; ++x) EXPECT_NEAR(red(pixels, x, 100), 127.5, 20) << size;
    }
}

TEST_F(Drawing, ASpriteThatIsNotDrawableIsLeftOut) {
    Picture picture = of_sprite({.centre = {100, 100}, .size = {20, 20}});
    const auto drawn = [&](const auto& change) {
        Picture changed = picture;
        change(changed.sprites[0]);
        return total_coverage(draw(changed));
    };
    EXPECT_GT(drawn([](Sprite&) {}), 100);
    EXPECT_EQ(drawn([](Sprite& s) { s.bitmap.reset(); }), 0);
    EXPECT_EQ(drawn([](Sprite& s) { s.size.x = 0; }), 0);
    EXPECT_EQ(drawn([](Sprite& s) { s.angle = std::numeric_limits<float>::infinity(); }), 0);
    EXPECT_EQ(drawn([](Sprite& s) { s.centre.x = 1e6F; }), 0);
}

// A game that makes a new bitmap in each picture must not fill the memory or see an old one.
TEST_F(Drawing, ANewBitmapReplacesTheOldOne) {
    const auto is_texture =
        reinterpret_cast<unsigned char (*)(unsigned)>(studio_->surface->procedure("glIsTexture"));
    const auto textures = [&] {
        int count = 0;
        for (unsigned name = 1; name < 100; ++name) count += is_texture(name);
        return count;
    };
    int first = 0;
    for (int i = 0; i < 20; ++i) {
        const auto shade = static_cast<std::uint8_t>(10 * i);
        const Pixels pixels = draw(of_sprite({.centre = {100, 100},
                                              .size = {20, 20},
                                              .bitmap = make_bitmap({1, 1}, {shade, 0, 0, 255})}));
        EXPECT_EQ(red(pixels, 100, 100), shade);
        if (i == 0) first = textures();
        EXPECT_EQ(textures(), first);
    }
}

TEST_F(Drawing, HigherLayersCoverLowerOnes) {
    Picture picture;
    picture.discs.push_back(
        {.centre = {100, 100}, .radius = 10, .space = Space::canvas, .layer = -1});
    picture.polygons.push_back(
        {.points = rectangle({100, 100}, {8, 8}), .colour = white, .space = Space::canvas});
    Pixels pixels = draw(picture);
    EXPECT_EQ(red(pixels, 100, 100), 255) << "the polygon covers the disc";
    EXPECT_EQ(red(pixels, 107, 100), 0);
    picture.discs[0].layer = 0;
    pixels = draw(picture);
    EXPECT_EQ(red(pixels, 100, 100), 0) << "in a layer, discs come after polygons";
    picture.sprites.push_back({.centre = {100, 100},
                               .size = {4, 4},
                               .bitmap = make_bitmap({1, 1}, {200, 0, 0, 255}),
                               .space = Space::canvas,
                               .layer = 3});
    picture.labels.push_back(
        {.at = {95, 95}, .text = "\u2588", .size = 20, .colour = white, .layer = 2});
    pixels = draw(picture);
    EXPECT_EQ(red(pixels, 100, 100), 200) << "a sprite covers a label of a lower layer";
}

TEST_F(Drawing, BarsHideWhatIsBesideTheCanvas) {
    Picture picture;
    picture.has_bars = true;
    picture.background = {200, 200, 200, 255};
    picture.camera = {{0, 0}, 36};
    picture.discs.push_back({.centre = {-35, 0}, .radius = 5, .colour = {100, 0, 0, 255}});
    const Pixels wide = draw(picture, {1000, 360});
    EXPECT_EQ(red(wide, 179, 180), 0) << "the bar";
    EXPECT_EQ(red(wide, 180, 50), 200) << "the canvas begins";
    EXPECT_EQ(red(wide, 181, 180), 100) << "the disc within the canvas";
    EXPECT_EQ(red(wide, 819, 50), 200);
    EXPECT_EQ(red(wide, 820, 50), 0);
    picture.has_bars = false;
    EXPECT_EQ(red(draw(picture, {1000, 360}), 170, 180), 100);
}

TEST_F(Drawing, TextInMetresGrowsWithTheZoom) {
    Picture picture;
    picture.camera = {{0, 0}, 36};
    picture.labels.push_back(
        {.at = {0, 0}, .text = "H", .size = 4, .space = Space::world, .size_in = Space::world});
    const Ink far = ink(draw(picture));
    picture.camera.height = 18;
    const Ink near = ink(draw(picture));
    EXPECT_NEAR(near.top - near.bottom, 2 * (far.top - far.bottom), 2);
    EXPECT_NEAR(far.top - far.bottom, 0.729 * 40, 1) << "a capital of DejaVu is 0.729 em high";
}

// A square of 10 × 6 pixels at (100, 50) from the upper left, cut to 4 × 4; frames begin with their
// bottom row. Its texels are half red, half blue.
TEST_F(Drawing, AnOverlayIsDrawnOverAFrameWithinItsBox) {
    const Picture blank;
    (void)draw(blank);
    constexpr Colour ink_of_overlay{255, 255, 255, 255};
    const Overlay overlay{.vertices = {{{100, 50}, {0.25F, 0.5F}, ink_of_overlay},
                                       {{110, 50}, {0.25F, 0.5F}, ink_of_overlay},
                                       {{110, 56}, {0.25F, 0.5F}, ink_of_overlay},
                                       {{100, 56}, {0.25F, 0.5F}, ink_of_overlay},
                                       {{0, 0}, {0.75F, 0.5F}, {0, 0, 255, 51}},
                                       {{4, 0}, {0.75F, 0.5F}, {0, 0, 255, 51}},
                                       {{4, 4}, {0.75F, 0.5F}, {0, 0, 255, 51}}},
                          .indices = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 5},
                          .parts = {{0, 6, 100, 40, 104, 54}, {6, 3, 0, 0, 640, 360}},
                          .bitmap = make_bitmap({2, 1}, {255, 0, 0, 255, 255, 255, 255, 255})};
    studio_->renderer.draw_over(overlay);
    Pixels pixels;
    studio_->renderer.read(pixels);
    const auto is = [&](int x, int y_from_top, int r, int g, int b) {
        const std::size_t at =
            3 * (640 * static_cast<std::size_t>(359 - y_from_top) + static_cast<std::size_t>(x));
        return pixels.rgb[at] == r && pixels.rgb[at + 1] == g && pixels.rgb[at + 2] == b;
    };
    int reds = 0;
    for (int y = 0; y < 360; ++y)
        for (int x = 0; x < 640; ++x) reds += is(x, y, 255, 0, 0) ? 1 : 0;
    EXPECT_EQ(reds, 4 * 4);
    EXPECT_TRUE(is(100, 50, 255, 0, 0) && is(103, 53, 255, 0, 0));
    EXPECT_TRUE(is(3, 0, 204, 204, 255)) << "a fifth of blue over white";
    EXPECT_TRUE(is(200, 200, 255, 255, 255));
    Pixels again = draw(blank);
    EXPECT_TRUE(std::ranges::all_of(again.rgb, [](int part) { return part == 255; }))
        << "nothing stays";
}

}  // namespace
}  // namespace oiler::test
