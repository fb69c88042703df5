// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace oiler {

/// A handle: the slot in the world, and the generation of the entities in that slot. A handle may
/// safely outlive its entity, because the world recognises stale handles.
struct Entity {
    std::uint32_t index = ~std::uint32_t{0};
    std::uint32_t generation = 0;
    friend bool operator==(const Entity&, const Entity&) = default;

    /// Both numbers as one, never 0 for an entity of a world. It is the object of a picture's
    /// element.
    [[nodiscard]] std::uint64_t id() const { return (std::uint64_t{generation} + 1) << 32 | index; }
};

}  // namespace oiler
