// SPDX-License-Identifier: MIT
#include "oiler/picture/picture_hash.hpp"

#include <array>
#include <bit>
#include <span>
#include <string>
#include <vector>

#include "oiler/core/state_hash.hpp"

namespace oiler {
namespace {

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

}  // namespace

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
