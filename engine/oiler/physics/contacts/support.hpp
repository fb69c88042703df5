// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <type_traits>

#include "oiler/math/matrix.hpp"
#include "oiler/physics/contacts/plane.hpp"
#include "oiler/physics/state.hpp"

namespace oiler {

/// An obstacle where a body is: the plane that touches its surface at the nearest point.
template <std::floating_point T, int Axes>
struct TouchOf : PlaneOf<T, Axes> {
    Vec<T, Axes> velocity{};  ///< m/s, of the surface
    /// m/s², towards the obstacle, of a body that follows its curve and its motion.
    T inwards = 0;
};

/// Whether a push presses a body into an obstacle, and how much: the negative of an excess.
template <std::floating_point T, int Axes>
struct OfPull {
    [[nodiscard]] T operator()(const TouchOf<T, Axes>& touch, const Vec<T, Axes>& a) const {
        const T away = dot(touch.normal, a);
        return touch.inwards == 0 ? away : away + touch.inwards;
    }
};
template <std::floating_point T, int Axes>
struct OfVelocity {
    [[nodiscard]] T operator()(const TouchOf<T, Axes>& touch, const Vec<T, Axes>& v) const {
        return leaving_speed(touch, v - touch.velocity);
    }
};

/// Up to as many planes as axes, and sums of their normals.
template <std::floating_point T, int Axes>
class Normals {
protected:
    using Vector = Vec<T, Axes>;
    using Touch = TouchOf<T, Axes>;

    /// The sum of normals with these weights cancels excess(plane) in the direction of each plane.
    template <class Excess>
    [[nodiscard]] [[gnu::always_inline]] inline Vector weights(Excess excess) const {
        if (count_ > 1) return weights_of_several(excess);
        Vector weight{};
        if (count_ == 1)
            weight.axis[0] = -excess(*planes_[0]) / dot(planes_[0]->normal, planes_[0]->normal);
        return weight;
    }
    [[nodiscard]] [[gnu::always_inline]] inline Vector sum_of_normals(const Vector& weight) const {
        Vector sum{};
        for (std::size_t i = 0; i < count_; ++i) sum += planes_[i]->normal * weight.axis[i];
        return sum;
    }

    std::array<const Touch*, Axes> planes_{};
    std::size_t count_ = 0;

private:
    template <class Excess>
    [[nodiscard]] [[gnu::noinline]] Vector weights_of_several(Excess excess) const {
        auto gram = Matrix<T, Axes>::scalar(T(1));
        Vector opposed{};
        for (std::size_t i = 0; i < count_; ++i) {
            opposed.axis[i] = -excess(*planes_[i]);
            for (std::size_t j = 0; j < count_; ++j)
                gram.row[i].axis[j] = dot(planes_[i]->normal, planes_[j]->normal);
        }
        return solve(gram, opposed);
    }
};

/// The obstacles that bear a body. They cancel pushes into them.
template <std::floating_point T, int Axes>
class Support : Normals<T, Axes> {
public:
    using Vector = Vec<T, Axes>;
    using Touch = TouchOf<T, Axes>;

    /// The chosen touches into which an acceleration presses, also after the others have taken
    /// their part: the solution of N_i ≥ 0, n_i·(a + ΣN_j·n_j) ≥ 0.
    template <class Touches, class Chosen>
    [[nodiscard]] static Support against(const Vector& a, const Touches& touches, Chosen chosen) {
        return against(a, touches, chosen, OfPull<T, Axes>{});
    }
    /// The chosen touches into which a velocity goes.
    template <class Touches, class Chosen>
    [[nodiscard]] static Support against_velocity(const Vector& v, const Touches& touches,
                                                  Chosen chosen) {
        return against(v, touches, chosen, OfVelocity<T, Axes>{});
    }

    /// Adds a touch; there must be less than one per axis.
    void add(const Touch& touch) { planes_[count_++] = &touch; }
    [[nodiscard]] bool empty() const { return count_ == 0; }
    [[nodiscard]] std::size_t size() const { return count_; }
    [[nodiscard]] const Touch& operator[](std::size_t i) const { return *planes_[i]; }
    [[nodiscard]] bool has(const Touch& touch) const {
        const auto* const end = planes_.data() + count_;
        return std::find(planes_.data(), end, &touch) != end;
    }

