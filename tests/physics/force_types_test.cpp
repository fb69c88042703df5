// SPDX-License-Identifier: MIT
#include "oiler/physics/forces/forces.hpp"

#include "support/test.hpp"

namespace oiler::test {
namespace {

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
        ForceList<Real, Axes>{});
}
template <class F>
void for_each_force(F f) {
    for_each_force_of<1>(f);
    for_each_force_of<2>(f);
    for_each_force_of<3>(f);
}

/// s; drives are neither at a turn nor at zero.
constexpr double time = 0.3125;
constexpr Real epsilon = std::numeric_limits<Real>::epsilon();

template <int Axes>
void expect_near(const Vec<Real, Axes>& a, const Vec<Real, Axes>& b, Real tolerance) {
    EXPECT_LE(largest(a - b), tolerance);
}

/// f' at 0 from differences over ±h and ±2h. The error is h⁴·f⁽⁵⁾/30 plus 1.5 roundings of f over
/// h. Here |f| is at most 10. Because f is smooth within 1/8 m, m/s or s, as wind of 1.5·√3 m/s
/// against a body of that speed is, f⁽⁵⁾ is below 5!·8⁵ times that.
template <class F>
auto derivative(F f) {
    constexpr Real h = 1e-4L;
    return (f(h) - f(-h)) * (8 / (12 * h)) - (f(2 * h) - f(-2 * h)) * (1 / (12 * h));
}
constexpr Real derivative_error = 10 * (1e-16L / 30 * 120 * 32768 + 1.5L * epsilon / 1e-4L);

