// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "oiler/math/matrix.hpp"
#include "oiler/physics/contacts/plane.hpp"

namespace oiler {

/// The moves of a point from below planes onto them: onto the lowest one, then onto that and the
/// lowest of the others, so that a narrow wedge takes few moves.
template <std::floating_point T, int Axes>
class Lift {
public:
    using Surface = PlaneOf<T, Axes>;

    /// The least move onto a plane and, where they would be left, those of the moves before.
    /// `gap_of(plane)` is the gap before the move, m.
    template <class Gap>
    [[nodiscard]] Vec<T, Axes> onto(const Surface& plane, Gap gap_of) {
        keep(plane);
        for (;;) {
            const Vec<T, Axes> ways = ways_along_normals(gap_of);
            const T* const first = ways.axis.data();
            const T* const least = std::min_element(first, first + count_ - 1);
            // Not finite where normals depend on each other.
            const bool needs_all = *least > 0 && std::isfinite(largest(ways));
            if (count_ == 1 || needs_all) return sum_of_normals(ways);
            drop(static_cast<std::size_t>(least - first));
        }
    }

private:
    /// Makes the plane the last one.
    void keep(const Surface& plane) {
        const auto end = planes_.begin() + count_;
        const auto found = std::find(planes_.begin(), end, &plane);
        if (found != end)
            drop(static_cast<std::size_t>(found - planes_.begin()));
        else if (count_ == Axes)
            drop(0);
        planes_[count_++] = &plane;
    }
    void drop(std::size_t i) {
        std::copy(planes_.begin() + i + 1, planes_.begin() + count_, planes_.begin() + i);
        --count_;
    }
    template <class Gap>
    [[nodiscard]] Vec<T, Axes> ways_along_normals(Gap gap_of) const {
        auto gram = Matrix<T, Axes>::scalar(T(1));
        Vec<T, Axes> below{};
        for (std::size_t i = 0; i < count_; ++i) {
            below.axis[i] = -gap_of(*planes_[i]);
            for (std::size_t j = 0; j < count_; ++j)
                gram.row[i].axis[j] = dot(planes_[i]->normal, planes_[j]->normal);
        }
        return solve(gram, below);
    }
    [[nodiscard]] Vec<T, Axes> sum_of_normals(const Vec<T, Axes>& ways) const {
        Vec<T, Axes> sum{};
        for (std::size_t i = 0; i < count_; ++i) sum += planes_[i]->normal * ways.axis[i];
        return sum;
    }

    std::array<const Surface*, Axes> planes_{};
    std::size_t count_ = 0;
};

/// Moves a point at `x` onto the planes that it is below, and calls moved(plane) after each move.
/// `gap_of(plane, x)` is the gap (m), and noise_of(plane) what round-off hides of it.
template <std::floating_point T, int Axes, class Gap, class Noise, class Moved>
void lift_onto(std::span<const PlaneOf<T, Axes>> planes, Vec<T, Axes>& x, Gap gap_of,
               Noise noise_of, Moved moved) {
    constexpr int most_moves = 64;
    using Surface = PlaneOf<T, Axes>;
    const auto lowest = [&] {
        const Surface* farthest = nullptr;
        T least = 0;
        for (const Surface& plane : planes) {
            const T one = gap_of(plane, x);
            if (one >= least || one >= -noise_of(plane)) continue;
            farthest = &plane;
            least = one;
        }
        return farthest;
    };
    Lift<T, Axes> lift;
    for (int move = 0; move < most_moves; ++move) {
        const Surface* const plane = lowest();
        if (!plane) break;
        x += lift.onto(*plane, [&](const Surface& one) { return gap_of(one, x); });
        moved(*plane);
    }
    for (const Surface& plane : planes)
        if (const T below = -gap_of(plane, x); below > 0) x += plane.normal * below;
}

}  // namespace oiler
