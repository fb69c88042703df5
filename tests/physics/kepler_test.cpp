// SPDX-License-Identifier: MIT
#include "oiler/physics/closed_forms.hpp"
#include "support/reference.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

using State3 = State<Real, 3>;
using Vec3l = Vec<Real, 3>;

/// Of 64 bits, which references and series have, too: on ARM64, Real has 113.
constexpr Real round_off = std::max(std::numeric_limits<Real>::epsilon(), 0x1p-63L) / 2;
constexpr Real pi = std::numbers::pi_v<Real>;

Real length(const Vec3l& a) { return std::hypot(a[0], a[1], a[2]); }
Vec3l cross(const Vec3l& a, const Vec3l& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// Specific energy (m²/s²).
Real energy(Real gm, const State3& s) { return dot(s.v, s.v) / 2 - gm / length(s.x); }
Real half_axis(Real gm, const State3& s) { return -gm / (2 * energy(gm, s)); }

/// The tolerance for round-off after t s. A rounding of x and v at distance r changes the energy by
/// u·(v² + gm/r), so the mean motion by the fraction 3u·(v² + gm/r)·a/gm, so the angle by that
/// fraction. The anomaly's turns are rounded too. 4 roundings of each are allowed.
struct Slack {
    Real x;
    Real v;
};
Slack slack(Real gm, const State3& from, const State3& to, Real t) {
    const Real a = half_axis(gm, from);
    const Real turned = 1 + std::sqrt(gm / a) / a * std::abs(t);
    const auto growth = [&](const State3& s) {
        return (dot(s.v, s.v) + gm / length(s.x)) * a / gm;
    };
    const Real angle = 4 * round_off * turned * 3 * (growth(from) + 1);
    const Real seconds = angle / (std::sqrt(gm / a) / a);
    const Real r = length(to.x);
    return {seconds * length(to.v) + 16 * round_off * a,
            seconds * gm / (r * r) + 16 * round_off * length(to.v)};
}

void expect_state(Real gm, const State3& from, Real t, const State3& expected) {
    const State3 found = kepler(gm, from, t);
    const Slack most = slack(gm, from, expected, t);
    EXPECT_LE(length(found.x - expected.x), most.x) << "after " << t << " s";
    EXPECT_LE(length(found.v - expected.v), most.v) << "after " << t << " s";
}

/// An orthonormal frame whose orbital plane is not a coordinate plane. Swapping its first two axes
/// reverses the orbit.
struct Frame {
    Vec3l first{1, 0, 0};
    Vec3l second{0, 1, 0};

    static Frame tilted(bool retrograde) {
        const Vec3l a{2 / 7.0L, 3 / 7.0L, 6 / 7.0L};
        const Vec3l b{6 / 7.0L, 2 / 7.0L, -3 / 7.0L};
        return retrograde ? Frame{a, -b} : Frame{a, b};
    }
    [[nodiscard]] Vec3l place(const Vec3l& flat) const {
        return first * flat[0] + second * flat[1];
    }
    [[nodiscard]] State3 place(const State3& flat) const { return {place(flat.x), place(flat.v)}; }
};

/// A state at `t` s of the reference, in units of `metres` and `seconds`, so that gm is
/// metres³/seconds².
struct Units {
    Real metres = 1;
    Real seconds = 1;
    Frame frame{};

    [[nodiscard]] Real gm() const { return metres * metres * metres / (seconds * seconds); }
    [[nodiscard]] State3 state(const nlohmann::json& row) const {
        return frame.place(
            State3{{number<Real>(row.at(0)) * metres, number<Real>(row.at(1)) * metres, 0},
                   {number<Real>(row.at(2)) * (metres / seconds),
                    number<Real>(row.at(3)) * (metres / seconds), 0}});
    }
};

const std::array<const char*, 6> eccentricities{"e=0",   "e=0.2", "e=0.5",
                                                "e=0.6", "e=0.9", "e=0.99"};

/// Times and states of the reference's planet; the perihelion is at 0 s.
std::vector<std::pair<Real, State3>> states_of(const char* eccentricity, const Units& units) {
    const auto run =
        reference("coupled_and_kepler").at("kepler_GM1_a1").at("values").at(eccentricity);
    const auto& from = run.at("start");
    std::vector<std::pair<Real, State3>> states{
        {0, units.state({from.at("x"), from.at("y"), from.at("vx"), from.at("vy")})}};
    for (const char* t : {"1", "2", "5", "10", "50", "100"})
        states.emplace_back(std::stold(t) * units.seconds,
                            units.state(run.at("states (x,y,vx,vy)").at(t)));
    return states;
}

// From every state to every other state, also backwards in time.
void expect_reference(const Units& units) {
    for (const char* e : eccentricities) {
        SCOPED_TRACE(e);
        const auto states = states_of(e, units);
        ASSERT_EQ(states.size(), 7U);
        for (const auto& [t1, from] : states)
            for (const auto& [t2, to] : states) expect_state(units.gm(), from, t2 - t1, to);
    }
}

TEST(Kepler, MeetsTheReferenceFromAnyPoint) { expect_reference({}); }

// gm is 6.75 m³/s², on an inclined plane, in both directions.
TEST(Kepler, MeetsTheReferenceInSpaceAndOtherUnits) {
    expect_reference({.metres = 3, .seconds = 2, .frame = Frame::tilted(false)});
    expect_reference({.metres = 3, .seconds = 2, .frame = Frame::tilted(true)});
}

/// A start at true anomaly `angle` of an ellipse, in space.
struct Ellipse {
    Real e;
    Real angle;
};
constexpr Real gm_of_ellipses = 3.75L;
State3 start_of(const Ellipse& ellipse) {
    const Real p = 2 * (1 - ellipse.e * ellipse.e);  // of half an axis of 2 m
    const Real r = p / (1 + ellipse.e * std::cos(ellipse.angle));
    const Real speed = std::sqrt(gm_of_ellipses / p);
    return Frame::tilted(ellipse.angle > 2)
        .place(State3{
            {r * std::cos(ellipse.angle), r * std::sin(ellipse.angle), 0},
            {-speed * std::sin(ellipse.angle), speed * (ellipse.e + std::cos(ellipse.angle)), 0}});
}
std::vector<Ellipse> ellipses() {
    std::vector<Ellipse> all;
    for (const Real e : {0.0L, 0.1L, 0.5L, 0.8L, 0.95L})
        for (const Real angle : {0.0L, 0.7L, 2.5L, pi, 4.0L, 6.2L}) all.push_back({e, angle});
    return all;
}
const Real period = 2 * pi * std::sqrt(8 / gm_of_ellipses);
constexpr std::array<Real, 7> times{0.001L, 0.3L, 1, 2.25L, 7, 31, 200};

// Lagrange's g is a difference of two numbers of size t. 4 roundings of these move the planet by
// 4u·t·v0. Kepler's equation is solved with an equal error, plus 16 roundings of 2a, the size of
// the orbit. A displacement changes the energy by gm/r² times it, and the angular momentum by v
// times it.
TEST(Kepler, KeepsEnergyAndAngularMomentum) {
    for (const Ellipse& ellipse : ellipses()) {
        const State3 start = start_of(ellipse);
        const Vec3l momentum = cross(start.x, start.v);
        for (const Real t : times) {
            SCOPED_TRACE(testing::Message()
                         << "e = " << ellipse.e << ", angle " << ellipse.angle << ", t = " << t);
            const State3 now = kepler(gm_of_ellipses, start, t);
            const Real r = length(now.x);
            const Real v = length(now.v);
            const Real moved = round_off * (8 * t * length(start.v) + 32 * 4);
            EXPECT_LE(std::abs(energy(gm_of_ellipses, now) - energy(gm_of_ellipses, start)),
                      moved * gm_of_ellipses / (r * r) + 16 * round_off * v * v);
            EXPECT_LE(length(cross(now.x, now.v) - momentum), moved * v + 16 * round_off * r * v);
        }
    }
}

// The error of the first part changes the energy in the second part. It exceeds a rounding of the
// state by the angle that was turned.
TEST(Kepler, ContinuesFromAnyState) {
    for (const Ellipse& ellipse : ellipses()) {
        SCOPED_TRACE(testing::Message() << "e = " << ellipse.e << ", angle " << ellipse.angle);
        const State3 start = start_of(ellipse);
        for (const Real t1 : times)
            for (const Real t2 : {0.3L, 2.25L, 31.0L, -t1}) {
                const State3 middle = kepler(gm_of_ellipses, start, t1);
                const State3 expected = kepler(gm_of_ellipses, start, t1 + t2);
                const State3 found = kepler(gm_of_ellipses, middle, t2);
                const Slack first = slack(gm_of_ellipses, start, expected, t1 + std::abs(t2));
                const Slack second = slack(gm_of_ellipses, middle, expected, t2);
                const Real turned = 1 + 2 * pi * t1 / period;
                EXPECT_LE(length(found.x - expected.x), first.x + turned * second.x)
                    << t1 << " + " << t2;
                EXPECT_LE(length(found.v - expected.v), first.v + turned * second.v)
                    << t1 << " + " << t2;
            }
    }
}

TEST(Kepler, ComesBackAfterEachPeriod) {
    for (const Ellipse& ellipse : ellipses()) {
        SCOPED_TRACE(testing::Message() << "e = " << ellipse.e << ", angle " << ellipse.angle);
        const State3 start = start_of(ellipse);
        for (const int rounds : {0, 1, 7})
            expect_state(gm_of_ellipses, start, static_cast<Real>(rounds) * period, start);
    }
}

TEST(Kepler, AgreesWithTheOrbitFromItsNearestPoint) {
    for (const Real e : {0.0L, 0.1L, 0.5L, 0.8L, 0.95L}) {
        const Real nearest = 2 * (1 - e);
        const Real speed = std::sqrt(gm_of_ellipses / nearest * (1 + e));
        const State3 start{{nearest, 0, 0}, {0, speed, 0}};
        for (const Real t : times) {
            const auto flat = orbit(gm_of_ellipses, nearest, speed, t);
            SCOPED_TRACE(testing::Message() << "e = " << e);
            expect_state(gm_of_ellipses, start, t,
                         {{flat.x[0], flat.x[1], 0}, {flat.v[0], flat.v[1], 0}});
        }
    }
}

/// Whether the orbit with eccentricity `e` and its nearest point 2 m from gm = 3 m³/s² is elliptic.
bool is_elliptic_with(Real e) {
    return is_elliptic<Real>(3, {{0, 2, 0}, {0, 0, std::sqrt(1.5L * (1 + e))}});
}

TEST(IsElliptic, AcceptsEllipsesThatAreNotTooFlat) {
    for (const Real e : {0.0L, 0.5L, 0.95L, 0.9989L}) EXPECT_TRUE(is_elliptic_with(e)) << e;
    for (const Real e : {0.9991L, 1.0L, 1.0001L, 2.0L, 30.0L})
        EXPECT_FALSE(is_elliptic_with(e)) << e;
    for (const Ellipse& ellipse : ellipses())
        EXPECT_TRUE(is_elliptic(gm_of_ellipses, start_of(ellipse))) << ellipse.e << ellipse.angle;
}

// v² = 2·gm/r is not a closed orbit, and round-off must not make it one.
TEST(IsElliptic, RejectsParabolasAndHyperbolas) {
    EXPECT_FALSE(is_elliptic<Real>(1, {{2, 0, 0}, {0, 1, 0}}));
    EXPECT_FALSE(is_elliptic<Real>(1, {{2, 0, 0}, {0.6L, 0.8L, 0}}));
    EXPECT_FALSE(is_elliptic<Real>(1, {{2, 0, 0}, {0, 1.25L, 0}}));
    EXPECT_FALSE(is_elliptic<Real>(1, {{2, 0, 0}, {1.25L, 0, 0.5L}}));
    EXPECT_TRUE(is_elliptic<Real>(1, {{2, 0, 0}, {0, 0.75L, 0}}));
}

TEST(IsElliptic, RejectsFallsAndRepulsion) {
    EXPECT_FALSE(is_elliptic<Real>(1, {{2, 0, 0}, {0, 0, 0}}));
    EXPECT_FALSE(is_elliptic<Real>(1, {{2, 1, -2}, {-0.2L, -0.1L, 0.2L}}));
    EXPECT_FALSE(is_elliptic<Real>(1, {{2, 0, 0}, {0.5L, 0.01L, 0}}));
    EXPECT_FALSE(is_elliptic<Real>(1, {{0, 0, 0}, {0, 1, 0}}));
    EXPECT_FALSE(is_elliptic<Real>(-1, {{2, 0, 0}, {0, 0.75L, 0}}));
}

}  // namespace
}  // namespace oiler::test
