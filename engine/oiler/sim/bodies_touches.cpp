// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "oiler/core/require.hpp"
#include "oiler/physics/contacts/near.hpp"
#include "oiler/physics/contacts/root.hpp"
#include "oiler/sim/any_columns.hpp"
#include "oiler/sim/bodies.hpp"
#include "oiler/sim/limits.hpp"
#include "oiler/sim/links/link_force.hpp"

namespace oiler {
namespace {

template <class T, int Axes>
Vec<T, Axes> acceleration_of(const Bodies& bodies, const Columns<T, Axes>& columns, std::size_t row,
                             const State<T, Axes>& state) {
    Vec<T, Axes> a{};
    const double time = columns.contacts.obstacles.time();
    for_each_force<T>(columns, row,
                      [&](const auto& force) { a += oiler::accelerate(force, state, time); });
    for (std::size_t i = 0; i < bodies.link_count(); ++i) {
        const LinkEnds ends = bodies.link_ends(i);
        if (ends.row != row && ends.other != row) continue;
        const std::size_t other = ends.row == row ? ends.other.value_or(row) : ends.row;
        const State<T, Axes> at = ends.other
                                      ? load<T>(columns.motion, other)
                                      : State<T, Axes>{converted<Vec<T, Axes>>(ends.point), {}};
        a += LinkForce<T, Axes>(bodies.link_at(i)).accelerate({state.x - at.x, state.v - at.v}) *
             (1 / T(columns.mass[row]));
    }
    return a;
}

/// The obstacles that a body touches after the last step, as the next step will find them.
template <class T, int Axes>
class TouchSearch {
public:
    TouchSearch(const Bodies& bodies, const Columns<T, Axes>& columns, std::size_t row)
        : obstacles_(columns.contacts.obstacles),
          radius_(columns.contacts.radius[row]),
          state_(load<T>(columns.motion, row)),
          a_(acceleration_of(bodies, columns, row, state_)) {
        if (radius_ == Contacts<T, Axes>::no_contact) return;
        obstacles_.find_near(state_.x, T(0), radius_, columns.contacts.meets(row),
                             obstacles_.tick(), obstacles_.dt(), nears_);
        for (Near<T, Axes>& near : nears_) {
            renew_normal(near, state_.x, T(0));
            near.velocity =
                obstacles_.velocity_now(near.index) + belt_velocity(near.obstacle, near.normal);
            if (near.obstacle.bounded)
                renew_sides(near, state_.x, state_.v - near.velocity,
                            hidden_distance(near.obstacle, state_, radius_, T(0)));
        }
        const auto touches = [&](const Near<T, Axes>& near) { return this->touches(near); };
        hide_joints(std::span(nears_), state_.x, T(0), radius_, touches);
        std::erase_if(nears_, [&](const auto& near) { return near.hidden || !touches(near); });
        for (Near<T, Axes>& near : nears_) near.bears = !leaves(near);
    }

    [[nodiscard]] const std::vector<Near<T, Axes>>& touches() const { return nears_; }
    /// The forces on the body, per unit mass, m/s².
    [[nodiscard]] const Vec<T, Axes>& acceleration() const { return a_; }
    [[nodiscard]] Support<T, Axes> support() const {
        return Support<T, Axes>::against(a_, nears_, [](const auto& near) { return near.bears; });
    }

private:
    [[nodiscard]] T speed() const { return largest(a_) * obstacles_.dt(); }
    [[nodiscard]] bool touches(const Near<T, Axes>& near) const {
        const T noise = hidden_distance(near.obstacle, state_, radius_, obstacles_.dt()) +
                        8 * std::numeric_limits<T>::epsilon() * speed() * obstacles_.dt();
        const T distance = gap(near, state_.x, T(0), radius_);
        if (distance > noise) return false;
        return !near.obstacle.is_one_way() ||
               (distance >= -2 * noise && bears_from(near.obstacle, near.normal));
    }
    [[nodiscard]] bool leaves(const Near<T, Axes>& near) const {
        // Where an oscillation turns back, its speed is round-off of its largest one.
        const T fastest = near.obstacle.course.most_speed(obstacles_.dt());
        const T noise = hidden_speed(state_.v) + hidden_speed(near.velocity) +
                        8 * std::numeric_limits<T>::epsilon() * (speed() + 2 * fastest);
        return leaving_speed(near, state_.v - near.velocity) > noise;
    }

