// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "oiler/core/state_hash.hpp"
#include "oiler/physics/contacts/obstacle.hpp"
#include "oiler/sim/store/box_grid.hpp"

namespace oiler {

/// The hash of an obstacle where it is, without its motion.
template <std::floating_point T, int Axes>
[[nodiscard]] std::uint64_t digest_of(std::size_t slot, const ObstacleOf<T, Axes>& one) {
    StateHash hash;
    const auto add = [&](const Vec<T, Axes>& vector) {
        for (const T& number : vector.axis) hash.add(static_cast<double>(number));
    };
    hash.add(slot);
    for (const T number : {one.surface.offset, one.surface.restitution, one.surface.friction,
                           one.rounding, one.belt})
        hash.add(static_cast<double>(number));
    for (const Vec<T, Axes>& vector : {one.centre, one.half, one.one_way}) add(vector);
    for (const Vec<T, Axes>& row : one.frame.row) add(row);
    return hash.value();
}

/// A ball without the surface of any standing box, so that steps within it need no search.
template <std::floating_point T, int Axes>
struct Clearing {
    Vec<T, Axes> centre{};
    T radius = 0;               ///< m
    std::uint64_t version = 0;  ///< of the obstacles

    /// Whether a ball of `most` m about x is in it.
    [[nodiscard]] bool contains(const Vec<T, Axes>& x, T most) const {
        const T left = radius - most;
        return left > 0 && squared_length(x - centre) < left * left;
    }
};

/// The obstacles that do not move, in the order of their slots. A grid finds boxes near a place;
/// those that were added after it was built are in a short list beside it.
template <std::floating_point T, int Axes>
class StandingObstacles {
public:
    using Vec = oiler::Vec<T, Axes>;
    using Obstacle = ObstacleOf<T, Axes>;

    [[nodiscard]] const Obstacle& operator[](std::size_t slot) const { return all_[slot]; }
    /// The slots of half-spaces.
    [[nodiscard]] const std::vector<std::size_t>& half_spaces() const { return half_spaces_; }
    [[nodiscard]] bool any_boxes() const { return boxes_ > 0; }
    [[nodiscard]] bool empty() const { return boxes_ == 0 && half_spaces_.empty(); }
    /// The sum of the digests of boxes.
    [[nodiscard]] std::uint64_t digest() const { return digest_; }

    void add(std::size_t slot, const Obstacle& obstacle) {
        if (slot >= all_.size()) all_.resize(slot + 1, nothing());
        all_[slot] = obstacle;
        if (!obstacle.bounded) {
            half_spaces_.insert(std::ranges::lower_bound(half_spaces_, slot), slot);
            return;
        }
        ++boxes_;
        digest_ += digest_of(slot, obstacle);
        recent_.push_back(static_cast<std::uint32_t>(slot));
        ++version_;
        if (recent_.size() > 64 + grid_.items().size() / 2) build();
    }
    [[nodiscard]] bool has(std::size_t slot) const {
        return slot < all_.size() && all_[slot].layers != 0;
    }
    void remove(std::size_t slot) {
        if (all_[slot].bounded) {
            --boxes_;
            digest_ -= digest_of(slot, all_[slot]);
        } else {
            half_spaces_.erase(std::ranges::lower_bound(half_spaces_, slot));
        }
        all_[slot] = nothing();
    }
    /// Whether the short list has grown so long that the grid should be built anew.
    [[nodiscard]] bool is_listed_long() const {
        return recent_.size() > 16 && recent_.size() * recent_.size() > grid_.items().size();
    }
    void build() {
        grid_.clear(Axes);
        for (std::size_t slot = 0; slot < all_.size(); ++slot)
            if (is_box(slot)) grid_.add(bounds_of(all_[slot]), static_cast<std::uint32_t>(slot));
        grid_.build();
        recent_.clear();
    }

    /// Calls f(slot, box) for each box within `most` m of x, for some of them several times, and
    /// for some that are farther.
    template <class F>
    void for_each_box_near(const Vec& x, T most, F f) const {
        if (!any_boxes()) return;
        const auto call = [&](std::size_t slot) {
            if (is_box(slot)) f(slot, all_[slot]);
        };
        if (!std::ranges::all_of(x.axis, [](T one) { return std::isfinite(one); })) return;
        const Vec3 centre = converted<Vec3>(x);
        grid_.for_each_overlap(bounds_of_path(centre, centre, static_cast<double>(most)),
                               [&](std::size_t i) { call(grid_.items()[i].id); });
        for (const std::uint32_t slot : recent_) call(slot);
    }
    /// The length of the pieces of a ray that a search follows one by one, m.
    [[nodiscard]] T piece_of_ray() const { return static_cast<T>(4 * grid_.finest_width()); }
    /// Whether a ball of `most` m about x is clear of boxes in the layers `meets`. If the known
    /// clearing does not say so, it is renewed: about x, of at most `widest` m.
    [[nodiscard]] bool is_clear(const Vec& x, T most, T widest, std::uint32_t meets,
                                Clearing<T, Axes>& clearing) const {
        if (clearing.version == version_ && clearing.contains(x, most)) return true;
        clearing = {x, widest, version_};
        T nearest = widest;
        for_each_box_near(x, widest, [&](std::size_t, const Obstacle& box) {
            if ((box.layers & meets) == 0) return;
            const T distance = box.solid ? gap(box, x, T(0)) : std::abs(gap(box, x, T(0)));
            const T noise = round_off_of(box) + round_off * (largest(x) + widest);
            nearest = std::min(nearest, distance - noise);
            // Within a clearing, a new search would find the same, whatever its round-off.
            clearing.radius = std::min(clearing.radius, distance - 3 * noise);
        });
        return nearest > most;
    }

private:
    static constexpr T round_off = 16 * std::numeric_limits<T>::epsilon();

    /// Of the distance from a box, m.
    [[nodiscard]] static T round_off_of(const Obstacle& box) {
        return round_off * (largest(box.centre) + reach(box));
    }
    static Obstacle nothing() {
        Obstacle none;
        none.layers = 0;
        return none;
    }
    [[nodiscard]] bool is_box(std::size_t slot) const {
        return all_[slot].bounded && all_[slot].layers != 0;
    }
    [[nodiscard]] static Bounds bounds_of(const Obstacle& box) {
        constexpr double most = std::numeric_limits<double>::max();
        Bounds bounds{};
        for (std::size_t axis = 0; axis < Axes; ++axis) {
            T wide = box.rounding + round_off_of(box);
            for (std::size_t side = 0; side < Axes; ++side)
                wide += std::abs(box.frame.row[side].axis[axis]) * box.half.axis[side];
            bounds.low.axis[axis] =
                std::max(static_cast<double>(box.centre.axis[axis] - wide), -most);
            bounds.high.axis[axis] =
                std::min(static_cast<double>(box.centre.axis[axis] + wide), most);
        }
        return bounds;
    }

    std::vector<Obstacle> all_;  ///< by slot; no layers where none stands
    std::vector<std::size_t> half_spaces_;
    BoxGrid grid_;
    std::vector<std::uint32_t> recent_;  ///< slots of boxes that the grid may not have
    std::size_t boxes_ = 0;
    std::uint64_t version_ = 1;  ///< changes with each new box
    std::uint64_t digest_ = 0;
};

}  // namespace oiler
