// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "oiler/math/matrix.hpp"
#include "oiler/physics/contacts/plane.hpp"
#include "oiler/physics/state.hpp"

namespace oiler {

/// Up to as many planes as axes, and sums of their normals.
template <std::floating_point T, int Axes>
class Normals {
protected:
    using Vector = Vec<T, Axes>;
    using Surface = PlaneOf<T, Axes>;

    /// The sum of normals with these weights cancels excess(plane) in the direction of each plane.
    template <class Excess>
    [[nodiscard]] Vector weights(Excess excess) const {
        if (count_ < 2) {
            Vector weight{};
            for (const Surface* const plane : std::span(planes_).first(count_))
                weight.axis[0] = -excess(*plane) / dot(plane->normal, plane->normal);
            return weight;
        }
        auto gram = Matrix<T, Axes>::scalar(T(1));
        Vector opposed{};
        for (std::size_t i = 0; i < count_; ++i) {
            opposed.axis[i] = -excess(*planes_[i]);
            for (std::size_t j = 0; j < count_; ++j)
                gram.row[i].axis[j] = dot(planes_[i]->normal, planes_[j]->normal);
        }
        return solve(gram, opposed);
    }
    [[nodiscard]] Vector sum_of_normals(const Vector& weight) const {
        Vector sum{};
        for (std::size_t i = 0; i < count_; ++i) sum += planes_[i]->normal * weight.axis[i];
        return sum;
    }

    std::array<const Surface*, Axes> planes_{};
    std::size_t count_ = 0;
};

/// The planes that bear a body. They cancel pushes into them.
template <std::floating_point T, int Axes>
class Support : Normals<T, Axes> {
public:
    using Vector = Vec<T, Axes>;
    using Surface = PlaneOf<T, Axes>;

    /// The touched planes into which `push` (an acceleration or a velocity) presses, also after the
    /// others have taken their part: the solution of N_i ≥ 0, n_i·(push + ΣN_j·n_j) ≥ 0.
    [[nodiscard]] static Support against(const Vector& push, std::span<const Surface> planes,
                                         PlaneSet touched) {
        Support support;
        const T noise = 8 * std::numeric_limits<T>::epsilon() * largest(push);
        for (std::size_t i = 0; i < 8 * Axes; ++i) {
            if (support.drop_pulled(push)) continue;
            const Surface* const pressed =
                support.count_ < Axes
                    ? support.most_pressed(support.without_push(push), planes, touched, noise)
                    : nullptr;
            if (!pressed) break;
            support.planes_[support.count_++] = pressed;
        }
        return support;
    }

    [[nodiscard]] bool empty() const { return count_ == 0; }
    [[nodiscard]] std::size_t size() const { return count_; }
    [[nodiscard]] const Surface& operator[](std::size_t i) const { return *planes_[i]; }
    [[nodiscard]] bool has(const Surface& plane) const {
        const auto* const end = planes_.data() + count_;
        return std::find(planes_.data(), end, &plane) != end;
    }

