// SPDX-License-Identifier: MIT
#include "oiler/lab/reference/reference.hpp"

#include <fmt/format.h>

#include <array>

#include "lab/motions.hpp"
#include "oiler/scene/read.hpp"
#include "oiler/sim/bodies.hpp"
#include "support/metres.hpp"
#include "support/reference.hpp"
#include "support/rope_fall.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr double double_round_off = std::numeric_limits<double>::epsilon() / 2;

ClosedForm claimed(const Motions& motions) {
    return [motions](const Bodies&, double) { return std::optional(motions); };
}
std::optional<Motions> none(const Bodies&, double) { return std::nullopt; }

/// Enough work for all scenes here; it takes about 1 s.
ReferenceEffort effort() {
    ReferenceEffort effort;
    effort.most_work = 2e7;
    return effort;
}

double length(const Vec<Real, 3>& a) { return static_cast<double>(std::hypot(a[0], a[1], a[2])); }

Scene article_scene(double damping, double duration) {
    Scene scene;
    scene.duration = duration;
    scene.bodies = {{.position = {1000, 0, 0}}};
    scene.springs = {{.stiffness = 15, .damping = damping}};
    return scene;
}

/// Expects errors within the reference's uncertainties, plus `given` (m, m/s) for initial values
/// that are rounded to double.
void expect_within_uncertainties(const Reference& reference, const Motions& motions,
                                 double given = 0) {
    ASSERT_EQ(reference.uncertainties.size(), static_cast<std::size_t>(reference.samples.count));
    for (std::int64_t sample = 0; sample < reference.samples.count; ++sample)
        for (std::size_t row = 0; row < motions.size(); ++row) {
            const State3 exact = motions[row](static_cast<Real>(sample) /
                                              static_cast<Real>(reference.samples.per_second));
            const State3 found = reference.motion->at(
                row, static_cast<Real>(sample) / static_cast<Real>(reference.samples.per_second));
            const Uncertainty& uncertainty =
                reference.uncertainties[static_cast<std::size_t>(sample)];
            ASSERT_LE(length(found.x - exact.x), uncertainty.position + given)
                << sample << " " << row;
            ASSERT_LE(length(found.v - exact.v), uncertainty.velocity + given)
                << sample << " " << row;
        }
}

/// Expects an uncertainty of about the default, 10⁻¹² of the extent.
void expect_fine_steps(const Scene& scene, const Motions& motions, double given = 0) {
    const Reference reference = make_reference(scene, effort(), {}, none);
    EXPECT_FALSE(reference.closed_form);
    EXPECT_TRUE(holds(reference.words, "in long double by"));
    EXPECT_EQ(reference.why_no_longer, "");
    EXPECT_LE(reference.uncertainties.back().position, 1e-11 * reference.extent) << reference.words;
    EXPECT_GT(reference.uncertainties.back().position, 0);
    expect_within_uncertainties(reference, motions, given);
}

TEST(FineSteps, OfTheArticlesSpring) {
    expect_fine_steps(article_scene(0, 20), {article_motion(0)});
    expect_fine_steps(article_scene(0.125, 90), {article_motion(0.125)});
    // Stiff enough to need more than the fewest runs.
    Scene stiff = article_scene(0, 20);
    stiff.springs[0].stiffness = 6000;
    expect_fine_steps(stiff, {article_motion(0, 6000)});
}

// Double rounds positions of 1000 m by 1e-13 m, and more in each of the many steps.
TEST(FineSteps, AreInDoubleWhereThatSuffices) {
    for (const auto& [wanted, words] :
         {std::pair(1e-5, "in double by"), std::pair(1e-14, "in long double by")}) {
        ReferenceEffort asked = effort();
        asked.wanted = wanted;
        const Reference reference = make_reference(article_scene(0.125, 90), asked, {}, none);
        EXPECT_TRUE(holds(reference.words, words));
        EXPECT_LE(reference.uncertainties.back().position, std::max(wanted, 1e-11 * 2000));
        expect_within_uncertainties(reference, {article_motion(0.125)});
    }
}

