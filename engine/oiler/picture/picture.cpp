// SPDX-License-Identifier: MIT
#include "oiler/picture/picture.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <unordered_map>
#include <vector>

#include "oiler/core/error.hpp"
#include "oiler/core/state_hash.hpp"

namespace oiler {
namespace {

struct KeyHash {
    std::size_t operator()(const ElementKey& key) const {
        // Fibonacci hashing (Knuth, TAOCP 3, 6.4): object numbers are mostly consecutive.
        const std::uint64_t rest = (std::uint64_t{key.part} << 32U) | key.jump;
        return static_cast<std::size_t>((key.object ^ (rest * 0xbf58476d1ce4e5b9U)) *
                                        0x9e3779b97f4a7c15U);
    }
};

Point mix(Point from, Point to, float alpha) {
    return {std::lerp(from.x, to.x, alpha), std::lerp(from.y, to.y, alpha)};
}

std::uint8_t mix(std::uint8_t from, std::uint8_t to, float alpha) {
    return static_cast<std::uint8_t>(
        std::lround(std::lerp(static_cast<float>(from), static_cast<float>(to), alpha)));
}

Colour mix(Colour from, Colour to, float alpha) {
    return {mix(from.r, to.r, alpha), mix(from.g, to.g, alpha), mix(from.b, to.b, alpha),
            mix(from.a, to.a, alpha)};
}

Camera mix(const Camera& from, const Camera& to, float alpha) {
    return {mix(from.centre, to.centre, alpha), std::lerp(from.height, to.height, alpha)};
}

/// Turns the shorter way.
float mix_angles(float from, float to, float alpha) {
    constexpr float turn = 2 * std::numbers::pi_v<float>;
    return from + alpha * std::remainder(to - from, turn);
}

/// A mirrored image turns at once, not through a size of 0.
Point mix_sizes(Point from, Point to, float alpha) {
    return mix(from, {std::copysign(to.x, from.x), std::copysign(to.y, from.y)}, alpha);
}

void move(Sprite& sprite, const Sprite& after, float alpha) {
    sprite.centre = mix(sprite.centre, after.centre, alpha);
    sprite.size = mix_sizes(sprite.size, after.size, alpha);
    sprite.angle = mix_angles(sprite.angle, after.angle, alpha);
    sprite.colour = mix(sprite.colour, after.colour, alpha);
}

void move(Polygon& polygon, const Polygon& after, float alpha) {
    if (polygon.points.size() != after.points.size()) return;
    for (std::size_t i = 0; i < polygon.points.size(); ++i)
        polygon.points[i] = mix(polygon.points[i], after.points[i], alpha);
    polygon.colour = mix(polygon.colour, after.colour, alpha);
    polygon.outline = std::lerp(polygon.outline, after.outline, alpha);
    polygon.outline_colour = mix(polygon.outline_colour, after.outline_colour, alpha);
}

void move(Disc& disc, const Disc& after, float alpha) {
    disc.centre = mix(disc.centre, after.centre, alpha);
    disc.radius = std::lerp(disc.radius, after.radius, alpha);
    disc.colour = mix(disc.colour, after.colour, alpha);
}

void move(Polyline& line, const Polyline& after, float alpha) {
    // Every interpolated shape of a line that loses points would mislead, so it changes at 1.
    if (line.points.empty() || after.points.size() < line.points.size()) return;
    line.points.resize(after.points.size(), Point(line.points.back()));
    for (std::size_t i = 0; i < line.points.size(); ++i)
        line.points[i] = mix(line.points[i], after.points[i], alpha);
    line.width = std::lerp(line.width, after.width, alpha);
    line.colour = mix(line.colour, after.colour, alpha);
}

void move(Label& label, const Label& after, float alpha) {
    label.at = mix(label.at, after.at, alpha);
    label.size = std::lerp(label.size, after.size, alpha);
    label.colour = mix(label.colour, after.colour, alpha);
}

/// Finds an element by its key. Pictures of successive steps mostly list the same elements in the
/// same order, so the index is tried first. The table is built only if that fails.
template <class Element>
class Finder {
public:
    explicit Finder(const std::vector<Element>& elements) : elements_(elements) {}

