// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include "oiler/core/require.hpp"
#include "oiler/physics/response.hpp"
#include "oiler/sim/any_columns.hpp"
#include "oiler/sim/bodies.hpp"
#include "oiler/sim/limits.hpp"

namespace oiler {
namespace {

/// Writes a shape as an obstacle of steps.
template <class T, int Axes>
class ToObstacle {
public:
    using Vec = oiler::Vec<T, Axes>;

    explicit ToObstacle(ObstacleOf<T, Axes>& to) : to_(to) {}

    void operator()(const HalfSpaceShape& shape) {
        const double size = length(shape.normal);
        to_.surface.normal = converted<Vec>(shape.normal / size);
        to_.surface.offset = static_cast<T>(shape.offset / size);
        to_.centre = to_.surface.normal * to_.surface.offset;
    }
    void operator()(const CircleShape& shape) {
        to_.bounded = true;
        to_.centre = converted<Vec>(shape.centre);
        to_.rounding = static_cast<T>(shape.radius);
    }
    void operator()(const SegmentShape& shape) {
        to_.bounded = true;
        to_.centre = converted<Vec>((shape.from + shape.to) / 2.0);
        const Vec3 way = shape.to - shape.from;
        to_.half.axis[0] = static_cast<T>(length(way) / 2);
        turn_first_axis_to(converted<Vec>(normalised(way)));
    }
    void operator()(const BoxShape& shape) {
        to_.bounded = true;
        to_.centre = converted<Vec>(shape.centre);
        to_.half = converted<Vec>(shape.size / 2.0);
        if constexpr (Axes > 1)
            if (shape.angle != 0) {
                const Response<double> turned = oscillator_response(1.0, 0.0, shape.angle);
                to_.frame(0, 0) = to_.frame(1, 1) = static_cast<T>(turned.decay);
                to_.frame(0, 1) = static_cast<T>(turned.reach);
                to_.frame(1, 0) = static_cast<T>(-turned.reach);
            }
    }

private:
    /// A frame whose first axis has a direction, and whose others are across it.
    void turn_first_axis_to(const Vec& direction) {
        to_.frame.row[0] = direction;
        if constexpr (Axes == 2) to_.frame.row[1] = {{-direction[1], direction[0]}};
        if constexpr (Axes == 3) {
            Vec least{};
            least.axis[static_cast<std::size_t>(
                std::abs(direction[0]) < std::abs(direction[1]) ? 0 : 1)] = 1;
            to_.frame.row[1] = normalised(least - direction * dot(direction, least));
            const Vec& b = to_.frame.row[1];
            to_.frame.row[2] = {{direction[1] * b[2] - direction[2] * b[1],
                                 direction[2] * b[0] - direction[0] * b[2],
                                 direction[0] * b[1] - direction[1] * b[0]}};
        }
    }

    ObstacleOf<T, Axes>& to_;
};

template <class T, int Axes>
ObstacleOf<T, Axes> to_obstacle(const Obstacle& given) {
    ObstacleOf<T, Axes> obstacle;
    std::visit(ToObstacle<T, Axes>(obstacle), given.shape);
    obstacle.surface.restitution = static_cast<T>(given.restitution);
    // More friction would stop bodies within times that no step resolves.
    constexpr double most_friction = 1 / std::numeric_limits<T>::epsilon();
    obstacle.surface.friction = static_cast<T>(std::min(given.friction, most_friction));
    obstacle.belt = static_cast<T>(given.belt);
    obstacle.layers = given.layers;
    obstacle.solid = given.solid;
    if (given.one_way) obstacle.one_way = converted<Vec<T, Axes>>(normalised(*given.one_way));
    return obstacle;
}

template <class T, int Axes>
ObstacleMotion<T, Axes> motion_of(const Obstacle& given) {
    ObstacleMotion<T, Axes> motion{.velocity = converted<Vec<T, Axes>>(given.velocity)};
    if (!given.swing) return motion;
    constexpr double turn = 2 * 3.14159265358979323846;
    motion.sway = converted<Vec<T, Axes>>(given.swing->way);
    motion.frequency = 1 / given.swing->period;
    motion.turns = given.swing->phase / turn;
    return motion;
}

/// Moves a shape to where its obstacle is.
template <class T, int Axes>
struct MoveTo {
    const ObstacleOf<T, Axes>& obstacle;