// 0.4 is rounded to double, which changes the frequency by 3·2·u·0.4/0.4² and moves the planet with
// a speed of up to 2 (and an acceleration of up to 1/0.4²).
TEST(FineSteps, OfAnOrbit) {
    Scene scene;
    scene.axes = 2;
    scene.duration = 12.566;
    scene.bodies = {{.position = {0.4, 0, 0}, .velocity = {0, 2, 0}}};
    scene.attractors = {{.gm = 1}};
    expect_fine_steps(scene, {[](Real t) { return planet(0.6L, t); }},
                      12.566 * 15 * 0.4 * double_round_off * 6.25);
}

TEST(FineSteps, OfTheChainMeetItsNormalModes) {
    expect_fine_steps(read_scene(OILER_SOURCE "/assets/scenes/chain.toml"),
                      {chain_motion(1), chain_motion(-1)});
}

// The initial speed, g and the drag coefficient of the file are rounded to double, which moves the
// projectile by about u·(speed·t + g·t²).
TEST(FineSteps, OfADraggedProjectileMeetTheReference) {
    const auto runs = reference("projectile_quadratic_drag");
    const auto& run = runs.at(0);
    Scene scene;
    scene.axes = 2;
    scene.duration = 8;
    scene.gravity = {0, -number(run.at("g")), 0};
    scene.bodies = {{.matter = {.quadratic_drag = number(run.at("k_per_m"))},
                     .velocity = {number(run.at("vx0")), number(run.at("vy0")), 0}}};
    ReferenceEffort little;
    little.most_work = 1e5;
    const Reference fine = make_reference(scene, little);
    const SampleTimes& samples = fine.samples;
    EXPECT_FALSE(fine.closed_form);
    EXPECT_LE(fine.uncertainties.back().position, 1e-11 * fine.extent) << fine.words;
    ASSERT_EQ(run.at("states").size(), 9U);
    for (const auto& state : run.at("states")) {
        const double t = number(state.at("t"));
        const auto sample = std::lround(t * static_cast<double>(samples.per_second));
        const State3 found = fine.motion->at(0, t);
        const Uncertainty& uncertainty = fine.uncertainties[static_cast<std::size_t>(sample)];
        const double given = double_round_off * (30 * t + 10 * t * t);
        EXPECT_LE(length(found.x -
                         Vec<Real, 3>{number<Real>(state.at("x")), number<Real>(state.at("y")), 0}),
                  uncertainty.position + given)
            << t;
        EXPECT_LE(length(found.v - Vec<Real, 3>{number<Real>(state.at("vx")),
                                                number<Real>(state.at("vy")), 0}),
                  uncertainty.velocity + double_round_off * (30 + 10 * t))
            << t;
    }
}

// A constant uncertainty would pass the other tests. Here ω·dt is 1.6 to 0.2. Twice the work allows
// twice the samples: the error of the interpolation between them, the larger part, is divided by
// 2⁸.
TEST(FineSteps, AreMoreUncertainAtLargerSteps) {
    Scene scene = article_scene(0, 20);
    scene.springs[0].stiffness = 6000;
    double before = 0;
    for (const double work : {1e5, 2e5, 4e5}) {
        ReferenceEffort less;
        less.wanted = 1e-18;
        less.most_work = work;
        const Reference reference = make_reference(scene, less, {}, none);
        const double uncertainty = reference.uncertainties.back().position;
        if (before > 0) {
            EXPECT_LT(uncertainty, before / 200) << reference.words;
        }
        before = uncertainty;
        expect_within_uncertainties(reference, {article_motion(0, 6000)});
        EXPECT_LT(reference.uncertainties.front().position, uncertainty);
    }
}

