// SPDX-License-Identifier: MIT
#pragma once

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
    Limits(Precision precision, int axes);

    /// Requires finite numbers on the axes of the world and 0 on the others. The message names
    /// `what`.
    void check(const Vec3& vector, std::string_view what) const;
    void check(const Body& body) const;
    /// Checks the forces per unit mass, as they are stored.
    void check(const GivenForces& forces, double mass) const;
    void check(const Link& link) const;
    void check(const Plane& plane) const;
    void check(const Contact& contact) const;

    void check(double number, std::string_view what) const;

private:
    double largest_;
    int axes_;
};

}  // namespace oiler