    /// The reactions N of the planes against a push, in its unit; 0 for the others.
    [[nodiscard]] Vector reactions(const Vector& push) const {
        return weights([&](const Surface& plane) { return dot(plane.normal, push); });
    }
    /// The part of a push along all planes; 0 if they bear every direction.
    [[nodiscard]] Vector without_push(const Vector& push) const {
        return count_ == Axes ? Vector{} : push + sum_of_normals(reactions(push));
    }
    /// The nearest place to x where the body touches all planes; gap_of(plane) is the gap at x, m.
    template <class Gap>
    [[nodiscard]] Vector onto(const Vector& x, Gap gap_of) const {
        return x + sum_of_normals(weights(gap_of));
    }
    /// The most that friction can hold, in the unit of the push.
    [[nodiscard]] T grip(const Vector& push) const {
        const Vector reaction = reactions(push);
        T sum = 0;
        for (std::size_t i = 0; i < count_; ++i)
            sum += planes_[i]->friction * std::max(reaction.axis[i], T(0));
        return sum;
    }

private:
    /// Removes the plane with the smallest reaction if it is not positive.
    bool drop_pulled(const Vector& push) {
        if (count_ == 0) return false;
        const Vector reaction = reactions(push);
        const T* const first = reaction.axis.data();
        const T* const least = std::min_element(first, first + count_);
        if (*least > 0) return false;
        std::swap(planes_[static_cast<std::size_t>(least - first)], planes_[--count_]);
        return true;
    }
    /// The plane into which a push presses most, of those that do not bear the body yet: into the
    /// others, a wedge's large reactions may leave a rest of round-off.
    [[nodiscard]] const Surface* most_pressed(const Vector& push, std::span<const Surface> planes,
                                              PlaneSet touched, T noise) const {
        const Surface* most = nullptr;
        T least = -noise;
        for (std::size_t i = 0; i < planes.size(); ++i) {
            const T one = dot(planes[i].normal, push);
            if ((touched >> i & 1U) == 0 || one >= least || has(planes[i])) continue;
            most = &planes[i];
            least = one;
        }
        return most;
    }

    using Normals<T, Axes>::count_;
    using Normals<T, Axes>::planes_;
    using Normals<T, Axes>::sum_of_normals;
    using Normals<T, Axes>::weights;
};

/// The direction of a slide, against which friction acts.
template <std::floating_point T, int Axes>
struct Friction {
    Vec<T, Axes> direction;  ///< at the start of a step, of length 1
    bool turns;              ///< whether the body may slide in two directions

    [[nodiscard]] Vec<T, Axes> against(const Vec<T, Axes>& v) const {
        return turns && dot(v, direction) > 0 ? -normalised(v) : -direction;
    }
};

/// How a slide ends under a constant pull along a plane, weaker than friction.
template <std::floating_point T, int Axes>
struct SlideEnd {
    T time;            ///< s
    Vec<T, Axes> way;  ///< m
};

/// The end of v' = p − g·v/|v| with accelerations |p| < g of pull and grip. The quantity
/// g·|v| + p·v falls by g² − p² per second; the way follows from the derivatives of v·|v| and
/// (p·v)·v.
template <std::floating_point T, int Axes>
[[nodiscard]] SlideEnd<T, Axes> slide_end(const Vec<T, Axes>& v, const Vec<T, Axes>& pull, T grip) {
    const T speed = length(v);
    const T along = dot(v, pull);
    const T surplus = grip * grip - dot(pull, pull);
    const T both = (2 * grip * speed + along) / (4 * grip * grip - dot(pull, pull));
    return {(grip * speed + along) / surplus,
            v * both + pull * ((3 * along * both + speed * speed) / (4 * surplus))};
}

/// The moves of a point from below planes onto them: onto the lowest one, then onto that and the
/// lowest of the others, so that a narrow wedge takes few moves.
template <std::floating_point T, int Axes>
class Lift : Normals<T, Axes> {
public:
    using Surface = PlaneOf<T, Axes>;

    /// The least move onto a plane, and onto planes of earlier moves that it would leave.
    /// `gap_of(plane)` is the gap before the move, m.
    template <class Gap>
    [[nodiscard]] Vec<T, Axes> onto(const Surface& plane, Gap gap_of) {
        keep(plane);
        for (;;) {
            const Vec<T, Axes> ways = this->weights(gap_of);
            const T* const first = ways.axis.data();
            const T* const least = std::min_element(first, first + count_ - 1);
            // Not finite if the normals are linearly dependent.
            const bool needs_all = *least > 0 && std::isfinite(largest(ways));
            if (count_ == 1 || needs_all) return this->sum_of_normals(ways);
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

    using Normals<T, Axes>::count_;
    using Normals<T, Axes>::planes_;
};

/// Moves a point at `x` onto the planes that it is below, and calls moved(plane) after each move.
/// `gap_of(plane, x)` is the gap (m), and noise_of(plane) its round-off.
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