TEST(ClosedFormReference, StatesItsError) {
    const Scene scene = article_scene(0, 20);
    const Reference reference = make_reference(scene, effort());
    EXPECT_TRUE(reference.closed_form);
    EXPECT_TRUE(holds(reference.words, "confirmed by fine steps to"));
    EXPECT_EQ(reference.why_no_longer, "");
    EXPECT_EQ(reference.meaningful_until, 20);
    expect_within_uncertainties(reference, {article_motion(0)});
    EXPECT_NEAR(reference.extent, 2000, 2);
    EXPECT_NEAR(reference.energy_scale, 7.5e6, 1e-4 * 7.5e6);
    EXPECT_LE(reference.uncertainties.back().position, 1e-12 * 2000);
    EXPECT_EQ(reference.floor().position, 100 * reference.uncertainties.back().position);
    EXPECT_EQ(reference.floor().velocity, 100 * reference.uncertainties.back().velocity);
    EXPECT_EQ(reference.floor().energy, 100 * reference.uncertainties.back().energy);
    ASSERT_TRUE(reference.oscillation);
    EXPECT_EQ(reference.oscillation->crossings.size(), 12U);
}

TEST(ClosedFormReference, StatesThatItIsNotChecked) {
    const Scene scene = article_scene(0, 20);
    ReferenceEffort none_at_all;
    none_at_all.most_work = 1;
    const Reference reference = make_reference(scene, none_at_all);
    EXPECT_TRUE(reference.closed_form);
    EXPECT_TRUE(holds(reference.words, "not checked by fine steps: too much work"));
}

double largest_difference(const ExactMotion& a, const ExactMotion& b, const SampleTimes& samples) {
    double most = 0;
    for (std::int64_t sample = 0; sample < samples.count; ++sample) {
        const Real t = static_cast<Real>(sample) / static_cast<Real>(samples.per_second);
        most = std::max(most, length(a(t).x - b(t).x));
    }
    return most;
}

/// Expects a wrong closed form to be rejected, with its error to two digits.
void expect_rejected(const Scene& scene, const ExactMotion& wrong, const ExactMotion& right) {
    const Reference reference = make_reference(scene, effort(), {}, claimed({wrong}));
    EXPECT_FALSE(reference.closed_form);
    const std::string says = "closed form rejected: it differs by ";
    const std::size_t at = reference.words.find(says);
    ASSERT_NE(at, std::string::npos) << reference.words;
    const double told = metres_in(reference.words.substr(at + says.size()));
    const double difference = largest_difference(wrong, right, reference.samples);
    EXPECT_NEAR(told, difference, 0.05 * difference) << reference.words;
    expect_within_uncertainties(reference, {right});
    EXPECT_LE(reference.uncertainties.back().position, 1e-11 * reference.extent);
}

// x0·e^(−γt)·cos ω0·t has an error of up to 12.78 m.
TEST(WrongClosedForm, AsTheArticlePublishedItIsRejected) {
    const ExactMotion wrong = [](Real t) {
        const Real omega = std::sqrt(15.0L);
        const Real decay = 1000 * std::exp(-0.0625L * t);
        return along_x(decay * std::cos(omega * t),
                       -decay * (0.0625L * std::cos(omega * t) + omega * std::sin(omega * t)));
    };
    expect_rejected(article_scene(0.125, 30), wrong, article_motion(0.125));
}

// 10⁻⁶ of the stiffness is 5·10⁻⁷ of the frequency: 1.9 cm after 10 s.
TEST(WrongClosedForm, ByAMillionthIsRejected) {
    expect_rejected(article_scene(0, 10), article_motion(0, 15 * (1 + 2e-6L)), article_motion(0));
    expect_rejected(article_scene(0.125, 10), article_motion(0.125, 15 * (1 - 1e-6L)),
                    article_motion(0.125));
}

// A faster oscillation needs finer steps: 2·10⁻⁸ of the stiffness are 1.2 cm of 1000 m after 195
// periods.
TEST(WrongClosedForm, OfAFastSpringIsRejected) {
    Scene scene = article_scene(0, 10);
    scene.springs[0].stiffness = 15000;
    expect_rejected(scene, article_motion(0, 15000 * (1 + 2e-8L)), article_motion(0, 15000));
}