TEST(Forces, HaveTheirJacobians) {
    for_each_force([]<class Force, int Axes>(const Force& force, const State<Real, Axes>& state) {
        const Jacobian<Real, Axes> jacobian = oiler::jacobian(force, state);
        for (int j = 0; j < Axes; ++j) {
            const auto dx = derivative([&](Real h) {
                State<Real, Axes> at = state;
                at.x[j] += h;
                return accelerate(force, at, time);
            });
            const auto dv = derivative([&](Real h) {
                State<Real, Axes> at = state;
                at.v[j] += h;
                return accelerate(force, at, time);
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
    return field(force, state.x, time);
}

// A force that depends on time has no potential.
TEST(Forces, HaveFieldsThatAreMinusTheGradientOfTheirPotentials) {
    for_each_force([]<class Force, int Axes>(const Force& force, const State<Real, Axes>& state) {
        if (DependsOnTime<Force>) return;
        const Vec<Real, Axes> field = field_of(force, state);
        for (int j = 0; j < Axes; ++j) {
            const Real slope = derivative([&](Real h) {
                State<Real, Axes> at = state;
                at.x[j] += h;
                return potential(force, at);
            });
            EXPECT_LE(std::abs(field[j] + slope), derivative_error);
        }
    });
}

/// The velocity after `tau` s of the force's damping at a fixed position.
template <class Force, int Axes>
Vec<Real, Axes> slowed(const Force& force, State<Real, Axes> state, Real tau) {
    if constexpr (Linear<Force>)
        return state.v * std::exp(-linear_form(force).damping * tau);
    else if constexpr (Damps<Force, State<Real, Axes>, Real>)
        force.damp(state, force.prepare_damping(tau));
    return state.v;
}

// The acceleration minus the field is the derivative of the damping flow.
TEST(Forces, AccelerateByTheirFieldsAndTheirDamping) {
    for_each_force([]<class Force, int Axes>(const Force& force, const State<Real, Axes>& state) {
        const auto damping = derivative([&](Real h) { return slowed(force, state, h); });
        expect_near(accelerate(force, state, time), field_of(force, state) + damping,
                    derivative_error);
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
            return accelerate(force, State<Real, Axes>{state.x, at.v + k * tau}, time) - field;
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
constexpr bool pulls_all_masses_alike = std::is_same_v<Force, GravityForce<Real, Axes>> ||
                                        std::is_same_v<Force, AttractorForce<Real, Axes>>;

TEST(Forces, AreDividedByMass) {
    for_each_force([]<class Force, int Axes>(const Force& force, const State<Real, Axes>& state) {
        const Real mass = 2.5L;
        const Real share = pulls_all_masses_alike<Force, Axes> ? 1 : 1 / mass;
        const Force specific = force.per_unit_mass(mass);
        expect_near(accelerate(specific, state, time), accelerate(force, state, time) * share,
                    100 * epsilon);
        EXPECT_LE(std::abs(potential(specific, state) - potential(force, state) * share),
                  100 * epsilon);
    });
}

/// A coil spring is not linear if its direction can turn; a drive does not depend on the state.
template <class Force, int Axes>
constexpr bool bends = !Linear<Force> && !DependsOnTime<Force> &&
                       (Axes > 1 || !std::is_same_v<Force, CoilSpringForce<Real, Axes>>);

// A force is linear if the acceleration halfway between two states is the mean of theirs.
TEST(Forces, AreLinearIfTheySaySo) {
    for_each_force([]<class Force, int Axes>(const Force& force, const State<Real, Axes>& state) {
        const State<Real, Axes> other{state.x * 1.5L, state.v * -2};
        const State<Real, Axes> middle{(state.x + other.x) * 0.5L, (state.v + other.v) * 0.5L};
        const auto mean = (accelerate(force, state, time) + accelerate(force, other, time)) * 0.5L;
        const Real bend = largest(accelerate(force, middle, time) - mean);
        if (Linear<Force>) {
            EXPECT_LE(bend, 100 * epsilon);
        }
        if (bends<Force, Axes>) {
            EXPECT_GT(bend, 1e-5L);
        }
    });
}

// F·sin(2π·f·t + φ); the C library's sine of an angle below 2π is right to an ulp.
TEST(Drive, FollowsTheSine) {
    const DriveForce<Real, 2> drive{{3, -2}, 1.75L, 0.5L};
    for (const double t : {0.0, 0.125, 0.5, 1.0}) {
        const Real sine = std::sin(2 * std::numbers::pi_v<Real> * 1.75L * Real(t) + 0.5L);
        expect_near<2>(drive.field({}, t), Vec<Real, 2>{3, -2} * sine, 20 * epsilon);
    }
}

// Wind of the velocity of the body has no effect; in still air it is quadratic drag.
TEST(Wind, IsDragThroughMovingAir) {
    const State<Real, 2> state{{}, {3, -4}};
    EXPECT_EQ((WindForce<Real, 2>{{3, -4}, 5}.accelerate(state, 0)), (Vec<Real, 2>{}));
    EXPECT_EQ((WindForce<Real, 2>{{}, 5}.accelerate(state, 0)),
              (QuadraticDragForce<Real, 2>{5}.accelerate(state, 0)));
}

/// The forces that are not linear as a test lists them; the number of a damping is the duration.
template <int Axes>
struct Listed {
    ForceList<Real, Axes> list{};
    std::array<std::size_t, force_count> counts{};

    template <class Force>
    static constexpr std::size_t at = index_of<Force>(static_cast<ForceList<Real, Axes>*>(nullptr));
    template <class Force>
    [[nodiscard]] std::size_t count() const {
        return counts[at<Force>];
    }
    template <class Force>
    [[nodiscard]] const Force& get(std::size_t) const {
        return std::get<at<Force>>(list);
    }
    template <class Force>
    [[nodiscard]] Real damping_number(std::size_t index) const {
        return get<Force>(index).prepare_damping(0.25L);
    }
};

// Absent forces must not be read; two forces of one kind act twice.
TEST(Forces, AddUpAllThatArePresent) {
    Assorted assorted;
    const State<Real, 2> state = assorted.state<2>();
    for (unsigned set = 0; set < 1U << force_count; ++set) {
        Listed<2> listed;
        LinearForce<Real, 2> linear;
        Vec<Real, 2> acceleration{};
        Vec<Real, 2> fields{};
        Jacobian<Real, 2> jacobians;
        for_each_index<force_count>([&](auto i) {
            auto& force = std::get<i>(listed.list);
            listed.counts[i] = (set >> i & 1U) * (1 + set % 2);
            for_each_number(force, [&](Real& number) {
                number = listed.counts[i] > 0 ? assorted.positive() : std::nanl("");
            });
            for (std::size_t index = 0; index < listed.counts[i]; ++index) {
                if constexpr (Linear<std::decay_t<decltype(force)>>)
                    linear = linear + linear_form(force);
                acceleration = acceleration + accelerate(force, state, time);
                fields = fields + field_of(force, state);
                const Jacobian<Real, 2> one = jacobian(force, state);
                jacobians = {jacobians.dx + one.dx, jacobians.dv + one.dv};
            }
        });
        const Forces<Real, 2, LinearParts, Listed<2>> forces{linear, {true, true, true}, listed};
        // Each of up to 16 terms is at most 40 m/s² and is rounded a few times.
        constexpr Real tolerance = 16 * 40 * 4 * epsilon;
        EXPECT_LE(largest(forces.accelerate(state, time) - acceleration), tolerance) << set;
        EXPECT_LE(largest(forces.field(state.x, time) - fields), tolerance) << set;
        for (int i = 0; i < 2; ++i) {
            const auto of = forces.jacobian(state);
            EXPECT_LE(largest(of.dx.row[std::size_t(i)] - jacobians.dx.row[std::size_t(i)]),
                      tolerance);
            EXPECT_LE(largest(of.dv.row[std::size_t(i)] - jacobians.dv.row[std::size_t(i)]),
                      tolerance);
        }
        EXPECT_EQ(forces.depend_on_time(), listed.counts[7] > 0) << set;
    }
}

// Damping forwards, then backwards in reverse order, ends where it began: v is changed by no other
// flow in between. Two orders of two different flows do not commute.
TEST(Forces, DampInReverseOrderAfterTheStages) {
    Listed<2> listed;
    listed.counts = {0, 0, 0, 1, 1, 0, 1, 0};
    std::get<3>(listed.list) = {0.5L};
    std::get<4>(listed.list) = {{1, 1}, 7, 2, 4};
    std::get<6>(listed.list) = {{2, -1}, 0.75L};
    const Forces<Real, 2, LinearParts, Listed<2>> forces{{}, {}, listed};
    const State<Real, 2> start{{4, 5}, {5, 2}};
    State<Real, 2> forwards = start;
    std::get<3>(listed.list).damp(forwards, 0.25L);
    std::get<4>(listed.list).damp(forwards, std::get<4>(listed.list).prepare_damping(0.25L));
    std::get<6>(listed.list).damp(forwards, 0.25L);
    State<Real, 2> backwards = start;
    std::get<6>(listed.list).damp(backwards, 0.25L);
    std::get<4>(listed.list).damp(backwards, std::get<4>(listed.list).prepare_damping(0.25L));
    std::get<3>(listed.list).damp(backwards, 0.25L);
    State<Real, 2> one = start;
    forces.damp(one);
    State<Real, 2> other = start;
    forces.damp_in_reverse(other);
    EXPECT_EQ(one.v, forwards.v);
    EXPECT_EQ(other.v, backwards.v);
    EXPECT_GT(largest(one.v - other.v), 1e-3L);
}

struct TwoCoils {
    using Coil = CoilSpringForce<Real, 2>;
    std::array<Coil, 2> coils{Coil{{1, 1}, 7, 2, 4}, Coil{{-3, 2}, 5, 3, 1}};

    template <class Force>
    [[nodiscard]] std::size_t count() const {
        return std::is_same_v<Force, Coil> ? coils.size() : 0;
    }
    template <class Force>
    [[nodiscard]] Force get(std::size_t index) const {
        if constexpr (std::is_same_v<Force, Coil>) return coils[index];
        return {};
    }
    template <class Force>
    [[nodiscard]] Real damping_number(std::size_t index) const {
        return get<Force>(index).prepare_damping(0.25L);
    }
};

// Dampers along different lines do not commute either.
TEST(Forces, DampInReverseOrderAmongThoseOfOneKind) {
    const TwoCoils two;
    const Forces<Real, 2, LinearParts, TwoCoils> forces{{}, {}, two};
    const State<Real, 2> start{{4, 5}, {5, 2}};
    const auto damped = [&](std::size_t first, std::size_t second) {
        State<Real, 2> state = start;
        for (const std::size_t index : {first, second})
            two.coils[index].damp(state, two.coils[index].prepare_damping(0.25L));
        return state.v;
    };
    State<Real, 2> one = start;
    forces.damp(one);
    State<Real, 2> other = start;
    forces.damp_in_reverse(other);
    EXPECT_EQ(one.v, damped(0, 1));
    EXPECT_EQ(other.v, damped(1, 0));
    EXPECT_GT(largest(one.v - other.v), 1e-3L);
}

}  // namespace
}  // namespace oiler::test
