// SPDX-License-Identifier: MIT
#include "oiler/physics/forces/forces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <tuple>

#include "oiler/physics/forces/forces.hpp"

namespace {

using oiler::AttractorForce;
using oiler::CoilSpringForce;
using oiler::for_each_number;
using oiler::Forces;
using oiler::Jacobian;
using oiler::QuadraticDragForce;
using oiler::State;
using oiler::Vec;
using Real = long double;

/// Numbers of size 1 without a pattern that could hide a wrong formula.
class Assorted {
public:
    /// Between 0.5 and 1.5.
    Real positive() {
        next_ = next_ * 69069 + 12345;
        return 0.5L + static_cast<Real>(next_ % 1024) / 1024;
    }
    /// A state at least 2 m from the anchors and centres of forces with positive numbers, at 0.5
    /// m/s.
    template <int Axes>
    State<Real, Axes> state() {
        State<Real, Axes> state{};
        for (Real& x : state.x.axis) x = positive() - 3;
        for (Real& v : state.v.axis) v = positive() < 1 ? positive() : -positive();
        return state;
    }

private:
    unsigned next_ = 1;
};

/// Calls f(force, state) for assorted numbers and states of every force, in 1, 2 and 3 axes.
template <int Axes, class F>
void for_each_force_of(F f) {
    Assorted assorted;
    std::apply(
        [&](auto... force) {
            const auto visit = [&](auto& one) {
                for (int i = 0; i < 20; ++i) {
                    for_each_number(one, [&](Real& number) { number = assorted.positive(); });
                    SCOPED_TRACE(std::string(one.name) + ", " + std::to_string(Axes) + " axes");
                    f(one, assorted.state<Axes>());
                }
            };
            (visit(force), ...);
        },
        oiler::ForceList<Real, Axes>{});
}
template <class F>
void for_each_force(F f) {
    for_each_force_of<1>(f);
    for_each_force_of<2>(f);
    for_each_force_of<3>(f);
}

constexpr Real epsilon = std::numeric_limits<Real>::epsilon();

template <int Axes>
void expect_near(const Vec<Real, Axes>& a, const Vec<Real, Axes>& b, Real tolerance) {
    EXPECT_LE(largest(a - b), tolerance);
}

/// f' at 0 from differences over ±h and ±2h. The error is h⁴·f⁽⁵⁾/30 plus 1.5 roundings of f over
/// h. Here |f| is at most 10. Because f is smooth within 1/4 m, m/s or s, f⁽⁵⁾ is below 5!·4⁵ times
/// that.
template <class F>
auto derivative(F f) {
    constexpr Real h = 1e-4L;
    return (f(h) - f(-h)) * (8 / (12 * h)) - (f(2 * h) - f(-2 * h)) * (1 / (12 * h));
}
constexpr Real derivative_error = 10 * (1e-16L / 30 * 120 * 1024 + 1.5L * epsilon / 1e-4L);

TEST(Forces, HaveTheirJacobians) {
    for_each_force([]<class Force, int Axes>(const Force& force, const State<Real, Axes>& state) {
        const Jacobian<Real, Axes> jacobian = force.jacobian(state);
        for (int j = 0; j < Axes; ++j) {
            const auto dx = derivative([&](Real h) {
                State<Real, Axes> at = state;
                at.x[j] += h;
                return force.accelerate(at, 0);
            });
            const auto dv = derivative([&](Real h) {
                State<Real, Axes> at = state;
                at.v[j] += h;
                return force.accelerate(at, 0);
            });
            for (int i = 0; i < Axes; ++i) {
                EXPECT_LE(std::abs(jacobian.dx(i, j) - dx[i]), derivative_error);
                EXPECT_LE(std::abs(jacobian.dv(i, j) - dv[i]), derivative_error);
            }
        }
    });
}

template <class Force, int Axes>
Vec<Real, Axes> field_of(const Force& force, const State<Real, Axes>& state) {
    if constexpr (requires { force.field(state.x, 0); })
        return force.field(state.x, 0);
    else
        return {};
}

TEST(Forces, HaveFieldsThatAreMinusTheGradientOfTheirPotentials) {
    for_each_force([]<class Force, int Axes>(const Force& force, const State<Real, Axes>& state) {
        const Vec<Real, Axes> field = field_of(force, state);
        for (int j = 0; j < Axes; ++j) {
            const Real slope = derivative([&](Real h) {
                State<Real, Axes> at = state;
                at.x[j] += h;
                return force.potential(at);
            });
            EXPECT_LE(std::abs(field[j] + slope), derivative_error);
        }
    });
}

/// The velocity after `tau` s of the force's damping at a fixed position.
template <class Force, int Axes>
Vec<Real, Axes> slowed(const Force& force, State<Real, Axes> state, Real tau) {
    if constexpr (requires { force.damping_rate(); })
        return state.v * std::exp(-force.damping_rate() * tau);
    else if constexpr (requires { force.rest_length; })
        force.damp(state, -std::expm1(-force.damping * tau));
    else if constexpr (requires { force.damp(state, tau); })
        force.damp(state, tau);
    return state.v;
}

// The acceleration minus the field is the derivative of the damping flow.
TEST(Forces, AccelerateByTheirFieldsAndTheirDamping) {
    for_each_force([]<class Force, int Axes>(const Force& force, const State<Real, Axes>& state) {
        const auto damping = derivative([&](Real h) { return slowed(force, state, h); });
        expect_near(force.accelerate(state, 0), field_of(force, state) + damping, derivative_error);
    });
}

// Integrates the accelerations with a Runge–Kutta method of order 4. They change at rates of up to
// 4/s (c·|v| of quadratic drag). With steps of 1/256 s the relative error is (4/256)⁴/120.
TEST(Forces, HaveDampingFlowsThatIntegrateTheirAccelerations) {
    for_each_force([]<class Force, int Axes>(const Force& force, const State<Real, Axes>& state) {
        constexpr Real dt = 1 / 256.0L;
        const Vec<Real, Axes> field = field_of(force, state);
        State<Real, Axes> at = state;
        const auto change = [&](const Vec<Real, Axes>& k, Real tau) {
            return force.accelerate({state.x, at.v + k * tau}, 0) - field;
        };
        for (int i = 0; i < 1024; ++i) {
            const auto k1 = change({}, 0);
            const auto k2 = change(k1, dt / 2);
            const auto k3 = change(k2, dt / 2);
            const auto k4 = change(k3, dt);
            at.v = at.v + (k1 + k2 * 2 + k3 * 2 + k4) * (dt / 6);
        }
        expect_near(slowed(force, state, 4), at.v, 1e-9L);
        // Forwards and backwards.
        const State<Real, Axes> later{state.x, slowed(force, state, 0.5L)};
        expect_near(slowed(force, later, -0.5L), state.v, 16 * epsilon);
    });
}

// Quadratic drag keeps the direction, and 1/|v| grows by c·τ.
TEST(QuadraticDrag, DampsBySpeedAndKeepsTheDirection) {
    const QuadraticDragForce<Real, 2> drag{0.5L};
    State<Real, 2> state{{}, {3, -4}};
    drag.damp(state, 0.8L);
    expect_near<2>(state.v, {1, -4 / 3.0L}, 4 * epsilon);
}

// The unit vector from the anchor is (0.6, 0.8). The component of (5, 0) along it is 3; (3.2, −2.4)
// across it stays.
TEST(CoilSpring, DampsOnlyAlongItsLine) {
    const CoilSpringForce<Real, 2> coil{{1, 1}, 7, 2, 4};
    State<Real, 2> state{{4, 5}, {5, 0}};
    coil.damp(state, 0.5L);
    expect_near<2>(state.v, {3.2L + 0.9L, -2.4L + 1.2L}, 16 * epsilon);
}

/// Gravity and attractors accelerate all masses equally. Other accelerations are force over mass.
template <class Force, int Axes>
constexpr bool pulls_all_masses_alike = std::is_same_v<Force, oiler::GravityForce<Real, Axes>> ||
                                        std::is_same_v<Force, AttractorForce<Real, Axes>>;

TEST(Forces, AreDividedByMass) {
    for_each_force([]<class Force, int Axes>(const Force& force, const State<Real, Axes>& state) {
        const Real mass = 2.5L;
        const Real share = pulls_all_masses_alike<Force, Axes> ? 1 : 1 / mass;
        const Force specific = force.per_unit_mass(mass);
        expect_near(specific.accelerate(state, 0), force.accelerate(state, 0) * share,
                    100 * epsilon);
        EXPECT_LE(std::abs(specific.potential(state) - force.potential(state) * share),
                  100 * epsilon);
    });
}

// A force is linear if the acceleration halfway between two states is the mean of theirs.
TEST(Forces, AreLinearIfTheySaySo) {
    for_each_force([]<class Force, int Axes>(const Force& force, const State<Real, Axes>& state) {
        const State<Real, Axes> other{state.x * 1.5L, state.v * -2};
        const State<Real, Axes> middle{(state.x + other.x) * 0.5L, (state.v + other.v) * 0.5L};
        const auto mean = (force.accelerate(state, 0) + force.accelerate(other, 0)) * 0.5L;
        const Real bend = largest(force.accelerate(middle, 0) - mean);
        if (Force::linear) {
            EXPECT_LE(bend, 100 * epsilon);
        } else if (Axes > 1 || !std::is_same_v<Force, CoilSpringForce<Real, Axes>>) {
            EXPECT_GT(bend, 1e-5L);  // a coil spring is not linear if its direction can turn
        }
    });
}

/// Forces as a test lists them.
template <int Axes>
struct Listed {
    oiler::ForceList<Real, Axes> list{};
    std::array<std::size_t, oiler::force_count> counts{};