// Only one of two bodies is wrong, and only late in the run.
TEST(WrongClosedForm, OfOneBodyIsRejected) {
    Scene scene = article_scene(0, 10);
    scene.bodies.push_back(scene.bodies[0]);
    scene.springs.push_back(scene.springs[0]);
    scene.springs[1].body = 1;
    const ExactMotion right = article_motion(0);
    const ExactMotion wrong = [=](Real t) {
        State3 state = right(t);
        if (t > 9) state.x[0] += 0.001L;
        return state;
    };
    const Reference reference = make_reference(scene, effort(), {}, claimed({right, wrong}));
    EXPECT_TRUE(holds(reference.words, "differs by 1 mm"));
    EXPECT_FALSE(reference.closed_form);
    expect_within_uncertainties(reference, {right, right});
}

/// A body of 2 kg that starts at 0 m with the given speed and falls for 2 s at 10 m/s².
Scene falling(double speed) {
    Scene scene;
    scene.stepping.rate.steps = 60;
    scene.duration = 2;
    scene.gravity = {{-10, 0, 0}};
    scene.bodies = {{.matter = {.mass = 2}, .velocity = {-speed, 0, 0}}};
    return scene;
}

double energy_scale_of(const Scene& scene) { return make_reference(scene, effort()).energy_scale; }

// The body gains ½·2·20² = 400 J of kinetic energy at 20 m/s and loses as much potential energy.
TEST(EnergyScale, IsTheLargestKineticEnergy) {
    EXPECT_NEAR(energy_scale_of(falling(0)), 400, 1e-9);
    // ½·2·22.5² J; the range of the potential energy is 500 J.
    EXPECT_NEAR(energy_scale_of(falling(2.5)), 506.25, 1e-9);
}

// The slow rate of decay is 40/(40 + √1560) = 0.503 1/s: the speed stays below 0.51 m/s, and all
// but e^−10 of ½·40·1² J is lost.
TEST(EnergyScale, IsTheRangeOfThePotentialIfLarger) {
    Scene scene;
    scene.duration = 10;
    scene.bodies = {{.position = {1, 0, 0}}};
    scene.springs = {{.stiffness = 40, .damping = 80}};
    EXPECT_NEAR(energy_scale_of(scene), 20, 0.01);
}

// 3 J lost are the same share of the energy wherever the origin is.
TEST(EnergyScale, DoesNotDependOnTheOrigin) {
    Scene scene = falling(0);
    const double at_origin = energy_scale_of(scene);
    scene.bodies[0].position = {1e4, 0, 0};
    EXPECT_NEAR(energy_scale_of(scene), at_origin, 1e-6);
}

// A planet at 1 m with e = 0.6 from the aphelion, gm = 1: its speed is 2 m/s at 0.4/1.6 of that
// distance.
TEST(EnergyScale, OfAnOrbitIsTheKineticEnergyAtThePerihelion) {
    Scene scene;
    scene.axes = 2;
    scene.duration = 6.3;
    scene.bodies = {{.position = {1.6, 0, 0}, .velocity = {0, 0.5, 0}}};
    scene.attractors = {{.gm = 1}};
    EXPECT_NEAR(energy_scale_of(scene), 2, 2e-3);
}

TEST(EnergyScale, IsZeroWithoutMotionSoThatDriftsAreInJoules) {
    Scene scene;
    scene.duration = 1;
    scene.bodies = {{.position = {0, 0, 0}}};
    const Reference reference = make_reference(scene, effort());
    EXPECT_EQ(reference.energy_scale, 0);
    EXPECT_EQ(reference.share_of_energy(3), 3);
}