    const Obstacles<T, Axes>& obstacles_;
    T radius_;
    State<T, Axes> state_;
    Vec<T, Axes> a_;
    std::vector<Near<T, Axes>> nears_;
};

template <class T, int Axes>
bool is_segment(const ObstacleOf<T, Axes>& obstacle) {
    return Axes == 2 && obstacle.bounded && obstacle.rounding == 0 &&
           obstacle.half.axis.back() == 0;
}
/// The place along a way where a point crosses a segment, which has no inside.
template <class T, int Axes>
std::optional<T> crossing_of(const ObstacleOf<T, Axes>& segment, const Vec<T, Axes>& from,
                             const Vec<T, Axes>& way) {
    const Vec<T, Axes> start = beside(segment, from).place;
    const Vec<T, Axes> end = beside(segment, from + way).place;
    const T height = start.axis.back();
    const T last = end.axis.back();
    if (!(height < 0 ? last >= 0 : height > 0 && last <= 0)) return std::nullopt;
    const T at = height / (height - last);
    const T noise = 8 * std::numeric_limits<T>::epsilon() *
                    (largest(from) + largest(way) + largest(segment.centre));
    const T along = start.axis[0] + (end.axis[0] - start.axis[0]) * at;
    return std::abs(along) <= segment.half.axis[0] + noise ? std::optional(at) : std::nullopt;
}

/// The place along a way where a ball first touches a convex obstacle; 0 if it starts in it.
template <class T, int Axes>
std::optional<T> fraction_to(const ObstacleOf<T, Axes>& obstacle, const Vec<T, Axes>& from,
                             const Vec<T, Axes>& way, T radius) {
    if (radius == 0 && is_segment(obstacle)) return crossing_of(obstacle, from, way);
    const auto distance = [&](T at) { return gap(obstacle, from + way * at, radius); };
    const auto nearing = [&](T at) { return -dot(normal(obstacle, from + way * at), way); };
    const T start = distance(0);
    if (start < 0) return T(0);
    if (!(nearing(0) > 0)) return std::nullopt;
    // The gap is convex along the way: it falls up to the nearest place.
    T nearest = 1;
    if (nearing(1) < 0)
        nearest = narrow_bracket<T>(nearing, {0, 1}, nearing(0), nearing(1), T(0)).before;
    const T least = distance(nearest);
    if (!(least < 0)) return std::nullopt;
    return narrow_bracket<T>(distance, {0, nearest}, start, least, T(0)).before;
}

/// The first obstacle that a ball of `radius` m meets on a straight way.
template <class T, int Axes>
class RaySearch {
public:
    using Vec = oiler::Vec<T, Axes>;
    struct Found {
        std::size_t slot;
        T fraction;  ///< of the way
        Vec point;
        Vec normal;
    };

    RaySearch(const Obstacles<T, Axes>& obstacles, const Vec& from, const Vec& to, T radius,
              std::uint32_t meets)
        : obstacles_(obstacles), from_(from), way_(to - from), radius_(radius), meets_(meets) {}

    [[nodiscard]] std::optional<Found> first() {
        const T piece = obstacles_.standing().piece_of_ray() + 4 * radius_;
        const T pieces = piece > 0 ? std::ceil(length(way_) / piece) : T(1);
        const auto count = static_cast<int>(std::clamp(pieces, T(1), T(4096)));
        const T half = length(way_) / static_cast<T>(2 * count);
        for (int i = 0; i < count; ++i) {
            const T middle = (static_cast<T>(i) + T(0.5)) / static_cast<T>(count);
            const Vec x = from_ + way_ * middle;
            obstacles_.for_each_now(x, half + radius_ + obstacles_.hidden_way(x, half + radius_),
                                    [&](std::size_t slot, const auto& one) { test(slot, one); });
            if (found_ && found_->fraction * static_cast<T>(count) <= static_cast<T>(i + 1)) break;
        }
        return found_;
    }

private:
    void test(std::size_t slot, const ObstacleOf<T, Axes>& obstacle) {
        if ((obstacle.layers & meets_) == 0) return;
        const auto fraction = fraction_to(obstacle, from_, way_, radius_);
        if (!fraction) return;
        if (found_ && std::pair(found_->fraction, found_->slot) <= std::pair(*fraction, slot))
            return;
        const Vec centre = from_ + way_ * *fraction;
        const Vec n = normal_at(obstacle, centre);
        if (obstacle.is_one_way() && (*fraction == 0 || !bears_from(obstacle, n))) return;
        const bool is_inside = *fraction == 0 && gap(obstacle, from_, radius_) < 0;
        found_ = {slot, *fraction, centre - n * radius_, is_inside ? Vec{} : n};
    }

