// SPDX-License-Identifier: MIT
#include "oiler/physics/closed_forms.hpp"
#include "oiler/physics/response.hpp"
#include "support/reference.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

/// The bits of T that references and series have, too: on ARM64, long double has 113.
template <class T>
constexpr int bits = std::min(std::numeric_limits<T>::digits, 64);
template <class T>
constexpr T round_off = T(0.5) / static_cast<T>(1ULL << (bits<T> - 1));

template <class T>
struct Oscillator {
    T m, k, b;
    Motion<T> start;
    T t;

    Motion<T> exact() const { return damped_oscillator(m, k, b, start, t); }
    T rate() const { return std::max(std::sqrt(k / m), b / (2 * m)); }
};

/// Sums, products and quotients have a few round-offs. The argument of an exponential or a sine has
/// one per radian or time constant. The factors 16 and 4 leave room for cancellation.
template <class T>
T relative_tolerance(T radians) {
    return (16 + 4 * radians) * round_off<T>;
}

template <class T>
void expect_near(Motion<T> motion, Motion<T> expected, T relative, T x_scale, T v_scale) {
    EXPECT_LE(std::abs(motion.x - expected.x), relative * x_scale) << motion.x << " " << expected.x;
    EXPECT_LE(std::abs(motion.v - expected.v), relative * v_scale) << motion.v << " " << expected.v;
}

/// Compares each number relative to its own size.
template <class T>
void expect_digits(const Oscillator<T>& oscillator, Motion<T> expected) {
    expect_near(oscillator.exact(), expected, relative_tolerance(oscillator.rate() * oscillator.t),
                std::abs(expected.x), std::abs(expected.v));
}

TEST(DampedOscillator, TheArticlesSpring) {
    const auto table = reference("article").at("exact_damped").at("table");
    ASSERT_EQ(table.size(), 9U);
    for (const auto& [t, state] : table.items()) {
        const Oscillator<double> spring{1, 15, 0.1, {1000, 0}, std::stod(t)};
        // x and v oscillate through zero, but their errors scale with the decayed amplitude. b is
        // rounded to double, which adds a round-off of γt, small compared with ωt.
        const double amplitude = 1000 * std::exp(-0.05 * spring.t);
        expect_near(spring.exact(), {number(state[0]), number(state[1])},
                    relative_tolerance(spring.rate() * spring.t), amplitude,
                    amplitude * spring.rate());
    }
}

TEST(DampedOscillator, TheUndampedSpring) {
    const auto table = reference("article").at("exact_undamped").at("table");
    ASSERT_EQ(table.size(), 9U);
    for (const auto& [t, state] : table.items()) {
        const Oscillator<double> spring{1, 15, 0, {1000, 0}, std::stod(t)};
        expect_near(spring.exact(), {number(state[0]), number(state[1])},
                    relative_tolerance(spring.rate() * spring.t), 1000.0, 1000 * spring.rate());
    }
}

// The literals below are x and v to 28 digits from
//   e^(−γt)·(x0·cosh δt + (v0 + γx0)·sinh(δt)/δ), e^(−γt)·(v0·cosh δt − (k/m·x0 + γv0)·sinh(δt)/δ),
// δ² = γ² − k/m, in Python:
//   from mpmath import *; mp.dps = 120  # 1500 for b = 1e8
//   m, k, b, x, v, t = map(mpf, ('2.5', '15', '0.75', '3', '-2', '2.5'))
//   g = b/(2*m); d = sqrt(mpc(g*g - k/m)); s = (sinh(d*t)/d).real if d else t; c = cosh(d*t).real
//   e = exp(-g*t); print(nstr(e*(x*c + (v+g*x)*s), 28), nstr(e*(v*c - (k/m*x + g*v)*s), 28))
template <class T>
class DampedOscillatorDigits : public testing::Test {};
using Types = testing::Types<double, long double>;
TYPED_TEST_SUITE(DampedOscillatorDigits, Types, );

template <class T>
Motion<T> digits(long double x, long double v) {
    return {static_cast<T>(x), static_cast<T>(v)};
}

