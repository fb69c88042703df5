// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace oiler {

/// A handle: which slot of the world, and which of the entities that lived there one after another.
/// A handle outlives its entity harmlessly: the world knows that it is stale.
struct Entity {
    std::uint32_t index = ~std::uint32_t{0};
    std::uint32_t generation = 0;
    friend bool operator==(const Entity&, const Entity&) = default;

    /// Both numbers as one, never 0 for an entity of a world: the object of a picture's element.
    [[nodiscard]] std::uint64_t id() const { return (std::uint64_t{generation} + 1) << 32 | index; }
};

}  // namespace oiler