    /// The reactions N against an acceleration; 0 for the others.
    [[nodiscard]] Vector reactions(const Vector& a) const {
        return reactions(a, OfPull<T, Axes>{});
    }
    /// An acceleration along all touches; 0 if they bear every direction.
    [[nodiscard]] Vector without_push(const Vector& a) const {
        return without(a, OfPull<T, Axes>{});
    }
    /// The velocity of a body that goes along all touches, with their own velocities.
    [[nodiscard]] Vector following(const Vector& v) const {
        return without(v, OfVelocity<T, Axes>{});
    }
    /// The pushes of all touches, with friction against the slips of a velocity `along` them, that
    /// change the motion towards each by needed(touch).
    template <class Needed>
    [[nodiscard]] Vector pushes(const Vector& along, Needed needed) const {
        auto with_friction = Matrix<T, Axes>::scalar(T(1));
        Vector wanted{};
        for (std::size_t j = 0; j < count_; ++j) {
            const Vector push = push_with_friction(j, along);
            wanted.axis[j] = needed(*planes_[j]);
            for (std::size_t i = 0; i < count_; ++i)
                with_friction.row[i].axis[j] = dot(planes_[i]->normal, push);
        }
        return solve(with_friction, wanted);
    }
    /// Those of the touches that bear a body with a velocity `along` them: their pushes with
    /// friction are positive, and drive it off the others. Of several answers, none is first, then
    /// all. Null if there is no answer.
    template <class Needed>
    [[nodiscard]] std::optional<Support> bearing(const Vector& along, Needed needed) const {
        const unsigned all = (1U << count_) - 1;
        for (unsigned i = 0; i <= all; ++i) {
            const unsigned chosen = i == 0 ? 0 : all + 1 - i;
            Support some;
            for (std::size_t j = 0; j < count_; ++j)
                if ((chosen >> j & 1U) != 0) some.add(*planes_[j]);
            if (some.bears_among(*this, along, needed)) return some;
        }
        return std::nullopt;
    }
    /// The other touches.
    [[nodiscard]] Support without_touch(const Touch& touch) const {
        Support others = *this;
        const auto end = others.planes_.begin() + static_cast<std::ptrdiff_t>(count_);
        others.count_ = static_cast<std::size_t>(std::remove(others.planes_.begin(), end, &touch) -
                                                 others.planes_.begin());
        return others;
    }
    /// The same touches at another instant.
    [[nodiscard]] Support with(std::span<const Touch> touches) const {
        Support then = *this;
        for (std::size_t i = 0; i < count_; ++i) then.planes_[i] = &touches[i];
        return then;
    }
    /// Whether friction against the slips of a velocity `along` all touches leaves no pushes N_j ≥
    /// 0 that change v to it: ΣN_j·n_i·(n_j − μ_j·s_j) = n_i·(along − v), with directions s of
    /// slips.
    [[nodiscard]] bool jams(const Vector& v, const Vector& along) const {
        const T noise = 64 * std::numeric_limits<T>::epsilon() * largest(along);
        if (Axes == 1 || count_ < 2 || largest(along - v) <= noise) return false;
        const Vector pushes =
            this->pushes(along, [&](const Touch& touch) { return dot(touch.normal, along - v); });
        const auto first = pushes.axis.begin();
        const T least = -largest(pushes) / 1024;
        return !std::all_of(first, first + count_, [&](T one) { return one >= least; });
    }
    /// The touch that moves least.
    [[nodiscard]] const Touch& slowest() const {
        return **std::min_element(planes_.begin(), planes_.begin() + count_, [](auto* a, auto* b) {
            return length(a->velocity) < length(b->velocity);
        });
    }
    /// The nearest place to x where the body touches all of them; gap_of(touch) is the gap at x, m.
    template <class Gap>
    [[nodiscard]] Vector onto(const Vector& x, Gap gap_of) const {
        return x + sum_of_normals(weights(gap_of));
    }
    /// What a change of the push changes without_push and grip by, while the same touches bear.
    [[nodiscard]] Vector change_without_push(const Vector& change) const {
        return without_push(change) - without_push(Vector{});
    }
    [[nodiscard]] T change_of_grip(const Vector& change) const {
        const Vector reaction = reactions(change) - reactions(Vector{});
        T sum = 0;
        for (std::size_t i = 0; i < count_; ++i) sum += planes_[i]->friction * reaction.axis[i];
        return sum;
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
    [[nodiscard]] Vector push_with_friction(std::size_t j, const Vector& along) const {
        T fastest = largest(along);
        for (std::size_t i = 0; i < count_; ++i)
            fastest = std::max(fastest, largest(planes_[i]->velocity));
        const Vector slip = along - planes_[j]->velocity;
        if (largest(slip) <= 64 * std::numeric_limits<T>::epsilon() * fastest)
            return planes_[j]->normal;
        return planes_[j]->normal - normalised(slip) * planes_[j]->friction;
    }
    template <class Needed>
    [[nodiscard]] bool bears_among(const Support& touches, const Vector& along,
                                   Needed needed) const {
        const Vector push = pushes(along, needed);
        Vector sum{};
        for (std::size_t j = 0; j < count_; ++j) {
            if (!(push.axis[j] > 0)) return false;
            sum += push_with_friction(j, along) * push.axis[j];
        }
        const auto* const end = touches.planes_.data() + touches.count_;
        return std::all_of(touches.planes_.data(), end, [&](const Touch* touch) {
            return has(*touch) || dot(touch->normal, sum) >= needed(*touch);
        });
    }
    template <class Touches, class Chosen, class Excess>
    [[nodiscard]] static Support against(const Vector& push, const Touches& touches, Chosen chosen,
                                         Excess excess) {
        Support support;
        const T noise = 8 * std::numeric_limits<T>::epsilon() * largest(push);
        for (std::size_t i = 0; i < 8 * Axes; ++i) {
            if (support.drop_pulled(push, excess)) continue;
            if (support.count_ == Axes) break;
            const Vector along = support.without(push, excess);
            const Touch* pressed = nullptr;
            T least = -noise;
            for (const auto& touch : touches) {
                const T one = excess(touch, along);
                // In a wedge, large reactions may leave a rest of round-off.
                if (one >= least || !chosen(touch) || support.has(touch)) continue;
                pressed = &touch;
                least = one;
            }
            if (!pressed) break;
            support.planes_[support.count_++] = pressed;
            // The only touch bears the body.
            if (std::size(touches) == 1) break;
            // Between opposite obstacles there is no direction to push the body out.
            if (std::isfinite(largest(support.reactions(push, excess)))) continue;
            --support.count_;
            break;
        }
        return support;
    }
    template <class Excess>
    [[nodiscard]] Vector reactions(const Vector& push, Excess excess) const {
        return weights([&](const Touch& touch) { return excess(touch, push); });
    }
    template <class Excess>
    [[nodiscard]] [[gnu::always_inline]] inline Vector without(const Vector& push,
                                                               Excess excess) const {
        const auto stands = [](const Touch* touch) {
            constexpr bool is_velocity = std::is_same_v<Excess, OfVelocity<T, Axes>>;
            return touch->velocity == Vector{} && (is_velocity || touch->inwards == 0);
        };
        const bool bears_all =
            count_ == Axes && std::all_of(planes_.begin(), planes_.end(), stands);
        return bears_all ? Vector{} : push + sum_of_normals(reactions(push, excess));
    }
    /// Removes the touch with the smallest reaction if it is not positive.
    template <class Excess>
    bool drop_pulled(const Vector& push, Excess excess) {
        if (count_ == 0) return false;
        const Vector reaction = reactions(push, excess);
        const T* const first = reaction.axis.data();
        const T* const least = std::min_element(first, first + count_);
        if (*least > 0) return false;
        std::swap(planes_[static_cast<std::size_t>(least - first)], planes_[--count_]);
        return true;
    }

    using Normals<T, Axes>::count_;
    using Normals<T, Axes>::planes_;
    using Normals<T, Axes>::sum_of_normals;
    using Normals<T, Axes>::weights;
};

/// The moves of a point out of obstacles: out of the one that it is deepest in, then out of that
/// and the deepest of the others, so that a narrow wedge takes few moves.
template <std::floating_point T, int Axes>
class Lift : Normals<T, Axes> {
public:
    using Touch = TouchOf<T, Axes>;