// v is close to zero here. Its error scales with the amplitude, ω·x0·e^(−γt) = 5.1.
TYPED_TEST(DampedOscillatorDigits, Underdamped) {
    using T = TypeParam;
    const Oscillator<T> spring{2.5, 15, 0.75, {3, -2}, 2.5};
    expect_near<T>(spring.exact(),
                   digits<T>(2.105938262320290759003787626L, -0.5080662711496898249256963237L),
                   relative_tolerance(spring.rate() * spring.t), 2.1, 5.1);
}

TYPED_TEST(DampedOscillatorDigits, CriticallyDamped) {
    expect_digits<TypeParam>(
        {1, 4, 4, {1, -3}, 0.75},
        digits<TypeParam>(0.05578254003710745723332011769L, -0.3346952402226447433999207061L));
}

TYPED_TEST(DampedOscillatorDigits, Overdamped) {
    expect_digits<TypeParam>(
        {2.5, 1.5, 8, {-2, 5}, 1.25},
        digits<TypeParam>(-0.316779433574659559332666328L, 0.1715375176525738097528287171L));
}

TYPED_TEST(DampedOscillatorDigits, OnEitherSideOfCritical) {
    const TypeParam little = std::ldexp(TypeParam(1), -20);
    expect_digits<TypeParam>(
        {1, 4, 4 + little, {1, -3}, 0.75},
        digits<TypeParam>(0.05578268965751620974479296287L, -0.3346951803744937990370082621L));
    expect_digits<TypeParam>(
        {1, 4, 4 - little, {1, -3}, 0.75},
        digits<TypeParam>(0.05578239041665268746678615427L, -0.3346953000708392079575421163L));
}

TYPED_TEST(DampedOscillatorDigits, OnEitherSideOfCriticalFor32TimeConstants) {
    const TypeParam little = std::ldexp(TypeParam(1), -20);
    expect_digits<TypeParam>(
        {1, 4, 4 + little, {1, -3}, 16},
        digits<TypeParam>(-1.899743354539245758906844657e-13L, 3.672819931736279904827157406e-13L));
    expect_digits<TypeParam>(
        {1, 4, 4 - little, {1, -3}, 16},
        digits<TypeParam>(-1.899506313680156244340022368e-13L, 3.672396092374110597815056856e-13L));
}

// The textbook's γ − √(γ² − ω²) has an error of 29 % here. After the fast decay, t/1e8 time
// constants of the slow decay pass.
template <class T>
void expect_stiff_digits(T t, T radians, Motion<T> expected) {
    const Oscillator<T> oscillator{1, 1, T(1e8L), {1000, 7}, t};
    expect_near(oscillator.exact(), expected, relative_tolerance(radians), std::abs(expected.x),
                std::abs(expected.v));
}

TYPED_TEST(DampedOscillatorDigits, FarOverdamped) {
    using T = TypeParam;
    expect_stiff_digits<T>(
        std::ldexp(T(1), -27), 1,
        digits<T>(1000.000000036770506376636402L, 3.322941911755762757622198828L));
    expect_stiff_digits<T>(
        1, 0, digits<T>(999.9999900700001492999978508L, -0.000009999999900700002492999968578L));
    expect_stiff_digits<T>(
        T(1e8L), 1,
        digits<T>(367.8794411971938824775247352L, -0.00000367879441197193919265468855L));
}

// Near the critical point, x and v change by at most t²·x-scale·δb.
TEST(DampedOscillator, IsContinuousAcrossTheCriticalPoint) {
    const Motion<double> critical = Oscillator<double>{1, 4, 4, {1, -3}, 0.75}.exact();
    for (const double change : {1e-15, 1e-12, 1e-9, 1e-6})
        for (const double b : {4 - 4 * change, 4 + 4 * change}) {
            const Motion<double> near = Oscillator<double>{1, 4, b, {1, -3}, 0.75}.exact();
            EXPECT_NEAR(near.x, critical.x, 4 * change + 16 * round_off<double>) << b;
            EXPECT_NEAR(near.v, critical.v, 12 * change + 48 * round_off<double>) << b;
        }
}

