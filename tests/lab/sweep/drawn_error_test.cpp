// SPDX-License-Identifier: MIT
#include "oiler/lab/sweep/drawn_error.hpp"

#include "lab/motions.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

LinearMotion oscillation(Real omega, Real amplitude) {
    return {.k = omega * omega, .start = {{amplitude, 0, 0}, {}}};
}

/// The error of lines between exact steps.
double chord_error(const ExactMotion& motion, std::int64_t rate, Real until) {
    const ExactMotions motions({motion});
    DrawnError error(motions, 0, 0);
    for (std::int64_t n = 0; static_cast<Real>(n) < until * static_cast<Real>(rate); ++n) {
        const Real from = static_cast<Real>(n) / static_cast<Real>(rate);
        const Real to = static_cast<Real>(n + 1) / static_cast<Real>(rate);
        error.add({0, from, to, motion(from), motion(to), motion(from), motion(to)}, until);
    }
    return error.error();
}

// A parabola is 9.81 m/s²/8 · dt² from its chord.
TEST(DrawnError, OfAFallIsThatOfItsChord) {
    const LinearMotion fall{.acceleration = {0, -9.81L, 0}, .start = {{}, {3, 20, 0}}};
    for (const std::int64_t rate : {1, 30, 240}) {
        const double dt = 1 / static_cast<double>(rate);
        EXPECT_NEAR(chord_error(fall, rate, 5), 9.81 / 8 * dt * dt, 1e-12) << rate;
    }
}

// A chord from the phase −h/2 to h/2 is A(1 − cos(h/2)) below the crest; steps that are no divisor
// of the period come within 0.4 % of that.
TEST(DrawnError, OfAnOscillationIsThatOfTheChordBelowTheCrest) {
    for (const double h : {0.01, 0.1, 0.7, 1.9}) {
        const ExactMotion motion = oscillation(h * 100.3L, 2);
        const double expected = 2 * (1 - std::cos(h * 100.3 / 100 / 2));
        EXPECT_NEAR(chord_error(motion, 100, 20), expected, 0.01 * expected) << h;
    }
}

// All ends of steps, and their middles, fall on crests: the line stays at the crest, 2 A from the
// trough.
TEST(DrawnError, SeesWhatHappensBetweenStepsOfWholePeriods) {
    for (const int periods : {1, 2, 60, 4096}) {
        const ExactMotion motion = oscillation(2 * std::numbers::pi_v<Real> * periods, 1);
        EXPECT_NEAR(chord_error(motion, 1, 3), 2, 0.03) << periods;
    }
}

// The transient e^(−10⁴t) of a stiff damper is over within the first line, which is up to 2.4e-3 of
// the speed/rate off; after it, the motion is slow.
TEST(DrawnError, SeesATransientWithinAStep) {
    const LinearMotion motion{.c = 1e4L, .start = {{}, {100, 0, 0}}};
    // x = (1 − e^(−ct))·v/c; the line to 1/100 s is at v/c·ct/100.
    double most = 0;
    for (int i = 0; i <= 10000; ++i) {
        const double t = i * 1e-6;
        most = std::max(most, 0.01 * ((1 - std::exp(-1e4 * t)) - t * 100));
    }
    EXPECT_NEAR(chord_error(motion, 100, 1), most, 0.012 * most);
}

// Within a line of 1 s, an orbit of e = 0.9 passes its perihelion.
TEST(DrawnError, SeesThePerihelionOfAnOrbit) {
    constexpr Real e = 0.9L;
    // From half a period before the perihelion; the period is 2π.
    const Real half = std::numbers::pi_v<Real>;
    const State<Real, 3> start{{-1 - e, 0, 0}, {0, -std::sqrt((1 - e) / (1 + e)), 0}};
    const OrbitMotion motion{.gm = 1, .ellipse{1, start}, .nearest = 1 - e};
    const Real until = 6;
    Real most = 0;
    for (int n = 0; n < 6; ++n)
        for (int i = 0; i <= 2000; ++i) {
            const Real s = static_cast<Real>(i) / 2000;
            const auto at = [&](Real t) { return planet(e, n + t - half).x; };
            const auto off = at(0) + (at(1) - at(0)) * s - at(s);
            most = std::max(most, std::sqrt(squared_length(off)));
        }
    EXPECT_NEAR(chord_error(motion, 1, until), static_cast<double>(most),
                0.012 * static_cast<double>(most));
}

}  // namespace
}  // namespace oiler::test