    const Element* find(const Element& wanted, std::size_t likely) {
        if (wanted.key.object == 0) return nullptr;
        const Element* found = likely < elements_.size() && elements_[likely].key == wanted.key
                                   ? &elements_[likely]
                                   : look_up(wanted.key);
        return found != nullptr && found->space == wanted.space ? found : nullptr;
    }

private:
    const Element* look_up(const ElementKey& key) {
        if (table_.empty())
            for (const Element& element : elements_) table_.try_emplace(element.key, &element);
        const auto found = table_.find(key);
        return found == table_.end() ? nullptr : found->second;
    }

    const std::vector<Element>& elements_;
    std::unordered_map<ElementKey, const Element*, KeyHash> table_;
};

template <class Element>
void move_all(std::vector<Element>& elements, const std::vector<Element>& after, float alpha) {
    Finder<Element> finder(after);
    for (std::size_t i = 0; i < elements.size(); ++i)
        if (const Element* match = finder.find(elements[i], i)) move(elements[i], *match, alpha);
}

std::uint32_t bits(float value) { return std::bit_cast<std::uint32_t>(value); }

std::uint32_t bits(Colour colour) {
    return std::uint32_t{colour.r} << 24U | std::uint32_t{colour.g} << 16U |
           std::uint32_t{colour.b} << 8U | colour.a;
}

/// Adds numbers in one call: the hash is fast for long spans only.
template <class... Word>
void add_words(StateHash& hash, Word... words) {
    const std::array<std::uint32_t, sizeof...(words)> packed{static_cast<std::uint32_t>(words)...};
    hash.add(std::as_bytes(std::span(packed)));
}

void add_key(StateHash& hash, const ElementKey& key, Space space) {
    add_words(hash, key.object, key.object >> 32U, key.part, key.jump, space);
}

template <class Element>
void add_key(StateHash& hash, const Element& element) {
    add_key(hash, element.key, element.space);
    if (element.layer != 0) add_words(hash, element.layer);
}

void add(StateHash& hash, const Sprite& sprite) {
    add_key(hash, sprite);
    add_words(hash, bits(sprite.centre.x), bits(sprite.centre.y), bits(sprite.size.x),
              bits(sprite.size.y), bits(sprite.angle), bits(sprite.colour), sprite.is_smooth);
    hash.add(sprite.bitmap ? sprite.bitmap->hash : 0);
    if (const auto& part = sprite.part)
        add_words(hash, part->left, part->top, part->size.width, part->size.height);
}

void add(StateHash& hash, const Polygon& polygon) {
    add_key(hash, polygon);
    add_words(hash, bits(polygon.colour), bits(polygon.outline), bits(polygon.outline_colour),
              polygon.points.size());
    hash.add(std::as_bytes(std::span(polygon.points)));
}

void add(StateHash& hash, const Polyline& line) {
    add_key(hash, line);
    add_words(hash, bits(line.width), bits(line.colour), line.points.size());
    hash.add(std::as_bytes(std::span(line.points)));
}

void add(StateHash& hash, const Disc& disc) {
    add_key(hash, disc);
    add_words(hash, bits(disc.centre.x), bits(disc.centre.y), bits(disc.radius), bits(disc.colour));
}

void add(StateHash& hash, const Label& label) {
    add_key(hash, label);
    if (label.size_in != Space::canvas) add_words(hash, label.size_in);
    add_words(hash, bits(label.at.x), bits(label.at.y), bits(label.size), bits(label.colour),
              label.align, label.text.size());
    hash.add(std::as_bytes(std::span(label.text)));
}

template <class Element>
void add_all(StateHash& hash, const std::vector<Element>& elements) {
    hash.add(std::uint64_t{elements.size()});
    for (const Element& element : elements) add(hash, element);
}

void require_part(const Sprite& sprite) {
    if (!sprite.part || !sprite.bitmap) return;
    const auto& [left, top, size] = *sprite.part;
    const Size whole = sprite.bitmap->size;
    const bool fits = left >= 0 && top >= 0 && size.width > 0 && size.height > 0 &&
                      size.width <= whole.width - left && size.height <= whole.height - top;
    if (!fits)
        fail(Exit::usage,
             "a sprite's part of {}x{} texels at ({}, {}): give one within its bitmap of {}x{}",
             size.width, size.height, left, top, whole.width, whole.height);
}

}  // namespace

Point side_of(Space space) {
    switch (space) {
        case Space::upper_left:
            return {-1, 1};
        case Space::top:
            return {0, 1};
        case Space::upper_right:
            return {1, 1};
        case Space::lower_left:
            return {-1, -1};
        case Space::bottom:
            return {0, -1};
        case Space::lower_right:
            return {1, -1};
        case Space::world:
        case Space::canvas:
            break;
    }
    return {};
}

Point Camera::to_canvas(Point world) const {
    const float units_per_metre = canvas_height / height;
    return {canvas_width / 2 + (world.x - centre.x) * units_per_metre,
            canvas_height / 2 + (world.y - centre.y) * units_per_metre};
}

Point Camera::to_world(Point canvas) const {
    const float metres_per_unit = height / canvas_height;
    return {centre.x + (canvas.x - canvas_width / 2) * metres_per_unit,
            centre.y + (canvas.y - canvas_height / 2) * metres_per_unit};
}

void Camera::follow(Point target, double half_life, double dt) {
    if (!(half_life > 0)) {
        centre = target;
        return;
    }
    // 2^(-dt/half_life) as the 32nd power of a Padé approximant: basic operations have the same
    // bits on every machine. Its relative error is below 1e-5 up to one half-life.
    const double z = std::min(dt / half_life, 32.0) * std::numbers::ln2 / 32;
    double left = (1 - z / 2) / (1 + z / 2);
    for (int i = 0; i < 5; ++i) left *= left;
    centre = mix(target, centre, static_cast<float>(left));
}

void Camera::zoom(float factor, Point fixed) {
    height *= factor;
    centre = {fixed.x + (centre.x - fixed.x) * factor, fixed.y + (centre.y - fixed.y) * factor};
}

Picture between(const Picture& before, const Picture& after, float alpha) {
    Picture picture;
    between(before, after, alpha, picture);
    return picture;
}

void between(const Picture& before, const Picture& after, float alpha, Picture& picture) {
    picture = alpha >= 1 ? after : before;
    if (alpha >= 1 || !(alpha > 0)) return;
    picture.background = mix(before.background, after.background, alpha);
    picture.camera = mix(before.camera, after.camera, alpha);
    move_all(picture.sprites, after.sprites, alpha);
    move_all(picture.polygons, after.polygons, alpha);
    move_all(picture.polylines, after.polylines, alpha);
    move_all(picture.discs, after.discs, alpha);
    move_all(picture.labels, after.labels, alpha);
}

void require_drawable(const Picture& picture) {
    const auto refuse_negative = [](float number, const char* what) {
        if (number < 0) fail(Exit::usage, "{} of {}: give 0 or more", what, number);
    };
    if (!(picture.camera.height > 0))
        fail(Exit::usage, "a camera of {} m height: give a height above 0", picture.camera.height);
    const auto refuse_nan = [](Point at, float size, const char* what) {
        if (std::isnan(at.x + at.y + size))
            fail(Exit::usage, "{} of size {} at ({}, {}): give numbers", what, size, at.x, at.y);
    };
    for (const Sprite& sprite : picture.sprites) {
        refuse_nan(sprite.centre, sprite.size.x + sprite.size.y + sprite.angle, "a sprite");
        require_part(sprite);
    }
    for (const Disc& disc : picture.discs) {
        refuse_nan(disc.centre, disc.radius, "a disc");
        refuse_negative(disc.radius, "a disc with a radius");
    }
    for (const Polyline& line : picture.polylines)
        refuse_negative(line.width, "a polyline with a width");
    for (const Polygon& polygon : picture.polygons)
        refuse_negative(polygon.outline, "a polygon with an outline");
    for (const Label& label : picture.labels) {
        refuse_nan(label.at, label.size, "a label");
        refuse_negative(label.size, "a label with a size");
    }
}

std::uint64_t hash_of(const Picture& picture) {
    StateHash hash;
    add_words(hash, bits(picture.background), bits(picture.camera.centre.x),
              bits(picture.camera.centre.y), bits(picture.camera.height));
    add_all(hash, picture.polylines);
    add_all(hash, picture.discs);
    add_all(hash, picture.labels);
    if (!picture.sprites.empty()) add_all(hash, picture.sprites);
    if (!picture.polygons.empty()) add_all(hash, picture.polygons);
    if (picture.has_bars) add_words(hash, 1);
    return hash.value();
}

}  // namespace oiler
