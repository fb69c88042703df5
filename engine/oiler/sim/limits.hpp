// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "oiler/core/error.hpp"
#include "oiler/physics/stepping.hpp"
#include "oiler/sim/body.hpp"

namespace oiler {

/// The error of a number that is not finite in the precision of the columns.
class NotFinite : public Error {
public:
    using Error::Error;
};

/// Checks whether columns of a precision and a number of axes can hold a value. The checks run
/// before anything is stored and throw Error{usage}, for numbers NotFinite.
class Limits {
public:
    constexpr Limits(Precision precision, int axes)
        : largest_(precision == Precision::single ? std::numeric_limits<float>::max()
                                                  : std::numeric_limits<double>::max()),
          largest_on_axis_{largest_, axes > 1 ? largest_ : 0, axes > 2 ? largest_ : 0} {}

    /// Requires finite numbers on the axes of the world and 0 on the others. The message names
    /// `what`.
    void check(const Vec3& vector, std::string_view what) const {
        for (std::size_t i = 0; i < 3; ++i)
            if (!(std::abs(vector.axis[i]) <= largest_on_axis_[i])) refuse(vector, what);
    }
    void check(const Body& body) const;
    /// Checks the forces per unit mass, as they are stored.
    void check(const GivenForces& forces, double mass) const;
    void check(const Link& link) const;
    void check(const Obstacle& obstacle) const;
    void check(const Contact& contact) const;

    void check(double number, std::string_view what) const {
        if (!(std::abs(number) <= largest_)) refuse(number, what);
    }

private:
    void check_shape(const HalfSpaceShape& shape) const;
    void check_shape(const CircleShape& shape) const;
    void check_shape(const SegmentShape& shape) const;
    void check_shape(const BoxShape& shape) const;
    [[nodiscard]] int axes() const {
        return static_cast<int>(3 - std::ranges::count(largest_on_axis_, 0.0));
    }
    [[noreturn, gnu::cold]] void refuse(double number, std::string_view what) const;
    [[noreturn, gnu::cold]] void refuse(const Vec3& vector, std::string_view what) const;

    double largest_;
    std::array<double, 3> largest_on_axis_;  ///< 0 for axes that the world lacks
};

}  // namespace oiler