    void operator()(HalfSpaceShape& shape) const {
        shape.offset = static_cast<double>(obstacle.surface.offset) * length(shape.normal);
    }
    void operator()(CircleShape& shape) const { shape.centre = centre(); }
    void operator()(BoxShape& shape) const { shape.centre = centre(); }
    void operator()(SegmentShape& shape) const {
        const Vec3 way = centre() - (shape.from + shape.to) / 2.0;
        shape.from += way;
        shape.to += way;
    }
    [[nodiscard]] Vec3 centre() const { return converted<Vec3>(obstacle.centre); }
};

}  // namespace

Vec3 centre_of(const Shape& shape) {
    struct Centre {
        Vec3 operator()(const HalfSpaceShape& plane) const {
            return plane.offset / dot(plane.normal, plane.normal) * plane.normal;
        }
        Vec3 operator()(const CircleShape& circle) const { return circle.centre; }
        Vec3 operator()(const SegmentShape& segment) const {
            return (segment.from + segment.to) / 2.0;
        }
        Vec3 operator()(const BoxShape& box) const { return box.centre; }
    };
    return std::visit(Centre(), shape);
}

ObstacleHandle Bodies::add_obstacle(const Obstacle& obstacle) {
    Limits(precision(), axes()).check(obstacle);
    const auto handle = obstacle_slots_.take<ObstacleHandle>();
    auto& all = obstacles_.write();
    if (handle.slot >= all.size()) all.resize(handle.slot + 1);
    all[handle.slot] = obstacle;
    columns_->visit([&]<class T, int Axes>(Columns<T, Axes>& columns) {
        columns.contacts.all(obstacle.solid)
            .set(handle.slot, to_obstacle<T, Axes>(obstacle), motion_of<T, Axes>(obstacle));
        columns.contacts.wake_all();
    });
    return handle;
}

ObstacleHandle Bodies::add_plane(const Plane& plane) {
    return add_obstacle({.shape = HalfSpaceShape{plane.normal, plane.offset},
                         .restitution = plane.restitution,
                         .friction = plane.friction});
}

void Bodies::remove_obstacle(ObstacleHandle handle) {
    require(alive(handle), "the obstacle is gone");
    obstacle_slots_.release(handle.slot);
    columns_->visit([&](auto& columns) {
        columns.contacts.all(is_solid(handle)).remove(handle.slot);
        columns.contacts.wake_all();
    });
    obstacles_.write()[handle.slot].reset();
}

void Bodies::clear_planes() {
    for (const ObstacleHandle handle : obstacles())
        if (std::holds_alternative<HalfSpaceShape>((*obstacles_)[handle.slot]->shape))
            remove_obstacle(handle);
}

bool Bodies::is_solid(ObstacleHandle handle) const { return (*obstacles_)[handle.slot]->solid; }

bool Bodies::alive(ObstacleHandle handle) const {
    return obstacle_slots_.holds(handle.slot, handle.generation);
}

std::vector<ObstacleHandle> Bodies::obstacles() const {
    std::vector<ObstacleHandle> handles;
    for (std::uint32_t slot = 0; slot < obstacles_->size(); ++slot)
        if ((*obstacles_)[slot]) handles.push_back({slot, obstacle_slots_.generation(slot)});
    return handles;
}

Obstacle Bodies::obstacle(ObstacleHandle handle) const {
    require(alive(handle), "the obstacle is gone");
    Obstacle obstacle = *(*obstacles_)[handle.slot];
    columns_->visit([&]<class T, int Axes>(const Columns<T, Axes>& columns) {
        const auto& all = columns.contacts.all(obstacle.solid);
        const auto* const motion = all.motion(handle.slot);
        obstacle.velocity = motion ? converted<Vec3>(motion->velocity) : Vec3{};
        if (!motion || motion->frequency == 0) obstacle.swing.reset();
        const auto now = all.now(handle.slot);
        const auto added = to_obstacle<T, Axes>(obstacle);
        const bool has_moved =
            now.centre != added.centre || now.surface.offset != added.surface.offset;
        if (has_moved) std::visit(MoveTo<T, Axes>{now}, obstacle.shape);
    });
    return obstacle;
}

template <class F>
void Bodies::change_motion(ObstacleHandle handle, F f) {
    require(alive(handle), "the obstacle is gone");
    columns_->visit([&]<class T, int Axes>(Columns<T, Axes>& columns) {
        f(columns.contacts.all(is_solid(handle)), Vec<T, Axes>{});
    });
}

void Bodies::set_obstacle_velocity(ObstacleHandle handle, const Vec3& velocity) {
    Limits(precision(), axes()).check(velocity, "an obstacle's velocity");
    change_motion(handle, [&]<class Vec>(auto& obstacles, const Vec&) {
        obstacles.set_velocity(handle.slot, converted<Vec>(velocity));
    });
}

void Bodies::move_obstacle(ObstacleHandle handle, const Vec3& to,
                           const std::optional<Vec3>& velocity) {
    Limits(precision(), axes()).check(to, "an obstacle's place");
    if (velocity) Limits(precision(), axes()).check(*velocity, "an obstacle's velocity");
    change_motion(handle, [&]<class Vec>(auto& obstacles, const Vec&) {
        std::optional<Vec> arrival;
        if (velocity) arrival = converted<Vec>(*velocity);
        obstacles.move(handle.slot, converted<Vec>(to), arrival);
    });
}

void Bodies::teleport_obstacle(ObstacleHandle handle, const Vec3& to) {
    Limits(precision(), axes()).check(to, "an obstacle's place");
    change_motion(handle, [&]<class Vec>(auto& obstacles, const Vec&) {
        obstacles.teleport(handle.slot, converted<Vec>(to));
    });
    columns_->visit([&]<class T, int Axes>(Columns<T, Axes>& columns) {
        columns.contacts.wake_all();
        const auto now = columns.contacts.all(is_solid(handle)).now(handle.slot);
        std::visit(MoveTo<T, Axes>{now}, obstacles_.write()[handle.slot]->shape);
    });
}

std::vector<Plane> Bodies::planes(std::uint32_t layers) const {
    std::vector<Plane> planes;
    for (const std::optional<Obstacle>& one : *obstacles_)
        if (const auto* const shape = one ? std::get_if<HalfSpaceShape>(&one->shape) : nullptr;
            shape && one->solid && (one->layers & layers) != 0)
            planes.push_back({shape->normal, shape->offset, one->restitution, one->friction});
    return planes;
}

ObstacleHandle Bodies::handle_of(std::size_t slot) const {
    const auto at = static_cast<std::uint32_t>(slot);
    return {at, obstacle_slots_.generation(at)};
}

bool Bodies::has_obstacles() const { return obstacle_slots_.used() > 0; }

std::size_t Bodies::impact_count() const {
    return columns_->visit([](const auto& columns) { return columns.contacts.impacts.size(); });
}

BodyImpact Bodies::impact_at(std::size_t i, const Rate& rate) const {
    require(i < impact_count(), "there are fewer impacts");
    return columns_->visit([&](const auto& columns) {
        const auto& [tick, row, index, impact] = columns.contacts.impacts[i];
        return BodyImpact{impact.kind,
                          row,
                          handle_of(impact.obstacle),
                          rate.time(tick) + static_cast<double>(impact.after_start),
                          converted<Vec3>(impact.x - impact.normal * columns.contacts.radius[row]),
                          converted<Vec3>(impact.normal),
                          converted<Vec3>(impact.before),
                          converted<Vec3>(impact.after)};
    });
}

}  // namespace oiler
