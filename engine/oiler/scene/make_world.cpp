// SPDX-License-Identifier: MIT
#include "oiler/scene/make_world.hpp"

#include <map>
#include <memory>

#include "oiler/core/random.hpp"
#include "oiler/world/name.hpp"

namespace oiler {
namespace {

Attractor to_force(const SceneAttractor& attractor) {
    return {.centre = attractor.position, .gm = attractor.gm};
}

Body body_of(const SceneMatter& matter, const Vec3& position, const Vec3& velocity) {
    Body body{.mass = matter.mass, .position = position, .velocity = velocity};
    if (matter.contact) body.contact = Contact{*matter.contact, matter.meets};
    return body;
}

/// Spawns a scene's bodies. Forces are passed with a body where possible, because bodies with equal
/// forces then share them in memory.
class WorldBuilder {
public:
    WorldBuilder(const Scene& scene, const Settings& settings)
        : scene_(scene), world_(scene.axes, settings) {}

    World run() {
        world_.reserve(static_cast<std::size_t>(scene_.body_count()));
        if (scene_.gravity) world_.set_gravity(*scene_.gravity);
        add_obstacles();
        add_bodies();
        for (const SceneGrid& grid : scene_.grids) add_grid(grid);
        for (const SceneScatter& scatter : scene_.scatters) add_scatter(scatter);
        return std::move(world_);
    }

private:
    [[nodiscard]] GivenForces forces_of(const SceneMatter& matter) const {
        GivenForces forces;
        const auto give = [&]<class Force>(const Force& force) {
            std::get<std::optional<Force>>(forces) = force;
        };
        if (matter.linear_drag > 0) give(LinearDrag{matter.linear_drag});
        if (matter.quadratic_drag > 0) give(QuadraticDrag{matter.quadratic_drag});
        if (!scene_.attractors.empty()) give(to_force(scene_.attractors[0]));
        return forces;
    }
    Entity spawn(const Body& body, const GivenForces& forces) {
        const Entity entity = world_.spawn(body, forces);
        for (std::size_t index = 1; index < scene_.attractors.size(); ++index)
            world_.attach_at(index, entity, to_force(scene_.attractors[index]));
        return entity;
    }

    void add_obstacles() {
        const auto add_all = [&](const std::vector<Obstacle>& obstacles) {
            for (const Obstacle& obstacle : obstacles) world_.add_obstacle(obstacle);
        };
        for (const ScenePlane& one : scene_.planes)
            world_.add_obstacle({.shape = HalfSpaceShape{one.plane.normal, one.plane.offset},
                                 .restitution = one.plane.restitution,
                                 .friction = one.plane.friction,
                                 .layers = one.layers});
        for (const SceneObstacle& one : scene_.obstacles) world_.add_obstacle(one.obstacle);
        for (const SceneChain& chain : scene_.chains) add_all(segments_of(chain));
        for (const SceneTiles& tiles : scene_.tiles) add_all(boxes_of(tiles, scene_.axes));
    }

    void add_bodies() {
        std::vector<Entity> entities;
        for (const SceneBody& body : scene_.bodies) {
            const Entity entity =
                spawn(body_of(body.matter, body.position, body.velocity), forces_of(body.matter));
            if (!body.name.empty()) world_.add(entity, Name{body.name});
            entities.push_back(entity);
        }
        std::vector<std::size_t> springs(entities.size());
        std::vector<std::size_t> coils(entities.size());
        for (const SceneSpring& spring : scene_.springs) {
            const Entity entity = entities[spring.body];
            if (spring.to)
                world_.link(entity, entities[*spring.to], link_of(spring));
            else if (spring.pulls_only)
                world_.link_to_point(entity, spring.anchor, link_of(spring));
            else if (spring.rest_length > 0)
                world_.attach_at(coils[spring.body]++, entity,
                                 CoilSpring{spring.anchor, spring.stiffness, spring.damping,
                                            spring.rest_length});
            else
                world_.attach_at(springs[spring.body]++, entity,
                                 Spring{spring.anchor, spring.stiffness, spring.damping});
        }
        std::map<std::pair<std::size_t, std::size_t>, std::size_t> forces;
        for (const SceneForce& force : scene_.forces)
            std::visit(
                [&](const auto& one) {
                    const std::size_t index = forces[{force.body, force.force.index()}]++;
                    world_.attach_at(index, entities[force.body], one);
                },
                force.force);
    }

    void add_grid(const SceneGrid& grid) {
        const GivenForces forces = forces_of(grid.matter);
        std::vector<Entity> nodes;
        nodes.reserve(static_cast<std::size_t>(grid.size()));
        for (std::int64_t row = 0; row < grid.count[1]; ++row)
            for (std::int64_t column = 0; column < grid.count[0]; ++column)
                nodes.push_back(spawn(
                    body_of(grid.matter, node_position(grid, column, row), grid.velocity), forces));
        for (const GridLink& link : links_of(grid)) add_links(grid, link, nodes);
        for (const std::size_t node : anchored_nodes(grid))
            world_.link_to_point(nodes[node], world_.position(nodes[node]),
                                 {.stiffness = grid.stiffness, .damping = grid.damping});
    }
    /// Links row by row, so that consecutive links join consecutive rows of bodies.
    void add_links(const SceneGrid& grid, const GridLink& link, const std::vector<Entity>& nodes) {
        for (std::int64_t row = 0; row < grid.count[1]; ++row)
            for (std::int64_t column = 0; column < grid.count[0]; ++column)
                if (const auto other = node_at(grid, column + link.right, row + link.up))
                    world_.link(nodes[*node_at(grid, column, row)], nodes[*other], link.link);
    }

    void add_scatter(const SceneScatter& scatter) {
        const GivenForces forces = forces_of(scatter.matter);
        Random random(static_cast<std::uint64_t>(scatter.seed) ^
                      Random::mixed(world_.settings().seed));
        const auto draw = [&](const Vec3& from, const Vec3& to) {
            Vec3 drawn{};
            for (int i = 0; i < scene_.axes; ++i)
                drawn[i] = from[i] + (to[i] - from[i]) * random.fraction();
            return drawn;
        };
        for (std::int64_t i = 0; i < scatter.count; ++i) {
            const Vec3 position = draw(scatter.position_from, scatter.position_to);
            const Vec3 velocity = draw(scatter.velocity_from, scatter.velocity_to);
            spawn(body_of(scatter.matter, position, velocity), forces);
        }
    }

    const Scene& scene_;
    World world_;
};

}  // namespace

Scene with_seed(Scene scene, std::uint64_t seed) {
    for (SceneScatter& scatter : scene.scatters)
        scatter.seed = static_cast<std::int64_t>(static_cast<std::uint64_t>(scatter.seed) ^
                                                 Random::mixed(seed));
    return scene;
}

World make_world(const Scene& scene, const Settings& settings) {
    World world = WorldBuilder(scene, settings).run();
    world.set_start([start = std::make_shared<const Scene>(scene)](const Settings& other) {
        return WorldBuilder(*start, other).run();
    });
    return world;
}

}  // namespace oiler