// The rope becomes taut and slack within steps, so that no run has more than order 2 or, with
// damping, 1. Extrapolation would claim more.
TEST(Ropes, HaveAReferenceThatKnowsItsError) {
    for (const double damping : {0.0, 4.0}) {
        Scene scene;
        scene.axes = 1;
        scene.duration = 1.5;
        scene.gravity = Vec3{-Fall::g};
        scene.bodies = {{.velocity = {1}}};
        scene.springs = {
            {.stiffness = 200, .damping = damping, .rest_length = 2, .pulls_only = true}};
        const Fall fall(link_of(scene.springs[0]), 1);
        const Motions exact{[&](Real t) {
            const auto [x, v] = fall.at(t);
            return State3{{x, 0, 0}, {v, 0, 0}};
        }};
        const Reference reference = make_reference(scene, effort());
        EXPECT_FALSE(reference.closed_form);
        EXPECT_FALSE(holds(reference.words, "extrapolated")) << reference.words;
        EXPECT_LT(reference.uncertainties.back().position, 1e-3) << reference.words;
        expect_within_uncertainties(reference, exact);
    }
}

/// A double pendulum of springs as stiff as rods. Neighbouring motions diverge e-fold in less than
/// 1 s.
constexpr const char* double_pendulum = R"(
[scene]
axes = 2
rate = 120
duration = 40.0
[gravity]
acceleration = [0.0, -9.81]
[[body]]
name = "upper"
position = [1.0, 0.5]
[[body]]
name = "lower"
position = [1.5, 1.5]
[[spring]]
body = "upper"
anchor = [0.0, 0.0]
stiffness = 400.0
rest_length = 1.118
[[spring]]
body = "upper"
to = "lower"
stiffness = 400.0
rest_length = 1.118
)";

TEST(ChaoticScene, IsMeaningfulForAWhileOnly) {
    const Scene scene = parse_scene(double_pendulum, "double_pendulum");
    const auto with = [&](double work) {
        ReferenceEffort limited;
        limited.most_work = work;
        return make_reference(scene, limited);
    };
    const Reference poor = with(1e6);
    const Reference better = with(1e7);
    EXPECT_FALSE(better.closed_form);
    EXPECT_LT(better.meaningful_until, scene.duration);
    EXPECT_LT(poor.meaningful_until, better.meaningful_until);
    EXPECT_GT(poor.meaningful_until, 1) << poor.words;
    const SampleTimes& samples = poor.samples;
    for (std::int64_t sample = 0; samples.time(sample) < poor.meaningful_until; ++sample) {
        const Uncertainty& uncertainty = poor.uncertainties[static_cast<std::size_t>(sample)];
        const Real t = static_cast<Real>(sample) / static_cast<Real>(samples.per_second);
        for (std::size_t row = 0; row < 2; ++row) {
            const State3 a = poor.motion->at(row, t);
            const State3 b = better.motion->at(row, t);
            const auto later = static_cast<std::size_t>(
                std::ceil(t * static_cast<Real>(better.samples.per_second)));
            const Uncertainty& own = better.uncertainties[later];
            ASSERT_LE(length(a.x - b.x), 100 * (uncertainty.position + own.position))
                << samples.time(sample);
            ASSERT_LE(length(a.v - b.v), 100 * (uncertainty.velocity + own.velocity))
                << samples.time(sample);
        }
    }
    EXPECT_TRUE(holds(poor.why_no_longer, "chaotic"));
    EXPECT_LE(poor.floor().position, 1e-3 * poor.extent);
}