    template <class Force>
    static constexpr std::size_t at =
        oiler::index_of<Force>(static_cast<oiler::ForceList<Real, Axes>*>(nullptr));
    template <class Force>
    [[nodiscard]] std::size_t count() const {
        return counts[at<Force>];
    }
    template <class Force>
    [[nodiscard]] const Force& get(std::size_t) const {
        return std::get<at<Force>>(list);
    }
};

// Absent forces must not be read; two forces of one kind act twice.
TEST(Forces, AddUpAllThatArePresent) {
    Assorted assorted;
    const State<Real, 2> state = assorted.state<2>();
    for (unsigned set = 0; set < 1U << oiler::force_count; ++set) {
        Listed<2> listed;
        Vec<Real, 2> acceleration{};
        Vec<Real, 2> field{};
        Real potential = 0;
        Real rate = 0;
        Jacobian<Real, 2> jacobian;
        oiler::for_each_index<oiler::force_count>([&](auto i) {
            auto& force = std::get<i>(listed.list);
            listed.counts[i] = (set >> i & 1U) * (1 + set % 2);
            for_each_number(force, [&](Real& number) {
                number = listed.counts[i] > 0 ? assorted.positive() : std::nanl("");
            });
            for (std::size_t index = 0; index < listed.counts[i]; ++index) {
                acceleration = acceleration + force.accelerate(state, 0);
                field = field + field_of(force, state);
                potential += force.potential(state);
                if constexpr (requires { force.damping_rate(); }) rate += force.damping_rate();
                jacobian = {jacobian.dx + force.jacobian(state).dx,
                            jacobian.dv + force.jacobian(state).dv};
            }
        });
        const Forces<Real, 2, Listed<2>> forces(listed);
        EXPECT_EQ(forces.accelerate(state, 0), acceleration) << set;
        EXPECT_EQ(forces.field(state.x, 0), field) << set;
        EXPECT_EQ(forces.potential(state), potential) << set;
        EXPECT_EQ(forces.damping_rate(), rate) << set;
        EXPECT_EQ(forces.jacobian(state).dx.row, jacobian.dx.row) << set;
        EXPECT_EQ(forces.jacobian(state).dv.row, jacobian.dv.row) << set;
    }
}

}  // namespace
