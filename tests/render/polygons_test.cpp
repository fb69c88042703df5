// SPDX-License-Identifier: MIT
#include <numbers>

#include "oiler/core/random.hpp"
#include "oiler/render/mesh.hpp"
#include "render/drawing.hpp"

// Concave polygons that the frame cuts, compared with the winding number of their outlines.
namespace oiler::test {
namespace {

using Outline = std::vector<Point>;

Point point(double x, double y) { return {static_cast<float>(x), static_cast<float>(y)}; }

/// The turns of the outline around a point. A crossing of the ray to the right counts.
int winding_number(const Outline& outline, double x, double y) {
    int turns = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Point a = outline[i];
        const Point b = outline[(i + 1) % outline.size()];
        if ((a.y <= y) == (b.y <= y)) continue;
        const double side = (double{b.x} - a.x) * (y - a.y) - (x - a.x) * (double{b.y} - a.y);
        if (b.y > a.y && side > 0) ++turns;
        if (b.y < a.y && side < 0) --turns;
    }
    return turns;
}

/// Radii at random angles around a point: any other point of the area sees that one.
Outline star(Random& random, Point centre, double size) {
    const auto corners = 5 + random.below(30);
    Outline outline;
    for (std::uint64_t i = 0; i < corners; ++i) {
        const double angle = 2 * std::numbers::pi * (static_cast<double>(i) + random.fraction()) /
                             static_cast<double>(corners);
        const double radius = size * random.uniform(0.05, 1);
        outline.push_back(
            point(centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)));
    }
    return outline;
}

/// Teeth of random lengths on a back, turned by a random angle.
Outline comb(Random& random, Point centre, double size) {
    const auto teeth = 2 + random.below(8);
    const double angle = random.chance(0.5) ? 0 : random.uniform(0, 2 * std::numbers::pi);
    const auto at = [&](double along, double up) {
        along = size * (2 * along / static_cast<double>(teeth) - 1);
        return point(centre.x + along * std::cos(angle) - size * up * std::sin(angle),
                     centre.y + along * std::sin(angle) + size * up * std::cos(angle));
    };
    Outline outline{at(static_cast<double>(teeth), -1), at(0, -1)};
    std::swap(outline[0], outline[1]);
    for (std::uint64_t i = teeth; i-- > 0;) {
        const auto left = static_cast<double>(i);
        const double up = random.uniform(-0.6, 1);
        const double down = random.uniform(-0.9, -0.7);
        for (const auto& [along, height] :
             {std::pair{0.95, down}, {0.9, up}, {random.uniform(0.4, 0.9), up}, {0.35, down}})
            outline.push_back(at(left + along, height));
    }
    return outline;
}

/// A band between r = a·θ and r = a·(θ + w), w < 2π.
Outline spiral(Random& random, Point centre, double size) {
    const double turns = random.uniform(1, 4);
    const double width = random.uniform(0.2, 0.8);
    const double start = random.uniform(0, 2 * std::numbers::pi);
    const auto count = static_cast<int>(turns * 12);
    Outline outline;
    const auto add = [&](int i, double beyond) {
        const double turn = turns * i / count;
        const double radius = size * (turn + beyond + 0.2) / (turns + 1);
        const double angle = start + 2 * std::numbers::pi * turn;
        outline.push_back(
            point(centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)));
    };
    for (int i = 0; i <= count; ++i) add(i, width);
    for (int i = count; i >= 0; --i) add(i, 0);
    return outline;
}

/// The ground of a platformer as first drawn, in pixels: a pit, and walls beside the frame.
Outline ground_with_a_pit() {
    Outline outline;
    for (const auto& [x, y] : std::initializer_list<std::pair<double, double>>{{-16, 20},
                                                                               {-16, -12},
                                                                               {16, -12},
                                                                               {16, 20},
                                                                               {14, 20},
                                                                               {14, 0.8},
                                                                               {6.5, 0.8},
                                                                               {6.5, -9},
                                                                               {-1.5, -9},
                                                                               {-1.5, 1.6},
                                                                               {-4.5, 1.6},
                                                                               {-8, 0},
                                                                               {-14, 0},
                                                                               {-14, 20}})
        outline.push_back(point(320 + x * 360 / 15.75, 180 + (y - 5.5) * 360 / 15.75));
    return outline;
}