// A ball with quadratic drag falls from rest and bounces once. With w² = g/c it falls
// w²/g·ln cosh(g·t/w), and after leaving at speed u = w·tan φ it is at
// w²/g·ln(cos(φ − g·t/w)/cos φ).
TEST(ReferenceByFineSteps, FollowsABounceAtAllTimes) {
    const Real g = 9.81L;
    const Real e = 0.75L;
    const Real w = std::sqrt(g / 0.125L);
    const Real height = 2;
    const Scene scene = parse_scene(
        "[scene]\naxes = 1\nduration = 1.2\n[gravity]\nacceleration = [-9.81]\n"
        "[[plane]]\nnormal = [1.0]\nrestitution = 0.75\n"
        "[[body]]\nposition = [2.25]\nquadratic_drag = 0.125\ncontact = 0.25\n",
        "test");
    const Reference reference = make_reference(scene, effort());
    EXPECT_FALSE(reference.closed_form);
    EXPECT_EQ(reference.meaningful_until, 1.2);
    const Real impact = w / g * std::acosh(std::exp(g * height / (w * w)));
    const Real phi = std::atan(e * std::tanh(g * impact / w));
    const Real top = impact + phi * w / g;
    const auto log_ratio = [&](Real a, Real b) { return w * w / g * std::log(a / b); };
    const auto fallen = [&](Real t) { return log_ratio(std::cosh(g * t / w), 1); };
    const Real highest = log_ratio(1, std::cos(phi));
    const double own = reference.uncertainties.back().position;
    EXPECT_LE(own, 1e-8);
    for (Real t = 0.0003L; t < 1.2L; t += 0.0017L) {
        const Real risen = log_ratio(std::cos(phi - g * (t - impact) / w), std::cos(phi));
        const Real x = t < impact ? height - fallen(t)
                       : t < top  ? risen
                                  : highest - fallen(t - top);
        EXPECT_NEAR(static_cast<double>(reference.motion->at(0, t).x[0] - 0.25L - x), 0,
                    2 * own + 2e-16)
            << static_cast<double>(t);
    }
}

// Between elastic planes 1 mm apart, 10 m/s are 10,000 impacts a second.
TEST(ReferenceByFineSteps, FollowNoBodyThatOnlyBounces) {
    const auto between = [](double seconds) {
        Scene scene;
        scene.axes = 1;
        scene.duration = seconds;
        scene.planes = {{.plane = {.normal = {1}, .restitution = 1}},
                        {.plane = {.normal = {-1}, .offset = -0.001, .restitution = 1}}};
        scene.bodies = {{.position = {0.0005, 0, 0}, .velocity = {10, 0, 0}}};
        scene.bodies.front().matter.contact = 0;
        return scene;
    };
    EXPECT_NO_THROW((void)make_reference(between(0.1), effort()));
    const std::string line =
        line_of_error(Exit::usage, [&] { (void)make_reference(between(10), effort()); });
    EXPECT_TRUE(holds(line, "a body meets planes more than 20000 times")) << line;
    EXPECT_TRUE(holds(line, "--duration")) << line;
}

/// Two linked bodies over a floor, of which the lower one meets it.
Scene landing_pair(double duration, double restitution) {
    return parse_scene(
        fmt::format("[scene]\naxes = 1\nduration = {}\n[gravity]\nacceleration = [-9.81]\n"
                    "[[plane]]\nnormal = [1.0]\nrestitution = {}\n"
                    "[[body]]\nname = \"a\"\nposition = [1.0]\ncontact = 0.0\n"
                    "[[body]]\nname = \"b\"\nposition = [2.0]\n"
                    "[[spring]]\nbody = \"a\"\nto = \"b\"\nstiffness = 200.0\n"
                    "rest_length = 1.0\n",
                    duration, restitution),
        "test");
}

// The reference of bodies that land with order 1 is told apart from chaos.
TEST(ReferenceByFineSteps, SaysThatLinkedBodiesLandWithOrderOne) {
    const Reference reference = make_reference(landing_pair(2, 0.5), effort());
    EXPECT_LT(reference.meaningful_until, 2);
    EXPECT_GT(reference.meaningful_until, std::sqrt(2 / 9.81) - 0.01);
    EXPECT_TRUE(holds(reference.why_no_longer, "linked bodies land with order 1"));
}

