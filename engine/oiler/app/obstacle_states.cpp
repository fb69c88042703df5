// SPDX-License-Identifier: MIT
#include "oiler/app/obstacle_states.hpp"

#include <array>
#include <string_view>

#include "oiler/sim/bodies.hpp"

namespace oiler {
namespace {

constexpr std::size_t most_obstacles_kept = 1000;

/// Adds the shape and the numbers of an obstacle to its state.
class Numbers {
public:
    explicit Numbers(ObstacleState& state) : state_(state) {}

    void operator()(const HalfSpaceShape& plane) {
        state_.shape = "plane";
        add({"normal x", "normal y", "normal z"}, plane.normal);
        add("offset", plane.offset);
    }
    void operator()(const CircleShape& circle) {
        state_.shape = "circle";
        add({"x", "y", "z"}, circle.centre);
        add("radius", circle.radius);
    }
    void operator()(const SegmentShape& segment) {
        state_.shape = "segment";
        add({"from x", "from y", "from z"}, segment.from);
        add({"to x", "to y", "to z"}, segment.to);
    }
    void operator()(const BoxShape& box) {
        state_.shape = "box";
        add({"x", "y", "z"}, box.centre);
        add({"width", "height", "depth"}, box.size);
        add("angle", box.angle);
    }
    void add(std::string_view name, double number) {
        if (number != 0) state_.numbers.emplace(name, number);
    }
    void add(const std::array<std::string_view, 3>& names, const Vec3& vector) {
        for (std::size_t axis = 0; axis < names.size(); ++axis) add(names[axis], vector.axis[axis]);
    }

private:
    ObstacleState& state_;
};

ObstacleState state_of(std::string name, const Obstacle& obstacle) {
    ObstacleState state{.name = std::move(name), .shape = {}};
    Numbers numbers(state);
    std::visit(numbers, obstacle.shape);
    numbers.add("restitution", obstacle.restitution);
    numbers.add("friction", obstacle.friction);
    numbers.add("belt", obstacle.belt);
    numbers.add({"vx", "vy", "vz"}, obstacle.velocity);
    if (obstacle.swing) {
        numbers.add({"swing x", "swing y", "swing z"}, obstacle.swing->way);
        numbers.add("period", obstacle.swing->period);
        numbers.add("phase", obstacle.swing->phase);
    }
    if (obstacle.one_way) numbers.add({"one way x", "one way y", "one way z"}, *obstacle.one_way);
    numbers.add("layers", obstacle.layers);
    numbers.add("solid", obstacle.solid ? 1 : 0);
    return state;
}

}  // namespace

std::optional<std::vector<ObstacleState>> obstacle_states_of(const AnyGame& game) {
    const Bodies& bodies = game.world().bodies();
    const std::vector<ObstacleHandle> handles = bodies.obstacles();
    if (handles.size() > most_obstacles_kept) return std::nullopt;
    std::vector<ObstacleState> states;
    for (const ObstacleHandle handle : handles)
        states.push_back(state_of(game.name_of(handle), bodies.obstacle(handle)));
    return states;
}

}  // namespace oiler
