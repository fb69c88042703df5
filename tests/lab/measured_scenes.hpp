// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "oiler/lab/advice/advise.hpp"
#include "oiler/lab/reference/reference.hpp"
#include "oiler/lab/sweep/tradeoff.hpp"
#include "oiler/scene/read.hpp"
#include "oiler/sim/bodies.hpp"

namespace oiler::test {

using namespace lab;

inline const std::string one_axis = "[scene]\naxes = 1\nrate = 100\n";

/// A body at `x` m on a spring to the origin. Keys of the spring may follow, such as its damping.
inline std::string on_spring(double x, double stiffness, const std::string& name = "mass") {
    return fmt::format(
        "[[body]]\nname = \"{0}\"\nposition = [{1}]\n[[spring]]\nbody = \"{0}\"\n"
        "anchor = [0.0]\nstiffness = {2}\n",
        name, x, stiffness);
}

/// The article's spring over 10 s, without and with its damper.
inline const std::string undamped_spring = one_axis + "duration = 10.0\n" + on_spring(1000, 15);
inline const std::string article_spring = undamped_spring + "damping = 0.1\n";

inline std::vector<const Method*> methods_of(const std::vector<const char*>& names) {
    std::vector<const Method*> all;
    for (const char* name : names) all.push_back(&find_method(name));
    return all;
}

/// A scene and its reference.
struct MeasuredScene {
    explicit MeasuredScene(const std::string& scene_text, const ReferenceEffort& effort = {})
        : text(scene_text),
          scene(parse_scene(text, "test.toml")),
          reference(make_reference(scene, effort)) {}

    std::string text;
    Scene scene;
    Reference reference;
};

/// The article's spring, measured once.
inline const MeasuredScene& spring() {
    static const MeasuredScene measured(article_spring);
    return measured;
}

/// A clock by which a step takes the given time, ns, however many steps a frame or a call has.
inline lab::SweepWatch made_up_clock(std::function<double(const Stepping&)> ns_per_step) {
    lab::SweepWatch watch;
    watch.ns_of_frames = [ns_per_step](const Scene&, const Settings& settings, const auto&) {
        const auto rate = static_cast<double>(settings.stepping.rate.steps);
        return std::vector{ns_per_step(settings.stepping) * rate / std::min(rate, 60.0)};
    };
    watch.ns_per_step = [ns_per_step](const auto&, const Stepping& choice, std::int64_t) {
        return ns_per_step(choice);
    };
    watch.ns_per_step_together = [ns = std::move(ns_per_step)](const Scene&, const Stepping& choice,
                                                               const auto&) { return ns(choice); };
    return watch;
}

/// A clock by which a step takes 1 ns for each of its force evaluations, and 10 ns for a step that
/// has no fixed number of them.
inline lab::SweepWatch clock_by_evaluations() {
    return made_up_clock([](const Stepping& choice) {
        return choice.method->evaluations > 0 ? 1.0 * choice.method->evaluations : 10.0;
    });
}

inline std::vector<const Method*> all_methods() {
    std::vector<const Method*> all;
    for (const Method& method : methods()) all.push_back(&method);
    return all;
}

inline std::vector<const Method*> splittings() {
    std::vector<const Method*> all;
    for (const Method& method : methods())
        if (std::holds_alternative<Splitting>(method.rule)) all.push_back(&method);
    return all;
}

/// The scene, with a reference accurate enough for the requirements.
inline MeasuredScene measured_for(const std::string& text, const Requirements& requirements) {
    return MeasuredScene(text, {.wanted = required_reference_error(requirements) / 2});
}

/// The exact position of a body at time t.
using ExactPosition = std::function<Vec<Real, 3>(std::size_t row, Real t)>;

/// The largest distance from the truth at any step of the scene and, with points, at so many times
/// on the straight line of each step.
inline double true_error(const Scene& scene, const Stepping& choice, const ExactPosition& truth,
                         int points = 1) {
    World world = make_world(scene, Settings{choice});
    const Bodies& bodies = world.bodies();
    const auto rate = static_cast<Real>(choice.rate.steps);
    const Real end = scene.duration;
    Real most = 0;
    for (std::int64_t tick = 0; static_cast<Real>(tick) / rate < end; ++tick) {
        std::vector<Vec<Real, 3>> before;
        for (std::size_t row = 0; row < bodies.size(); ++row) before.push_back(bodies.state(row).x);
        world.step();
        for (int point = 1; point <= points; ++point) {
            const Real share = static_cast<Real>(point) / points;
            const Real t = (static_cast<Real>(tick) + share) / rate;
            if (t > end) break;
            for (std::size_t row = 0; row < before.size(); ++row) {
                const Vec<Real, 3> line = before[row] + (bodies.state(row).x - before[row]) * share;
                most = std::max(most, squared_length(line - truth(row, t)));
            }
        }
    }
    return static_cast<double>(std::sqrt(most));
}

/// A scene with its advice, if not otherwise by a clock that counts evaluations.
struct Advised : MeasuredScene {
    Advised(const std::string& scene_text, const Requirements& its,
            const SweepWatch& watch = clock_by_evaluations())
        : MeasuredScene(measured_for(scene_text, its)),
          requirements(its),
          advice(advise(scene, reference, its, watch)) {}
    [[nodiscard]] std::vector<std::string> words() const {
        return describe(advice, scene, reference, requirements);
    }

    Requirements requirements;
    Advice advice;
};
inline Advice advice_on(const std::string& text, const Requirements& requirements) {
    return Advised(text, requirements).advice;
}

}  // namespace oiler::test
