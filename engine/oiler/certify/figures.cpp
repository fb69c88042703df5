// SPDX-License-Identifier: MIT
#include "oiler/certify/figures.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "oiler/physics/closed_forms.hpp"
#include "oiler/picture/palette.hpp"
#include "oiler/plot/plot.hpp"
#include "oiler/sim/bodies.hpp"
#include "oiler/stability/stability.hpp"

namespace oiler::certify {
namespace {

constexpr double mass = 1;                // kg
constexpr double article_stiffness = 15;  // N/m
constexpr double article_damping = 0.1;   // N·s/m
constexpr double article_start = 1000;    // m

Motion<double> exact(double b, double t) {
    return damped_oscillator(mass, article_stiffness, b, {article_start, 0.0}, t);
}

/// The period, s.
double period(double b) {
    const double decay = b / (2 * mass);
    return 2 * std::numbers::pi / std::sqrt(article_stiffness / mass - decay * decay);
}

struct Sample {
    double t;       // s
    double x;       // m
    double error;   // m
    double energy;  // J
};

/// The spring with damping `b` (N·s/m) in steps of 1/rate s, from its start on.
struct Run {
    const Method& method;
    double b;
    Rate rate;
    std::vector<Sample> samples{};

    double duration() const { return samples.back().t; }
    double energy_left() const { return samples.back().energy / samples.front().energy; }
    const Sample& worst() const {
        return *std::ranges::max_element(samples, {},
                                         [](const Sample& s) { return std::abs(s.error); });
    }
    /// The spring per unit mass, in units of time of `unit` s.
    Oscillation spring(double unit) const {
        return {.k = article_stiffness / mass * unit * unit, .c = b / mass * unit};
    }
    /// The matrix of a step, which rotates the motion and scales it by √determinant.
    StepMatrix step() const {
        const Oscillation per_step = spring(rate.dt());
        return step_matrices(method, method.damping, {&per_step, 1}).front();
    }
    /// The largest stable step, s.
    double stable_step() const { return stability_limit(method, method.damping, spring(1)); }
};
using Runs = std::vector<Run>;

Run simulate(std::string_view method, double b, Rate rate, double until) {
    Run run{find_method(method), b, rate};
    Bodies bodies(1, Precision::double_);
    bodies.add({.mass = mass, .position = {article_start}},
               Spring{.stiffness = article_stiffness, .damping = b});
    for (std::int64_t tick = 0;; ++tick) {
        const double t = rate.time(tick);
        const double x = bodies.position(0)[0];
        run.samples.push_back({t, x, x - exact(b, t).x, bodies.energy().total()});
        if (t >= until) return run;
        bodies.step(run.method, {rate, tick, 1});
    }
}

/// The number of cycles by which the run is ahead of the exact motion.
double cycles_gained(const Run& run) {
    const StepMatrix step = run.step();
    const auto angle = std::acos(step.trace() / 2 / std::sqrt(step.determinant()));
    return static_cast<double>(angle) / (2 * std::numbers::pi) * run.duration() / run.rate.dt() -
           run.duration() / period(run.b);
}

/// ω·dt, the h of theory.
double radians_a_step(const Run& run) {
    return std::sqrt(article_stiffness / mass) * run.rate.dt();
}

/// The mean relative excess of semi-implicit Euler's energy without damping: the mean over the
/// ellipse v² + ω²·x² − ω²·dt·x·v on which its steps stay.
double energy_excess(double h) { return 1 / (1 - h * h / 4) - 1; }

/// The style of a method in every figure. Width and marks differ too, for colour-blind readers.
struct Style {
    std::string_view method;
    const char* name;
    Colour colour;
    float width;
    Mark mark;
};

constexpr Colour pale_blue{155, 211, 242};  // a paler sky blue, for large areas
constexpr std::array styles{
    Style{"explicit_euler", "explicit Euler", palette::purple, 2.5F, Mark::none},
    Style{"semi_implicit_euler", "semi-implicit Euler", palette::vermilion, 2.5F, Mark::disc},
    Style{"rk4", "RK4", palette::green, 1, Mark::ring}};

/// A section of the exact motion, and runs over it.
struct Graph {
    const char* name;
    const char* title;
    double b;  // N·s/m
    Rate rate;
    std::vector<std::string_view> methods;
    double from;   // s
    double to;     // s
    double reach;  // m, above and below 0
    std::string (*caption)(const Runs& runs);
};

/// Whether cycles are so dense that thick lines would merge.
bool is_crowded(const Graph& graph) { return graph.to - graph.from > 20 * period(graph.b); }

Series exact_series(const Graph& graph) {
    const bool crowded = is_crowded(graph);
    const Colour colour = crowded ? pale_blue : palette::sky_blue;
    Series series{.name = "exact", .colour = colour, .width = crowded ? 2.0F : 5.0F};
    constexpr int points = 3000;
    for (int i = 0; i <= points; ++i) {
        const double t = graph.from + (graph.to - graph.from) * i / points;
        series.points.push_back({t, exact(graph.b, t).x});
    }
    return series;
}

Series series_of(const Run& run, const Graph& graph) {
    const auto& [method, name, colour, width, mark] =
        *std::ranges::find(styles, run.method.name, &Style::method);
    const double dt = run.rate.dt();
    Series series{.name = name, .colour = colour, .width = is_crowded(graph) ? 1.25F : width};
    if (graph.to - graph.from <= 50 * dt) series.mark = mark;
    for (const Sample& s : run.samples)
        if (s.t > graph.from - dt && s.t < graph.to + dt) series.points.push_back({s.t, s.x});
    return series;
}

std::string conditions(const Graph& graph) {
    std::string text = fmt::format("k = {:g} N/m, b = {:g} N·s/m", article_stiffness, graph.b);
    if (!graph.methods.empty()) text += fmt::format(", dt = {:g} s", graph.rate.dt());
    return text;
}

Figure draw(const Graph& graph) {
    Runs runs;
    for (const std::string_view method : graph.methods)
        runs.push_back(simulate(method, graph.b, graph.rate, graph.to));
    Plot plot{.box = {{60, 72}, {624, 312}},
              .title = graph.title,
              .remark = conditions(graph),
              .caption = graph.caption(runs),
              .x_label = "time, s",
              .y_label = "position, m",
              .x = {graph.from, graph.to},
              .y = {-graph.reach, graph.reach},
              .series = {exact_series(graph)},
              .x_ticks = 10,
              .y_ticks = 5};
    for (const Run& run : runs) plot.series.push_back(series_of(run, graph));
    Figure figure{graph.name, {}};
    plot.draw(figure.picture, {});
    return figure;
}

std::string exact_damped(const Runs&) {
    return fmt::format(
        "A mass of {:g} kg, released at {:g} m, oscillates with a period of {:.3f} s. Every {:g} s "
        "its amplitude falls to {:.1f} %.",
        mass, article_start, period(article_damping), 2 * mass / article_damping,
        100 * std::exp(-1.0));
}

std::string explicit_euler(const Runs& runs) {
    const double area = static_cast<double>(runs[0].step().determinant());
    const double growth = std::log(area) / 2 / runs[0].rate.dt();  // 1/s
    return fmt::format(
        "Damping should bring the mass to rest. Instead its amplitude doubles every {:.1f} s and "
        "is {:.2f} times as large after {:g} s: on this spring explicit Euler is unstable for "
        "every dt above b/k = 1/{:.0f} s.",
        std::numbers::ln2 / growth, std::exp(growth * runs[0].duration()), runs[0].duration(),
        1 / runs[0].stable_step());
}

std::string semi_implicit_euler(const Runs& runs) {
    const Sample& worst = runs[0].worst();
    return fmt::format(
        "The largest error is {:.1f} m, at t = {:.2f} s. On this spring semi-implicit Euler is "
        "stable for every dt below {:.2f} s. Being symplectic explains this only without damping.",
        std::abs(worst.error), worst.t, runs[0].stable_step());
}

std::string rk4_and_semi_implicit_euler(const Runs& runs) {
    return fmt::format(
        "At this scale all three curves coincide. The largest error is {:.1f} m for semi-implicit "
        "Euler and {:.4f} m for RK4.",
        std::abs(runs[0].worst().error), std::abs(runs[1].worst().error));
}

std::string zoomed_in(const Runs& runs) {
    const Sample& worst = runs[0].worst();
    return fmt::format(
        "At t = {:.2f} s semi-implicit Euler has its largest error: it is {:.1f} m or {:.1f} ms "
        "ahead of the exact motion. The largest error of RK4 is {:.4f} m, with {} force "
        "evaluations per step instead of {}.",
        worst.t, std::abs(worst.error), 1000 * worst.error / exact(article_damping, worst.t).v,
        std::abs(runs[1].worst().error), runs[1].method.evaluations, runs[0].method.evaluations);
}

std::string exact_undamped(const Runs&) {
    return fmt::format(
        "The mass oscillates forever with an amplitude of {:g} m and a period of {:.3f} s. Its "
        "energy stays k·x²/2 = {:.1f} MJ.",
        article_start, period(0), article_stiffness * article_start * article_start / 2 / 1e6);
}

std::string after_90_s(const Runs& runs) {
    return fmt::format(
        "After {:g} s semi-implicit Euler has gained {:.0f}° on the exact motion; its energy is "
        "{:.1f} % too large on average. RK4 has lost {:.1f} % of its energy, and lags by {:.1f}°.",
        runs[0].duration(), 360 * cycles_gained(runs[0]),
        100 * energy_excess(radians_a_step(runs[0])), 100 * (1 - runs[1].energy_left()),
        -360 * cycles_gained(runs[1]));
}

std::string rk4_loses_energy(const Runs& runs) {
    return fmt::format(
        "After {:g} s RK4 has lost {:.1f} % of its energy. It does not keep the right frequency "
        "either: by then it lags by {:.0f}°. Straight lines join the steps.",
        runs[0].duration(), 100 * (1 - runs[0].energy_left()), -360 * cycles_gained(runs[0]));
}

std::string semi_implicit_euler_keeps_energy(const Runs& runs) {
    const auto [least, most] = std::ranges::minmax(runs[0].samples, {}, &Sample::energy);
    const double percent = 100 / runs[0].samples[0].energy;
    const double h = radians_a_step(runs[0]);
    return fmt::format(
        "The energy oscillates between {:.0f} % and {:.0f} % of the true one, without drift. Its "
        "mean is {:.1f} % too large, by the factor 1/(1 − h²/4) with h = dt·√(k/m) = {:.3f}. "
        "Straight lines join the steps.",
        percent * least.energy, percent * most.energy, 100 * energy_excess(h), h);
}

std::string out_of_phase(const Runs& runs) {
    return fmt::format(
        "After {:g} s semi-implicit Euler has gained {:.2f} cycles on the exact motion. RK4 lags "
        "by {:.0f}°, and has {:.0f} % of its amplitude left.",
        runs[0].duration(), cycles_gained(runs[0]), -360 * cycles_gained(runs[1]),
        100 * std::sqrt(runs[1].energy_left()));
}

}  // namespace

std::vector<Figure> article_figures() {
    const std::vector<std::string_view> none, oldest{"explicit_euler"}, rk4{"rk4"},
        euler{"semi_implicit_euler"}, both{"semi_implicit_euler", "rk4"};
    constexpr Rate fine{100}, coarse{10}, coarser{4};
    std::vector<Figure> figures;
    for (const Graph& graph : {
             Graph{"01_exact_damped", "Spring and damper: the exact motion", article_damping, fine,
                   none, 0, 20, 1250, exact_damped},
             Graph{"02_explicit_euler", "Explicit Euler gains energy", article_damping, fine,
                   oldest, 0, 90, 12'500, explicit_euler},
             Graph{"03_semi_implicit_euler", "Semi-implicit Euler is stable", article_damping, fine,
                   euler, 0, 10, 1250, semi_implicit_euler},
             Graph{"04_rk4_and_semi_implicit_euler", "RK4 and semi-implicit Euler", article_damping,
                   fine, both, 0, 10, 1250, rk4_and_semi_implicit_euler},
             Graph{"05_zoomed_in", "RK4 and semi-implicit Euler, zoomed in", article_damping, fine,
                   both, 3.6, 3.7, 250, zoomed_in},
             Graph{"06_exact_undamped", "Without damping: the exact motion", 0, coarse, none, 0, 20,
                   1250, exact_undamped},
             Graph{"07_undamped_after_90_s", "Without damping, near 90 s", 0, coarse, both, 86, 90,
                   1250, after_90_s},
             Graph{"08_rk4_loses_energy", "RK4 loses energy", 0, coarser, rk4, 0, 90, 1250,
                   rk4_loses_energy},
             Graph{"09_semi_implicit_euler_keeps_energy",
                   "Semi-implicit Euler keeps its energy, on average", 0, coarser, euler, 0, 90,
                   1250, semi_implicit_euler_keeps_energy},
             Graph{"10_semi_implicit_euler_out_of_phase", "Semi-implicit Euler drifts out of phase",
                   0, coarser, both, 84, 90, 1250, out_of_phase},
         })
        figures.push_back(draw(graph));
    return figures;
}

}  // namespace oiler::certify
