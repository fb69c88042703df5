// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "oiler/physics/contacts/crossing.hpp"
#include "oiler/sim/store/columns.hpp"

namespace oiler {

/// Lists where a row enters and leaves areas in a step of `dt` s. Its way is taken for a cubic
/// between the ends of the step and its impacts, as pictures between ticks take it.
template <std::floating_point T, int Axes>
class AreaCrossings {
public:
    using Impacts = std::vector<RowImpact<T, Axes>>;

    AreaCrossings(const Contacts<T, Axes>& contacts, std::size_t row, std::int64_t tick, T dt)
        : contacts_(contacts), row_(row), tick_(tick), dt_(dt), radius_(contacts.radius[row]) {}

    /// Adds crossings to the impacts, of which those from `begin` to `end` are of the row in the
    /// step.
    void list(const State<T, Axes>& from, const State<T, Axes>& to, Impacts& impacts,
              std::size_t begin, std::size_t end, std::vector<Near<T, Axes>>& nears) {
        T way = largest_way(from, to, dt_);
        for (std::size_t i = begin; i < end; ++i)
            way = std::max(way, length(impacts[i].impact.x - from.x));
        contacts_.areas.find_near((from.x + to.x) * T(0.5), 2 * way, radius_, contacts_.meets(row_),
                                  tick_, dt_, nears);
        for (const Near<T, Axes>& near : nears) {
            Piece piece{T(0), from, dt_, to};
            for (std::size_t i = begin; i < end; ++i) {
                const ImpactOf<T, Axes> impact = impacts[i].impact;
                piece.end = std::min(impact.after_start, dt_);
                piece.to = {impact.x, impact.before};
                list(near, piece, impacts);
                piece.start = piece.end;
                piece.from = {impact.x, impact.after};
            }
            piece.end = dt_;
            piece.to = to;
            // As the next step will begin, so that no crossing is lost to round-off.
            piece.end_gap = gap(contacts_.areas.at(near.index, tick_ + 1), to.x, radius_);
            list(near, piece, impacts);
        }
    }

private:
    /// A part of the way, in s since the start of the step.
    struct Piece {
        T start;
        State<T, Axes> from;
        T end;
        State<T, Axes> to;
        std::optional<T> end_gap{};  ///< m, if it is known

        [[nodiscard]] T width() const { return end - start; }
        [[nodiscard]] Vec<T, Axes> straight() const { return (to.x - from.x) / width(); }
        /// The change of the acceleration, m/s³.
        [[nodiscard]] Vec<T, Axes> jerk() const {
            return (from.v + to.v - straight() * T(2)) * (6 / (width() * width()));
        }
        [[nodiscard]] Vec<T, Axes> acceleration() const {
            return (straight() * T(3) - from.v * T(2) - to.v) * (2 / width());
        }
        [[nodiscard]] State<T, Axes> at(T time) const {
            const T tau = time - start;
            const Vec<T, Axes> a = acceleration();
            const Vec<T, Axes> j = jerk();
            return {from.x + (from.v + (a + j * (tau / 3)) * (tau / 2)) * tau,
                    from.v + (a + j * (tau / 2)) * tau};
        }
        [[nodiscard]] T most_acceleration() const {
            return std::max(length(acceleration()), length(acceleration() + jerk() * width()));
        }
    };

    void list(const Near<T, Axes>& near, const Piece& piece, Impacts& impacts) {
        if (!(piece.width() > 0)) return;
        const auto sample = [&](const State<T, Axes>& at, T time) {
            const Vec<T, Axes> x = place_beside(near.obstacle, at.x, time);
            const Vec<T, Axes> v = at.v - near.obstacle.course.velocity_at(time);
            return GapAt<T>{time, gap(near.obstacle, x, radius_), dot(normal(near.obstacle, x), v)};
        };
        const auto at = [&](T time) { return sample(piece.at(time), time); };
        const T most = piece.most_acceleration() + near.obstacle.course.most_acceleration(dt_);
        auto end = sample(piece.to, piece.end);
        end.gap = piece.end_gap.value_or(end.gap);
        auto from = sample(piece.from, piece.start);
        if (from.gap < 0) {
            if (end.gap < 0) return;
            from = leave(near, piece, at, from, end, impacts);
        }
        while (const auto found =
                   FirstCrossing<T, decltype(at)>(at, most, T(0)).between(from, end)) {
            add(Meeting::entered, near, piece, found->after, impacts);
            const auto inside = at(found->after);
            if (end.gap < 0 || inside.tau >= piece.end) return;
            from = leave(near, piece, at, inside, end, impacts);
        }
    }
    template <class At>
    GapAt<T> leave(const Near<T, Axes>& near, const Piece& piece, At at, const GapAt<T>& inside,
                   const GapAt<T>& end, Impacts& impacts) {
        const auto depth = [&](T time) { return -at(time).gap; };
        const T time = narrow_bracket<T>(depth, {inside.tau, end.tau}, std::max(-inside.gap, T(0)),
                                         -end.gap, T(-1))
                           .after;
        add(Meeting::left, near, piece, time, impacts);
        return at(time);
    }
    void add(Meeting kind, const Near<T, Axes>& near, const Piece& piece, T time,
             Impacts& impacts) {
        const State<T, Axes> state = piece.at(time);
        const Vec<T, Axes> n = normal(near.obstacle, place_beside(near.obstacle, state.x, time));
        impacts.push_back(
            {tick_, row_, impacts.size(), {kind, near.index, time, state.x, n, state.v, state.v}});
    }

    const Contacts<T, Axes>& contacts_;
    std::size_t row_;
    std::int64_t tick_;
    T dt_;
    T radius_;
};

}  // namespace oiler