TEST(DampedOscillator, WithoutSpringAndDamperIsFree) {
    const Motion<double> free = damped_oscillator(2.5, 0.0, 0.0, {3.0, -2.0}, 4.0);
    EXPECT_EQ(free.x, -5);
    EXPECT_EQ(free.v, -2);
}

// x = x0 + v0·(1 − e^(−ct))/c with c = b/m = ½ and t = 2 ln 2: e^(−ct) = ½.
TEST(DampedOscillator, WithoutSpringIsDrag) {
    const Motion<double> drag =
        damped_oscillator(2.0, 0.0, 1.0, {3.0, -2.0}, 2 * std::numbers::ln2);
    EXPECT_NEAR(drag.x, 3 - 2 * 0.5 / 0.5, 16 * round_off<double>);
    EXPECT_NEAR(drag.v, -1, 16 * round_off<double>);
}

TEST(DampedOscillator, StartsAtItsStart) {
    for (const double b : {0.0, 0.1, 4.0, 100.0, 1e8}) {
        const Motion<double> start = damped_oscillator(1.0, 4.0, b, {3.0, -2.0}, 0.0);
        EXPECT_EQ(start.x, 3) << b;
        // An overdamped velocity is a difference of terms as large as slow·x0 < 2·x0.
        EXPECT_NEAR(start.v, -2, 8 * round_off<double>) << b;
    }
}

/// Compares the motion over t1, continued over t2, with the motion over t1 + t2.
template <class F>
void expect_semigroup(F exact, double radians, double x_scale, double v_scale) {
    const Motion<double> start{3, -2};
    const Motion<double> halfway = exact(start, 0.75);
    expect_near(exact(halfway, 1.5), exact(start, 2.25), 2 * relative_tolerance(radians), x_scale,
                v_scale);
}

TEST(DampedOscillator, IsASemigroup) {
    for (const double b : {0.0, 0.1, 3.9, 4.0, 4.1, 100.0})
        expect_semigroup([b](Motion<double> start,
                             double t) { return damped_oscillator(1.0, 4.0, b, start, t); },
                         2 * 2.25, 4, 8);
}

TEST(LinearDragMotion, IsASemigroup) {
    for (const double c : {0.0, 1e-9, 0.4, 1.2, 50.0})
        expect_semigroup(
            [c](Motion<double> start, double t) { return linear_drag_motion(start, -9.81, c, t); },
            c * 2.25, 3 + 2 * 2.25 + 10 * 2.25 * 2.25, 2 + 10 * 2.25);
}

Motion<double> launch(double speed, double along) { return {0, speed * along}; }

TEST(LinearDragMotion, MatchesTheReferences) {
    const auto runs = reference("linear_drag");
    ASSERT_EQ(runs.size(), 2U);
    for (const auto& run : runs) {
        const double angle = number(run.at("deg")) * std::numbers::pi / 180;
        const double speed = number(run.at("v0"));
        const double c = number(run.at("beta"));
        const double g = number(run.at("g"));
        for (const auto& state : run.at("states")) {
            const double t = number(state.at("t"));
            const double fallen = g * t * t;
            const double tolerance = relative_tolerance(c * t);
            expect_near(linear_drag_motion(launch(speed, std::cos(angle)), 0.0, c, t),
                        {number(state.at("x")), number(state.at("vx"))}, tolerance, speed * t,
                        speed);
            expect_near(linear_drag_motion(launch(speed, std::sin(angle)), -g, c, t),
                        {number(state.at("y")), number(state.at("vy"))}, tolerance,
                        speed * t + fallen, speed + g * t);
        }
    }
}

// Drag changes x by at most c·t·(|v0|t + |a|t²), and v similarly.
TEST(LinearDragMotion, TendsToFreeFallAsDragVanishes) {
    const Motion<double> start{3, 20};
    const Motion<double> free = constant_acceleration(start, -9.81, 2.0);
    EXPECT_EQ(free.v, 20 - 2 * 9.81);
    EXPECT_DOUBLE_EQ(free.x, 3 + 40 - 2 * 9.81);
    for (const double c : {0.0, 1e-300, 1e-12, 1e-8, 1e-4}) {
        const Motion<double> slowed = linear_drag_motion(start, -9.81, c, 2.0);
        expect_near(slowed, free, 2 * c + 16 * round_off<double>, 3 + 40.0 + 40.0, 20.0 + 20.0);
    }
}