    /// The least move onto an obstacle, and onto those of earlier moves that it would leave.
    /// `gap_of(touch)` is the gap before the move, m.
    template <class Gap>
    [[nodiscard]] Vec<T, Axes> onto(const Touch& touch, Gap gap_of) {
        keep(touch);
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
    /// Makes the touch the last one.
    void keep(const Touch& touch) {
        const auto end = planes_.begin() + count_;
        const auto found = std::find(planes_.begin(), end, &touch);
        if (found != end)
            drop(static_cast<std::size_t>(found - planes_.begin()));
        else if (count_ == Axes)
            drop(0);
        planes_[count_++] = &touch;
    }
    void drop(std::size_t i) {
        std::copy(planes_.begin() + i + 1, planes_.begin() + count_, planes_.begin() + i);
        --count_;
    }

    using Normals<T, Axes>::count_;
    using Normals<T, Axes>::planes_;
};

/// Moves a point at `x` out of the touches that it is in, and calls moved(touch) after each move,
/// which may renew them. `gap_of(touch, x)` is the gap (m), and noise_of(touch) its round-off.
template <std::floating_point T, int Axes, class Touches, class Gap, class Noise, class Moved>
void lift_onto(Touches& touches, Vec<T, Axes>& x, Gap gap_of, Noise noise_of, Moved moved) {
    constexpr int most_moves = 64;
    const auto deepest = [&] {
        auto* farthest = touches.data();
        farthest = nullptr;
        T least = 0;
        for (auto& touch : touches) {
            const T one = gap_of(touch, x);
            if (one >= least || one >= -noise_of(touch)) continue;
            farthest = &touch;
            least = one;
        }
        return farthest;
    };
    Lift<T, Axes> lift;
    for (int move = 0; move < most_moves; ++move) {
        auto* const touch = deepest();
        if (!touch) break;
        x += lift.onto(*touch, [&](const TouchOf<T, Axes>& one) {
            return gap_of(static_cast<const std::remove_pointer_t<decltype(touch)>&>(one), x);
        });
        moved(*touch);
    }
    for (auto& touch : touches)
        if (const T below = -gap_of(touch, x); below > 0) x += touch.normal * below;
}

}  // namespace oiler
