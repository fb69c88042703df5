// SPDX-License-Identifier: MIT
#include "oiler/world/name.hpp"

#include "oiler/world/world.hpp"

namespace oiler {

std::string name_in(const World& world, Entity entity) {
    const std::string index = " " + std::to_string(entity.index);
    const Name* const name = world.find<Name>(entity);
    if (!name) return "body" + index;
    int count = 0;
    world.each<Name>([&](Entity, const Name& one) { count += one.text == name->text ? 1 : 0; });
    return count > 1 ? name->text + index : name->text;
}

std::string label_in(const World& world, Entity entity) {
    return world.find<Name>(entity) ? "'" + name_in(world, entity) + "'"
                                    : std::to_string(entity.index);
}

}  // namespace oiler