// phi2 changes from its series to its formula at c·t = 1.
TEST(LinearDragMotion, IsContinuousWhereItsFormulaChanges) {
    const double above = std::nextafter(1.0, 2.0);
    const Motion<double> series = linear_drag_motion({3.0, 20.0}, -9.81, 0.5, 2.0);
    const Motion<double> formula = linear_drag_motion({3.0, 20.0}, -9.81, 0.5 * above, 2.0);
    expect_near(formula, series, 16 * round_off<double>, 3 + 40.0 + 20.0, 40.0);
}

template <class T>
class OscillatorResponse : public testing::Test {};
using Precisions = testing::Types<float, double, long double>;
TYPED_TEST_SUITE(OscillatorResponse, Precisions);

/// The distance between neighbouring numbers of T at |x|.
template <class T>
T unit_at(T x) {
    using Limits = std::numeric_limits<T>;
    const int exponent = x == 0 ? Limits::min_exponent : std::ilogb(x);
    return std::ldexp(T(1), std::max(exponent, Limits::min_exponent - 1) - bits<T> + 1);
}

/// The error of a cancelled sum of size 1: nearly twice the digits of double, also for float.
constexpr long double remnant = 0x1p-100L;

/// The entries whose k, c and t are numbers of T.
template <class T>
std::vector<nlohmann::json> entries_for() {
    std::vector<nlohmann::json> entries;
    for (const auto& entry : reference("oscillator_response"))
        if (entry.value("digits", 24) <= std::numeric_limits<T>::digits) entries.push_back(entry);
    return entries;
}

template <class T>
Response<T> response_of(const nlohmann::json& entry) {
    return oscillator_response(number<T>(entry.at("k")), number<T>(entry.at("c")),
                               number<T>(entry.at("t")));
}

// The error is at most one unit of T; the reference is rounded to T. If decay or the remaining
// acceleration, 1 − k·sway, is a small difference of larger numbers, the error is relative to
// those.
TYPED_TEST(OscillatorResponse, IsRightToTheLastDigit) {
    const auto entries = entries_for<TypeParam>();
    ASSERT_GE(entries.size(), 49U);
    for (const auto& entry : entries) {
        SCOPED_TRACE(entry.at("name"));
        const Response<TypeParam> response = response_of<TypeParam>(entry);
        const auto expect = [&](TypeParam value, const char* name, long double size) {
            const auto expected = number<TypeParam>(entry.at(name));
            const long double slack = entry.contains("cancels") ? remnant * size : 0;
            EXPECT_LE(std::abs(value - expected), unit_at(expected) + slack) << name;
        };
        const auto t = number<long double>(entry.at("t"));
        expect(response.reach, "reach", std::abs(t));
        expect(response.sway, "sway", t * t);
        expect(response.decay, "decay", 1);
    }
}

TYPED_TEST(OscillatorResponse, OfNoTimeIsNoMove) {
    for (const TypeParam k : {-1.0F, 0.0F, 15.0F, 1e12F})
        for (const TypeParam c : {-1.0F, 0.0F, 0.1F, 1e12F}) {
            const auto response = oscillator_response<TypeParam>(k, c, 0);
            EXPECT_EQ(response.reach, 0);
            EXPECT_EQ(response.sway, 0);
            EXPECT_EQ(response.decay, 1);
        }
}

TYPED_TEST(OscillatorResponse, WithoutForcesIsTimeToTheLastBit) {
    for (const TypeParam t : {TypeParam(1) / 60, TypeParam(-0.3), TypeParam(1e9)}) {
        const auto response = oscillator_response<TypeParam>(0, 0, t);
        EXPECT_EQ(response.reach, t);
        EXPECT_EQ(response.sway, t * t / 2);
        EXPECT_EQ(response.decay, 1);
    }
}

