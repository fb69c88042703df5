// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <tuple>

#include "oiler/physics/forces/forces.hpp"
#include "oiler/sim/bodies.hpp"

namespace {

using oiler::Attractor;
using oiler::Bodies;
using oiler::CoilSpringForce;
using oiler::Direction;
using oiler::find_method;
using oiler::ForceList;
using oiler::Matrix;
using oiler::Precision;
using oiler::QuadraticDragForce;
using oiler::State;
using oiler::Vec;
using oiler::Vec3;
using Real = long double;

template <class T>
class Precise : public testing::Test {};
using Precisions = testing::Types<float, double, Real>;
TYPED_TEST_SUITE(Precise, Precisions);

// Also for a d other than 0 whose |d|² underflows to 0.
TYPED_TEST(Precise, DirectionsOfZeroAreZero) {
    for (const TypeParam x : {TypeParam(0), std::numeric_limits<TypeParam>::min() / 4}) {
        const Direction<TypeParam, 3> nowhere({x, -x, 0});
        EXPECT_EQ(nowhere.length, 0);
        EXPECT_EQ(nowhere.inverse_length, 0);
        EXPECT_EQ(nowhere.unit, (Vec<TypeParam, 3>{0, 0, 0}));
    }
    const Direction<TypeParam, 2> somewhere({3, -4});
    EXPECT_EQ(somewhere.length, 5);
    EXPECT_EQ(somewhere.inverse_length, TypeParam(1) / 5);
}

TYPED_TEST(Precise, ACoilSpringHasNoForceAtItsAnchor) {
    using T = TypeParam;
    const CoilSpringForce<T, 2> coil{{1, 2}, 7, 3, 4};
    State<T, 2> state{{1, 2}, {5, 6}};
    EXPECT_EQ(coil.accelerate(state, 0), (Vec<T, 2>{0, 0}));
    EXPECT_EQ(coil.field(state.x, 0), (Vec<T, 2>{0, 0}));
    EXPECT_EQ(coil.potential(state), T(0.5) * 7 * 16);
    EXPECT_EQ(coil.jacobian(state).dx.row, (Matrix<T, 2>::scalar(-7).row));
    EXPECT_EQ(coil.jacobian(state).dv.row, (Matrix<T, 2>{}.row));
    coil.damp(state, T(0.5));
    EXPECT_EQ(state.v, (Vec<T, 2>{5, 6}));
}

TYPED_TEST(Precise, QuadraticDragDoesNotMoveABodyAtRest) {
    using T = TypeParam;
    const QuadraticDragForce<T, 2> drag{3};
    State<T, 2> state{{1, 2}, {0, 0}};
    EXPECT_EQ(drag.accelerate(state, 0), (Vec<T, 2>{0, 0}));
    EXPECT_EQ(drag.jacobian(state).dv.row, (Matrix<T, 2>{}.row));
    drag.damp(state, 1);
    EXPECT_EQ(state.v, (Vec<T, 2>{0, 0}));
}

/// Expects no effect of all-zero forces, which the columns hold for bodies that lack a force.
template <class T>
void expect_nothing(const State<T, 2>& state) {
    const auto expect_of = [&]<class Force>(const Force& force) {
        SCOPED_TRACE(std::string(Force::name));
        EXPECT_EQ(accelerate(force, state, 0), (Vec<T, 2>{0, 0}));
        EXPECT_EQ(potential(force, state), 0);
        EXPECT_EQ(jacobian(force, state).dx.row, (Matrix<T, 2>{}.row));
        EXPECT_EQ(jacobian(force, state).dv.row, (Matrix<T, 2>{}.row));
        State<T, 2> damped = state;
        if constexpr (requires { force.damp(damped, T(0)); }) force.damp(damped, T(0));
        EXPECT_EQ(damped.v, state.v);
    };
    std::apply([&](const auto&... force) { (expect_of(force), ...); }, ForceList<T, 2>{});
}

TYPED_TEST(Precise, ZeroForcesDoNothing) {
    expect_nothing<TypeParam>({{3, -4}, {1, 2}});
    expect_nothing<TypeParam>({{3, -4}, {0, 0}});
}

// Includes the attractor's 0/|d|³.
TYPED_TEST(Precise, ZeroForcesDoNothingAtTheOrigin) { expect_nothing<TypeParam>({{0, 0}, {1, 2}}); }

// The sun itself has no attractor.
TEST(Attractor, DoesNotMoveASunInItsCentre) {
    for (const char* name : {"velocity_verlet", "rk4", "implicit_midpoint"}) {
        Bodies bodies(2, Precision::double_);
        bodies.add({.position = {1}, .velocity = {0, 1}}, Attractor{.gm = 1});
        bodies.add({.mass = 1e6});
        EXPECT_EQ(bodies.energy().potential, -1);
        bodies.step(find_method(name), {{64}, 0, 64});
        EXPECT_EQ(bodies.position(1), (Vec3{0, 0, 0}));
    }
}

}  // namespace
