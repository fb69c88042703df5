// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace oiler {

struct Point {
    float x = 0;
    float y = 0;
    friend bool operator==(const Point&, const Point&) = default;
};

/// Eight bits a channel, not premultiplied.
struct Colour {
    std::uint8_t r = 0;
    std::uint8_t g = 0;
    std::uint8_t b = 0;
    std::uint8_t a = 255;
    friend bool operator==(const Colour&, const Colour&) = default;
};

/// The canvas: a box of 640 × 360 units, origin at its lower left, y up, that fills the frame as
/// far as its shape allows, centred and always wholly visible. One unit is a pixel at 640 × 360.
inline constexpr float canvas_width = 640;
inline constexpr float canvas_height = 360;

/// What an element's points are measured in.
enum class Space : std::uint8_t {
    world,   ///< metres, seen through the picture's camera
    canvas,  ///< units of the canvas
};

/// Which element of the picture before is which of the picture after. An element without an object
/// (0) is matched with nothing and jumps. A body that teleports changes `jump`, so that it is not
/// streaked across the screen.
struct ElementKey {
    std::uint64_t object = 0;
    std::uint32_t part = 0;
    std::uint32_t jump = 0;
    friend bool operator==(const ElementKey&, const ElementKey&) = default;
};

struct Disc {
    ElementKey key{};
    Point centre{};
    float radius = 1;  ///< in the element's space
    Colour colour{};
    Space space = Space::world;
};

struct Polyline {
    ElementKey key{};
    std::vector<Point> points{};
    float width = 1;  ///< in units of the canvas, whatever the space
    Colour colour{};
    Space space = Space::world;
};

enum class Align : std::uint8_t { left, centre, right };

/// A line of text. `at` is on the baseline; `align` tells which end of the line is there. Between
/// two steps the text is that of the step before.
struct Label {
    ElementKey key{};
    Point at{};
    std::string text{};  ///< UTF-8
    float size = 12;     ///< height of the font in units of the canvas
    Colour colour{};
    Align align = Align::left;
    Space space = Space::canvas;
};

/// The canvas shows `height` metres of the world around `centre`.
struct Camera {
    Point centre{};
    float height = 10;

    [[nodiscard]] Point to_canvas(Point world) const;
};

/// What is to be seen, as a value: drawn by a renderer, compared by a test, interpolated between
/// two steps. Polylines are drawn first, then discs, then labels, each in the order of its list.
struct Picture {
    Colour background{255, 255, 255, 255};
    Camera camera{};
    std::vector<Polyline> polylines{};
    std::vector<Disc> discs{};
    std::vector<Label> labels{};
};

/// The picture at alpha in [0, 1] of the way between two steps, for display only: `before` at 0,
/// `after` at 1. Elements of the same kind and key move on straight lines; what is new, gone or
/// teleported changes when alpha reaches 1. A polyline that has grown at its end (a trail) grows
/// out of its last point.
[[nodiscard]] Picture between(const Picture& before, const Picture& after, float alpha);

}  // namespace oiler
