// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "oiler/picture/bitmap.hpp"

namespace oiler {

struct Point {
    float x = 0;
    float y = 0;
    friend bool operator==(const Point&, const Point&) = default;
    template <class Hash>
    void hash(Hash& hash) const {
        hash.add(x, y);
    }
};

/// Eight bits per channel, not premultiplied.
struct Colour {
    std::uint8_t r = 0;
    std::uint8_t g = 0;
    std::uint8_t b = 0;
    std::uint8_t a = 255;
    friend bool operator==(const Colour&, const Colour&) = default;
};

/// The canvas is a box of 640 × 360 units, origin at its lower left, y up. It is centred in the
/// frame, always wholly visible, and as large as possible. One unit is a pixel at 640 × 360.
/// `Picture::has_bars` decides what frames of another shape show beside it.
inline constexpr float canvas_width = 640;
inline constexpr float canvas_height = 360;

/// The coordinates of an element's points.
enum class Space : std::uint8_t {
    world,   ///< metres, shown by the picture's camera
    canvas,  ///< units of the canvas
    // The canvas, moved to a corner or an edge of the frame: a score stays in its corner, whatever
    // the shape of the window. A picture with bars has nothing beside its canvas, so there it
    // stays.
    upper_left,
    top,
    upper_right,
    lower_left,
    bottom,
    lower_right,
};

/// The side of the frame that a space holds to, from −1 (left, bottom) to 1 along each axis; 0: the
/// middle.
[[nodiscard]] Point side_of(Space space);

/// Matches the elements of two successive pictures for interpolation. An element without an object
/// (0) has no match and jumps. A teleported body changes `jump`, so that it does not streak across
/// the screen.
struct ElementKey {
    std::uint64_t object = 0;
    std::uint32_t part = 0;
    std::uint32_t jump = 0;
    friend bool operator==(const ElementKey&, const ElementKey&) = default;
};

/// A part of a bitmap, in texels from its upper left corner.
struct BitmapPart {
    int left = 0;
    int top = 0;
    Size size;
    friend bool operator==(const BitmapPart&, const BitmapPart&) = default;
};

/// An image.
struct Sprite {
    ElementKey key{};
    Point centre{};
    /// Width and height in the element's space; a negative one mirrors the image.
    Point size{1, 1};
    std::shared_ptr<const Bitmap> bitmap{};
    float angle = 0;                    ///< rad, counter-clockwise
    Colour colour{255, 255, 255, 255};  ///< a tint: the bitmap's colours are multiplied by it
    Space space = Space::world;
    int layer = 0;
    /// false: as in pixel art, magnified texels have sharp edges, and a sprite that is not turned
    /// ends at whole pixels, so that tiles have no seams.
    bool is_smooth = true;
    std::optional<BitmapPart> part{};  ///< the whole bitmap if absent
};

/// A filled area whose outline does not cross itself.
struct Polygon {
    ElementKey key{};
    std::vector<Point> points{};
    Colour colour{};
    float outline = 0;  ///< width of the outline in units of the canvas; 0: none
    Colour outline_colour{};
    Space space = Space::world;
    int layer = 0;
};

struct Polyline {
    ElementKey key{};
    std::vector<Point> points{};
    float width = 1;  ///< always in units of the canvas
    Colour colour{};
    Space space = Space::world;
    int layer = 0;
};

struct Disc {
    ElementKey key{};
    Point centre{};
    float radius = 1;  ///< in the element's space
    Colour colour{};
    Space space = Space::world;
    int layer = 0;
};

enum class Align : std::uint8_t { left, centre, right };

/// A line of text. `at` is on the baseline, at the end or the middle that `align` selects. Between
/// two steps the label shows the text of the earlier step.
struct Label {
    ElementKey key{};
    Point at{};
    std::string text{};  ///< UTF-8
    float size = 12;     ///< height of the font in units of `size_in`
    Colour colour{};
    Align align = Align::left;
    Space space = Space::canvas;
    Space size_in = Space::canvas;
    int layer = 0;
};

/// The canvas shows `height` metres of the world around `centre`.
struct Camera {
    Point centre{};
    float height = 10;

    [[nodiscard]] Point to_canvas(Point world) const;
    [[nodiscard]] Point to_world(Point canvas) const;
    /// Moves the centre towards a target: to half of the distance within `half_life` s, whatever
    /// the timestep `dt`, s, is. A half-life of 0 moves it there at once.
    void follow(Point target, double half_life, double dt);
    /// Multiplies the height by a factor; the point `fixed` of the world keeps its place in view.
    void zoom(float factor, Point fixed);
    friend bool operator==(const Camera&, const Camera&) = default;
};

/// A frame as a value: a renderer draws it, a test compares it, the loop interpolates it between
/// two steps. Higher layers are drawn over lower ones; in a layer sprites come first, then
/// polygons, polylines, discs and labels, each in the order of its list. Elements with a number
/// that is not finite are not drawn; polylines have a gap there.
struct Picture {
    Colour background{255, 255, 255, 255};
    Camera camera{};
    std::vector<Sprite> sprites{};
    std::vector<Polygon> polygons{};
    std::vector<Polyline> polylines{};
    std::vector<Disc> discs{};
    std::vector<Label> labels{};
    bool has_bars = false;  ///< black beside the canvas; false: more of the world
};

/// Interpolates between the pictures of two steps, for display only: `before` at alpha 0, `after`
/// at 1. Elements of the same kind and key move on straight lines. New, removed and teleported
/// elements change when alpha reaches 1. A polyline with new points at its end (a trail) grows out
/// of its last point; a polygon with another number of points changes at 1.
[[nodiscard]] Picture between(const Picture& before, const Picture& after, float alpha);
/// Interpolates into a picture and reuses its memory.
void between(const Picture& before, const Picture& after, float alpha, Picture& picture);

/// Throws Error{usage} for a camera whose height is not a positive number, for a negative radius,
/// width, outline or font size, and for a sprite, disc or label with a number that is NaN.
void require_drawable(const Picture& picture);

/// XXH3 over the bits of all numbers and texts of a picture. Pictures with equal hashes are drawn
/// alike by the same renderer. Layers of 0, and lists that Oiler 0.1 did not have, are hashed only
/// if they are used, so that its captures stay comparable.
[[nodiscard]] std::uint64_t hash_of(const Picture& picture);

}  // namespace oiler