// A unit of time twice as long changes exponents only.
TYPED_TEST(OscillatorResponse, DependsOnNoUnitOfTime) {
    for (const auto& entry : entries_for<TypeParam>()) {
        const auto k = number<TypeParam>(entry.at("k"));
        const auto c = number<TypeParam>(entry.at("c"));
        const auto t = number<TypeParam>(entry.at("t"));
        const auto one = oscillator_response(k, c, t);
        const auto other = oscillator_response(4 * k, 2 * c, t / 2);
        EXPECT_EQ(other.reach, one.reach / 2) << entry.at("name");
        EXPECT_EQ(other.sway, one.sway / 4) << entry.at("name");
        EXPECT_EQ(other.decay, one.decay) << entry.at("name");
    }
}

/// A sum and its tolerance: each term has a few factors with an error of one round-off.
template <class T>
struct Sum {
    T value = 0;
    T slack = 0;

    Sum(std::initializer_list<T> terms) {
        for (const T term : terms) {
            value += term;
            slack += 8 * std::numeric_limits<T>::epsilon() * std::abs(term);
        }
    }
};

/// Compares the response over t1, continued over t2, with that over t1 + t2. After t1, u is r1 (s1
/// for a), u' is d1 (r1), and the acceleration is −k·r1 (1 − k·s1).
template <class T>
void expect_response_semigroup(T k, T c, T t1, T t2) {
    const auto [r1, s1, d1] = oscillator_response(k, c, t1);
    const auto [r2, s2, d2] = oscillator_response(k, c, t2);
    const auto both = oscillator_response(k, c, t1 + t2);
    const auto expect = [](T value, const Sum<T>& sum) {
        EXPECT_LE(std::abs(value - sum.value), sum.slack + unit_at(value) + remnant);
    };
    expect(both.reach, {r1, d1 * r2, -k * r1 * s2});
    expect(both.reach, {r1 * d2, r2, -k * s1 * r2});
    expect(both.sway, {s1, r1 * r2, s2, -k * s1 * s2});
    expect(both.decay, {d1 * d2, -k * r1 * r2});
}

// All times are binary fractions, so that their sums are exact. Backwards in time, only dampings
// that grow to at most e^25 are tested.
TYPED_TEST(OscillatorResponse, IsASemigroup) {
    for (const float k : {0.0F, 1e-6F, 0.3F, 15.0F, 4e4F, 1e8F})
        for (const float c : {0.0F, 1e-6F, 0.1F, 2 * std::sqrt(15.0F), 50.0F, 400.0F, 1e8F})
            for (const float t1 : {1 / 1024.0F, 0.4375F, 3.0F})
                for (const float t2 : {1 / 1024.0F, 0.625F, -1 / 64.0F, -0.4375F}) {
                    if (t2 < 0 && c * -t2 > 25) continue;
                    SCOPED_TRACE(testing::Message() << k << " " << c << " " << t1 << " " << t2);
                    expect_response_semigroup<TypeParam>(k, c, t1, t2);
                }
}

// The integral of the equation from u' = 1 is decay − 1 = −c·reach − k·sway.
TYPED_TEST(OscillatorResponse, SolvesItsEquation) {
    for (const auto& entry : entries_for<TypeParam>()) {
        const auto [reach, sway, decay] = response_of<TypeParam>(entry);
        const auto k = number<TypeParam>(entry.at("k"));
        const auto c = number<TypeParam>(entry.at("c"));
        const Sum<TypeParam> left{decay, c * reach, k * sway};
        EXPECT_LE(std::abs(left.value - 1), left.slack) << entry.at("name");
    }
}

// e^1000 is finite in long double only, e^20000 in no type.
TEST(OscillatorResponse, IsNotFiniteWhereTheResultOverflows) {
    EXPECT_FALSE(std::isfinite(oscillator_response<float>(0, -1000, 1).decay));
    EXPECT_FALSE(std::isfinite(oscillator_response<double>(0, 1000, -1).decay));
    const long double decay = oscillator_response<long double>(0, -1000, 1).decay;
    EXPECT_NEAR(static_cast<double>(std::log(decay)), 1000, 1e-12);
    EXPECT_FALSE(std::isfinite(oscillator_response<long double>(0, -20000, 1).decay));
}

}  // namespace
}  // namespace oiler::test
