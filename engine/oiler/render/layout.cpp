// SPDX-License-Identifier: MIT
#include "oiler/render/layout.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "oiler/render/mesh.hpp"

namespace oiler {
namespace {

// Pixels. A glyph must fit into a row of the atlas, and larger letters fill any frame.
constexpr int largest_em = 512;

/// Maps a picture's spaces to the pixels of a frame, with the lower left corner at (0, 0).
class Mapping {
public:
    Mapping(const Picture& picture, Size frame)
        : camera_(picture.camera),
          middle_{static_cast<float>(frame.width) / 2, static_cast<float>(frame.height) / 2},
          scale_(std::min(static_cast<float>(frame.width) / canvas_width,
                          static_cast<float>(frame.height) / canvas_height)) {
        if (!picture.has_bars)
            beside_ = {middle_.x - canvas_width / 2 * scale_,
                       middle_.y - canvas_height / 2 * scale_};
    }

    [[nodiscard]] Point pixel(Point p, Space space) const {
        const Point canvas = space == Space::world ? camera_.to_canvas(p) : p;
        const Point side = side_of(space);
        return {middle_.x + (canvas.x - canvas_width / 2) * scale_ + side.x * beside_.x,
                middle_.y + (canvas.y - canvas_height / 2) * scale_ + side.y * beside_.y};
    }

    [[nodiscard]] float pixels(float length, Space space) const {
        return space == Space::world ? length * (canvas_height / camera_.height) * scale_
                                     : length * scale_;
    }

private:
    Camera camera_;
    Point middle_;
    float scale_;
    Point beside_{};  ///< pixels of the frame on each side of the canvas, where corners move to
};

std::vector<Point> pixels_of(const std::vector<Point>& points, Space space,
                             const Mapping& mapping) {
    std::vector<Point> pixels;
    pixels.reserve(points.size());
    for (const Point& point : points) pixels.push_back(mapping.pixel(point, space));
    return pixels;
}

bool is_near(Point p, Size frame, float reach) {
    // False for NaN.
    return p.x > -reach && p.x < static_cast<float>(frame.width) + reach && p.y > -reach &&
           p.y < static_cast<float>(frame.height) + reach;
}

bool runs_along_axes(const Polyline& line) {
    for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
        const Point from = line.points[i];
        const Point to = line.points[i + 1];
        if (from.x != to.x && from.y != to.y) return false;
    }
    return true;
}

/// Snaps an axis, a tick or a frame to pixel edges, by at most half a pixel: a line of one pixel
/// between two rows would be two rows of grey. World-space lines move, so they are not snapped.
/// Curves may be flat too, but have more points.
void snap(const Polyline& line, float width, std::vector<Point>& points) {
    constexpr std::size_t most_corners = 5;
    if (line.space == Space::world || points.size() > most_corners || !runs_along_axes(line))
        return;
    const bool odd = std::lround(std::clamp(width, 1.0F, 1e3F)) % 2 != 0;
    for (Point& p : points) {
        p = odd ? Point{std::floor(p.x) + 0.5F, std::floor(p.y) + 0.5F}
                : Point{std::round(p.x), std::round(p.y)};
    }
}

/// The first texel of a row or column of a sprite, and their number, negative if it is mirrored.
std::pair<float, float> texels(int first, int count, bool is_mirrored) {
    const auto from = static_cast<float>(is_mirrored ? first + count : first);
    return {from, static_cast<float>(is_mirrored ? -count : count)};
}

/// Rounds the ends of an interval, given by its middle and half its length, to whole pixels, at
/// least one apart.
void snap(float& middle, float& half) {
    const float low = std::round(middle - half);
    const float high = std::max(std::round(middle + half), low + 1);
    middle = (low + high) / 2;
    half = (high - low) / 2;
}

void lay_out_sprite(const Sprite& sprite, const Mapping& mapping, Size frame, Layout& layout) {
    Point centre = mapping.pixel(sprite.centre, sprite.space);
    Point half{mapping.pixels(std::abs(sprite.size.x), sprite.space) / 2,
               mapping.pixels(std::abs(sprite.size.y), sprite.space) / 2};
    const float reach = std::hypot(half.x, half.y);
    const bool is_drawable = sprite.bitmap && half.x > 0 && half.y > 0 && std::isfinite(reach) &&
                             std::isfinite(sprite.angle);
    if (!is_drawable || !is_near(centre, frame, reach + 1)) return;
    if (!sprite.is_smooth && sprite.angle == 0) {
        snap(centre.x, half.x);
        snap(centre.y, half.y);
    }
    const BitmapPart part = sprite.part.value_or(BitmapPart{0, 0, sprite.bitmap->size});
    const auto [x, width] = texels(part.left, part.size.width, sprite.size.x < 0);
    const auto [y, height] = texels(part.top, part.size.height, sprite.size.y < 0);
    layout.sprites.push_back({centre,
                              half,
                              {std::cos(sprite.angle), std::sin(sprite.angle)},
                              sprite.is_smooth ? 1.0F : 0.0F,
                              {x, y},
                              {width, height},
                              sprite.colour});
    layout.bitmaps.push_back(sprite.bitmap.get());
}

void lay_out_polygon(const Polygon& polygon, const Mapping& mapping, Size frame, LineMesh& mesh) {
    std::vector<Point> points = pixels_of(polygon.points, polygon.space, mapping);
    append_polygon(points, polygon.colour, frame, mesh);
    if (points.empty() || !(polygon.outline > 0)) return;
    points.push_back(Point(points.front()));
    append_polyline(points,
                    {mapping.pixels(polygon.outline, Space::canvas), polygon.outline_colour}, frame,
                    mesh);
}

void lay_out_line(const Polyline& line, const Mapping& mapping, Size frame, LineMesh& mesh) {
    std::vector<Point> points = pixels_of(line.points, line.space, mapping);
    const Stroke stroke{mapping.pixels(line.width, Space::canvas), line.colour};
    snap(line, stroke.width, points);
    append_polyline(points, stroke, frame, mesh);
}

/// A disc whose soft edge, one pixel wide, covers π·r² pixels. The integral over a ramp from R−½ to
/// R+½ is π(R² + 1/12). Below R = ½ the colour fades instead.
PlacedDisc with_soft_edge(Point centre, float radius, Colour colour) {
    const float square = radius * radius;
    const float smallest = 0.25F + 1.0F / 12;
    return {centre, std::sqrt(std::max(square, smallest) - 1.0F / 12),
            std::min(1.0F, square / smallest), colour};
}

void lay_out_disc(const Disc& disc, const Mapping& mapping, Size frame,
                  std::vector<PlacedDisc>& discs) {
    const Point centre = mapping.pixel(disc.centre, disc.space);
    const float radius = mapping.pixels(disc.radius, disc.space);
    if (radius > 0 && std::isfinite(radius) && is_near(centre, frame, radius + 1))
        discs.push_back(with_soft_edge(centre, radius, disc.colour));
}

void lay_out_label(const Label& label, const Mapping& mapping, Size frame, Glyphs& glyphs,
                   std::vector<PlacedGlyph>& placed) {
    const float em = std::round(mapping.pixels(label.size, label.size_in));
    const Point at = mapping.pixel(label.at, label.space);
    const float longest = 65536;  // pixels of text that may still reach into the frame
    if (em >= 1 && is_near(at, frame, longest))
        glyphs.place(label, at, static_cast<int>(std::min<float>(em, largest_em)), placed);
}

/// Calls f(element) for the elements of a list that are in a layer.
template <class Element, class F>
void each_in(int layer, const std::vector<Element>& elements, F f) {
    for (const Element& element : elements)
        if (element.layer == layer) f(element);
}

}  // namespace