/// The exact motion of the pair with a restitution of 0.8: the middle falls, and the distance
/// oscillates at 20 rad/s. The lower body lands at roots that are bisected: twice in 0.6 s.
class LandingPair {
public:
    /// Must be called with increasing times. The positions of both bodies, m.
    std::array<Real, 2> at(Real t) {
        constexpr Real scan = 1e-5L;  // s
        while (from_ + scan < t) {
            if (lower(from_ + scan) >= 0) {
                next(from_ + scan);
                continue;
            }
            Real before = from_;
            Real after = from_ + scan;
            for (int i = 0; i < 80; ++i) {
                const Real middle = (before + after) / 2;
                (lower(middle) < 0 ? after : before) = middle;
            }
            next(before);
            const Real speed = middle_v_ - stretch_v_ / 2;
            middle_v_ -= 1.8L * speed / 2;
            stretch_v_ += 1.8L * speed;
        }
        return {lower(t), lower(t) + 1 + stretch(t)};
    }

private:
    static constexpr Real w = 20;  // √(200 N/m · 2 kg⁻¹)
    [[nodiscard]] Real middle(Real t) const {
        const Real tau = t - from_;
        return middle_ + middle_v_ * tau - 9.81 * tau * tau / 2;
    }
    [[nodiscard]] Real stretch(Real t) const {
        const Real turned = w * (t - from_);
        return stretch_ * std::cos(turned) + stretch_v_ / w * std::sin(turned);
    }
    [[nodiscard]] Real lower(Real t) const { return middle(t) - (1 + stretch(t)) / 2; }
    void next(Real t) {
        const Real tau = t - from_;
        const Real turned = w * tau;
        const Real stretched = stretch(t);
        middle_ = middle(t);
        middle_v_ -= 9.81 * tau;
        stretch_v_ = stretch_v_ * std::cos(turned) - stretch_ * w * std::sin(turned);
        stretch_ = stretched;
        from_ = t;
    }

    Real from_ = 0;
    Real middle_ = 1.5L;
    Real middle_v_ = 0;
    Real stretch_ = 0;
    Real stretch_v_ = 0;
};

// A reference is usable up to 100 × its own error.
TEST(ReferenceByFineSteps, OfLinkedBodiesThatLandIsRightForAShortTime) {
    const Reference reference = make_reference(landing_pair(0.6, 0.8), {.wanted = 1e-5});
    EXPECT_EQ(reference.meaningful_until, 0.6);
    EXPECT_LE(reference.floor().position, 2e-3);
    LandingPair truth;
    double most = 0;
    for (Real t = 0.0007L; t < 0.6L; t += 0.0053L) {
        const std::array<Real, 2> exact = truth.at(t);
        for (std::size_t row = 0; row < 2; ++row)
            most = std::max(most, std::abs(static_cast<double>(reference.motion->at(row, t).x[0] -
                                                               exact[row])));
    }
    EXPECT_LE(most, reference.floor().position / 10);
    EXPECT_GT(most, 0);
}

/// Two linked bodies on a floor, of which the left one starts with 3 m/s to the right.
Scene sliding_pair(double friction) {
    return parse_scene(
        fmt::format("[scene]\naxes = 2\nduration = 2.0\n[gravity]\nacceleration = [0.0, -9.81]\n"
                    "[[plane]]\nnormal = [0.0, 1.0]\nfriction = {}\n"
                    "[[body]]\nname = \"a\"\nvelocity = [3.0, 0.0]\ncontact = 0.0\n"
                    "[[body]]\nname = \"b\"\nposition = [1.0, 0.0]\ncontact = 0.0\n"
                    "[[spring]]\nbody = \"a\"\nto = \"b\"\nstiffness = 50.0\n"
                    "rest_length = 1.0\n",
                    friction),
        "test");
}

// The middle moves with 1.5 m/s, and the stretch is −0.3 m·sin(10 t/s).
TEST(ReferenceByFineSteps, OfLinkedBodiesThatSlideFreelyIsThatOfTheClosedForm) {
    const Reference reference = make_reference(sliding_pair(0), effort());
    ASSERT_EQ(reference.meaningful_until, 2);
    ASSERT_LE(reference.floor().position, 1e-7);
    for (Real t = 0.01L; t < 2; t += 0.0131L)
        EXPECT_NEAR(static_cast<double>(reference.motion->at(0, t).x[0]),
                    static_cast<double>(1.5L * t + 0.15L * std::sin(10 * t)),
                    reference.floor().position)
            << static_cast<double>(t);
}

