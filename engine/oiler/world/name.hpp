// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "oiler/world/entity.hpp"

namespace oiler {

class World;

/// A component: what messages, the window and differences call an entity.
struct Name {
    static constexpr bool is_state = false;
    std::string text;
};

/// "hero", "target 5" if several are named "target", or "body 5" without a Name; the number is the
/// entity's index.
[[nodiscard]] std::string name_in(const World& world, Entity entity);

/// What messages call an entity after "body " or "entity ": "5", or "'hero'" if it has a Name.
[[nodiscard]] std::string label_in(const World& world, Entity entity);

}  // namespace oiler