constexpr std::uint8_t translucent = 100;

class Polygons : public Drawing {
protected:
    /// Pixels without the shade of the area within the outline (pixels), or with it outside.
    /// Pixels that the soft edge may reach do not count: it reaches half a pixel from the outline,
    /// and four from an acute corner, and a pixel is 0.7 pixels from its centre to its corner.
    int wrong_pixels(const Outline& outline, Size frame, int stride = 1,
                     std::uint8_t alpha = translucent) {
        Picture picture;
        const double scale = std::min(frame.width / 640.0, frame.height / 360.0);
        Outline canvas;
        for (const Point& p : outline)
            canvas.push_back(point(320 + (p.x - frame.width / 2.0) / scale,
                                   180 + (p.y - frame.height / 2.0) / scale));
        picture.polygons.push_back(
            {.points = canvas, .colour = {0, 0, 0, alpha}, .space = Space::canvas});
        const Pixels pixels = draw(picture, frame);
        Outline closed = outline;
        closed.push_back(Point(outline.front()));
        int wrong = 0;
        for (int row = 0; row < frame.height; row += stride)
            for (int column = 0; column < frame.width; column += stride) {
                const double x = column + 0.5;
                const double y = row + 0.5;
                const double shade = winding_number(outline, x, y) != 0 ? alpha / 255.0 : 0;
                if (std::abs(coverage(pixels, column, row) - shade) <= blend_rounding) continue;
                const bool is_near_corner = std::ranges::any_of(outline, [&](const Point& corner) {
                    return std::hypot(corner.x - x, corner.y - y) <= 4.8;
                });
                if (!is_near_corner && distance_to_line(x, y, closed) > 1.3) ++wrong;
            }
        return wrong;
    }
};

TEST_F(Polygons, TheGroundOfAPlatformerHasAPit) {
    EXPECT_EQ(wrong_pixels(ground_with_a_pit(), {640, 360}), 0);
}

TEST(Polygon, BesideTheFrameAddsNothing) {
    for (const Point beside : {Point{-200, 0}, Point{700, 0}, Point{0, -200}, Point{0, 500}}) {
        LineMesh mesh;
        append_polygon(std::vector<Point>{beside,
                                          {beside.x + 90, beside.y},
                                          {beside.x + 40, beside.y + 40},
                                          {beside.x, beside.y + 90}},
                       {}, {640, 360}, mesh);
        EXPECT_TRUE(mesh.vertices.empty()) << beside.x << ' ' << beside.y;
    }
}

// At the tip, the mitres of the short edge cross.
TEST_F(Polygons, AShortEdgeLeavesTheRestAsItIs) {
    EXPECT_EQ(wrong_pixels({{100, 100}, {300, 100}, {200.2F, 300}, {199.8F, 300}}, {640, 360}), 0);
}

// The neck is narrower than its soft edges, which cross.
TEST_F(Polygons, ANarrowNeckJoinsWideAreas) {
    for (const float narrow : {0.2F, 0.6F})
        EXPECT_EQ(wrong_pixels({{100, 100},
                                {200, 100},
                                {200, 150},
                                {300, 150},
                                {300, 100},
                                {400, 100},
                                {400, 200},
                                {300, 200},
                                {300, 150 + narrow},
                                {200, 150 + narrow},
                                {200, 200},
                                {100, 200}},
                               {640, 360}, 1, 255),
                  0)
            << narrow;
}

TEST_F(Polygons, ConcavePolygonsLargerThanTheFrame) {
    Random random(7);
    for (int i = 0; i < 300; ++i) {
        const Size frame =
            std::array{Size{640, 360}, Size{320, 180}, Size{200, 300}}[random.below(3)];
        const Point centre = point(random.uniform(-0.2, 1.2) * frame.width,
                                   random.uniform(-0.2, 1.2) * frame.height);
        const double size = frame.width * std::pow(10, random.uniform(-1.5, 6));
        const auto shape = std::array{star, comb, spiral}[static_cast<std::size_t>(i % 3)];
        EXPECT_EQ(wrong_pixels(shape(random, centre, size), frame, 3), 0)
            << std::array{"star ", "comb ", "spiral "}[static_cast<std::size_t>(i % 3)] << i << ", "
            << frame.width << "x" << frame.height << ", size " << size;
    }
}

}  // namespace
}  // namespace oiler::test