/// A body of 1 kg that slides on a floor under a force, with friction that may stop and hold it.
struct Slider {
    double x;
    double v;
    void step(double force, double grip, double h) {
        const double before = v;
        v += force * h;
        if (std::abs(v) <= grip * h)
            v = 0;
        else
            v -= std::copysign(grip * h, v);
        x += (before + v) / 2 * h;
    }
};

// Beside steps of a microsecond, whose own error is of the order of 3 m/s·µs. A reference is usable
// up to 100 × its own error.
TEST(ReferenceByFineSteps, OfLinkedBodiesThatSlideWithFrictionIsRight) {
    const Reference reference = make_reference(sliding_pair(0.3), effort());
    EXPECT_TRUE(holds(reference.words, "velocity_verlet")) << "order 1: " << reference.words;
    ASSERT_EQ(reference.meaningful_until, 2);
    ASSERT_LE(reference.floor().position, 1e-2);
    const double h = 1e-6;
    Slider a{0, 3};
    Slider b{1, 0};
    double most = 0;
    for (int step = 1; step <= 2'000'000; ++step) {
        const double pull = 50 * (b.x - a.x - 1);
        a.step(pull, 0.3 * 9.81, h);
        b.step(-pull, 0.3 * 9.81, h);
        if (step % 7001 != 0) continue;
        const Real t = static_cast<Real>(step) / 1'000'000;
        most = std::max({most, std::abs(static_cast<double>(reference.motion->at(0, t).x[0]) - a.x),
                         std::abs(static_cast<double>(reference.motion->at(1, t).x[0]) - b.x)});
    }
    EXPECT_LE(most, reference.floor().position / 10 + 1e-5);
}

// A stiff link beside slow springs. Samples for a loose tolerance once were too few for it, and the
// motion was called chaotic after 0.04 s.
TEST(Reference, OfALooseToleranceIsMeaningfulToTheEnd) {
    const std::string text =
        "[scene]\naxes = 2\nrate = 60\nduration = 4.0\n"
        "[[body]]\nname = \"a\"\nposition = [-0.1457, -2.3678]\nvelocity = [2.4597, 0.2699]\n"
        "mass = 2.0592\n"
        "[[body]]\nname = \"b\"\nposition = [2.9957, 1.3848]\nvelocity = [2.2288, -0.7874]\n"
        "mass = 1.2368\nquadratic_drag = 1.8131\n"
        "[[spring]]\nbody = \"a\"\nanchor = [-1.2234, 1.3691]\nstiffness = 1.226\ndamping = "
        "0.3409\n"
        "[[spring]]\nbody = \"b\"\nanchor = [-1.0539, -2.1406]\nstiffness = 746.195\n"
        "[[spring]]\nbody = \"b\"\nto = \"a\"\nstiffness = 1504.664\nrest_length = 0.769\n";
    const Scene scene = parse_scene(text, "test.toml");
    const Reference fine = make_reference(scene, {.wanted = 1e-8});
    ASSERT_EQ(fine.meaningful_until, 4);
    for (const double wanted : {1e-2, 1e-3, 1e-4}) {
        const Reference reference = make_reference(scene, {.wanted = wanted});
        EXPECT_EQ(reference.meaningful_until, 4) << wanted << ": " << reference.why_no_longer;
        for (double t = 0; t <= 4; t += 0.01)
            for (const std::size_t row : {0, 1})
                EXPECT_LE(std::sqrt(static_cast<double>(squared_length(
                              reference.motion->at(row, t).x - fine.motion->at(row, t).x))),
                          wanted)
                    << wanted << " " << t;
    }
}

}  // namespace
}  // namespace oiler::test