    /// On a segment, a point is on the side from which it comes.
    [[nodiscard]] Vec normal_at(const ObstacleOf<T, Axes>& obstacle, const Vec& x) const {
        if (radius_ > 0 || !is_segment(obstacle)) return normal(obstacle, x);
        const Vec side = obstacle.frame.row.back();
        return dot(side, way_) < 0 ? side : -side;
    }

    const Obstacles<T, Axes>& obstacles_;
    Vec from_;
    Vec way_;  ///< m
    T radius_;
    std::uint32_t meets_;
    std::optional<Found> found_;
};

}  // namespace

std::vector<Touch> Bodies::touches(std::size_t row) const {
    require_row(row);
    return columns_->visit([&]<class T, int Axes>(const Columns<T, Axes>& columns) {
        const TouchSearch<T, Axes> search(*this, columns, row);
        const auto support = search.support();
        std::vector<Touch> touches;
        for (const Near<T, Axes>& near : search.touches())
            touches.push_back({handle_of(near.index), converted<Vec3>(near.normal),
                               converted<Vec3>(near.velocity), support.has(near)});
        return touches;
    });
}

std::optional<Touch> Bodies::ground(std::size_t row) const {
    const Vec3 pull = columns_->visit([&]<class T, int Axes>(const Columns<T, Axes>& columns) {
        return converted<Vec3>(TouchSearch<T, Axes>(*this, columns, row).acceleration());
    });
    std::optional<Touch> ground;
    for (const Touch& touch : touches(row))
        if (touch.bears && (!ground || dot(touch.normal, pull) < dot(ground->normal, pull)))
            ground = touch;
    return ground;
}

void Bodies::drop_through(std::size_t row) {
    require_row(row);
    columns_->visit([&]<class T, int Axes>(Columns<T, Axes>& columns) {
        const TouchSearch<T, Axes> search(*this, columns, row);
        State<T, Axes> state = load<T>(columns.motion, row);
        const T radius = columns.contacts.radius[row];
        for (const Near<T, Axes>& near : search.touches()) {
            if (!near.obstacle.is_one_way()) continue;
            const T noise =
                hidden_distance(near.obstacle, state, radius, columns.contacts.obstacles.dt());
            state.x -= near.obstacle.one_way * std::max(radius * T(1e-6), 8 * noise);
        }
        store(state, columns.motion, row);
        columns.state_changed(row);
    });
}

std::optional<Hit> Bodies::raycast(const Vec3& from, const Vec3& to, const Contact& ball) const {
    const Limits limits(precision(), axes());
    limits.check(from, "the start of a ray");
    limits.check(to, "the end of a ray");
    limits.check(ball);
    return columns_->visit([&]<class T, int Axes>(const Columns<T, Axes>& columns) {
        using Vector = Vec<T, Axes>;
        RaySearch<T, Axes> search(columns.contacts.obstacles, converted<Vector>(from),
                                  converted<Vector>(to), static_cast<T>(ball.radius), ball.meets);
        const auto first = search.first();
        if (!first) return std::optional<Hit>();
        return std::optional(Hit{handle_of(first->slot), static_cast<double>(first->fraction),
                                 converted<Vec3>(first->point), converted<Vec3>(first->normal)});
    });
}

std::vector<ObstacleHandle> Bodies::overlaps(const Vec3& centre, const Contact& ball) const {
    const Limits limits(precision(), axes());
    limits.check(centre, "the centre of a query");
    limits.check(ball);
    return columns_->visit([&]<class T, int Axes>(const Columns<T, Axes>& columns) {
        const auto x = converted<Vec<T, Axes>>(centre);
        const auto radius = static_cast<T>(ball.radius);
        std::set<std::size_t> found;
        for (const bool solid : {true, false})
            columns.contacts.all(solid).for_each_now(
                x, radius, [&](std::size_t slot, const auto& one) {
                    const bool is_met = (one.layers & ball.meets) != 0;
                    if (is_met && gap(one, x, radius) < 0) found.insert(slot);
                });
        std::vector<ObstacleHandle> handles;
        for (const std::size_t slot : found) handles.push_back(handle_of(slot));
        return handles;
    });
}

}  // namespace oiler