std::vector<int> layers_of(const Picture& picture) {
    std::set<int> layers;
    const auto add = [&](const auto& elements) {
        int last = 0;
        bool any = false;
        for (const auto& element : elements) {
            if (any && element.layer == last) continue;
            layers.insert(last = element.layer);
            any = true;
        }
    };
    add(picture.sprites);
    add(picture.polygons);
    add(picture.polylines);
    add(picture.discs);
    add(picture.labels);
    return {layers.begin(), layers.end()};
}

void lay_out(const Picture& picture, int layer, Size frame, Glyphs& glyphs, Layout& layout) {
    const Mapping mapping(picture, frame);
    layout.sprites.clear();
    layout.bitmaps.clear();
    layout.lines.clear();
    layout.discs.clear();
    layout.glyphs.clear();
    each_in(layer, picture.sprites,
            [&](const Sprite& sprite) { lay_out_sprite(sprite, mapping, frame, layout); });
    each_in(layer, picture.polygons, [&](const Polygon& polygon) {
        lay_out_polygon(polygon, mapping, frame, layout.lines);
    });
    each_in(layer, picture.polylines,
            [&](const Polyline& line) { lay_out_line(line, mapping, frame, layout.lines); });
    each_in(layer, picture.discs,
            [&](const Disc& disc) { lay_out_disc(disc, mapping, frame, layout.discs); });
    glyphs.clear_if_full();
    each_in(layer, picture.labels, [&](const Label& label) {
        lay_out_label(label, mapping, frame, glyphs, layout.glyphs);
    });
}

CanvasBox canvas_box(Size frame) {
    const Mapping mapping({}, frame);
    const Point low = mapping.pixel({0, 0}, Space::canvas);
    const Point high = mapping.pixel({canvas_width, canvas_height}, Space::canvas);
    const auto left = static_cast<int>(std::lround(low.x));
    const auto bottom = static_cast<int>(std::lround(low.y));
    return {left,
            bottom,
            {static_cast<int>(std::lround(high.x)) - left,
             static_cast<int>(std::lround(high.y)) - bottom}};
}

}  // namespace oiler
