// SPDX-License-Identifier: MIT
#include "oiler/lab/reference/perturbation.hpp"

#include "oiler/core/random.hpp"
#include "oiler/sim/bodies.hpp"

namespace oiler::lab {

World make_world(const Scene& scene, const Settings& settings, const Perturbation& perturbation) {
    World world = make_world(scene, settings);
    if (perturbation.seed == 0) return world;
    Random random(Random::mixed(perturbation.seed));
    const auto moved = [&](Vec3 vector, double most) {
        for (int axis = 0; axis < scene.axes; ++axis)
            vector[axis] += most * (2 * random.fraction() - 1);
        return vector;
    };
    for (std::size_t row = 0; row < world.bodies().size(); ++row) {
        const Entity entity = world.entity_of_row(row);
        world.teleport(entity, moved(world.position(entity), perturbation.position));
        world.set_velocity(entity, moved(world.velocity(entity), perturbation.velocity));
    }
    return world;
}

}  // namespace oiler::lab
