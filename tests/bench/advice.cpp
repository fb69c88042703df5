// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "oiler/core/error.hpp"
#include "oiler/lab/advice/advise.hpp"
#include "oiler/scene/read.hpp"
#include "oiler/sim/bodies.hpp"
#include "support/dice.hpp"

// Checks advice. For each scene and tolerance, the advice is run again and compared with a motion
// that is computed without the engine. Its cost and search time are compared with a full sweep.
// --full takes more scenes, --cloth a net without a sweep, --cloth-sweep 1 s of it. --costs
// compares the costs that are told with whole runs, of the scenes of the repository and of random
// ones. Exits with 1 if an advice misses its tolerance, or if a cost is wrong by more than a factor
// of 1.5.

using namespace oiler;
using namespace oiler::lab;

namespace {

using Real = long double;
using Point2 = std::array<Real, 2>;
/// The exact position of a body at time t, s.
using Truth = std::function<Point2(std::size_t row, Real t)>;

struct Case {
    const char* name;
    Scene scene;
    Truth truth;
    std::int64_t truth_per_second = 0;  ///< times at which the truth is known, 0 for any time
    double most_work = 1e9;             ///< see SweepPlan
    std::int64_t max_rate = 7680;
};

// Exact motions, from textbooks.

Truth spring_truth(Real damping) {
    return [damping](std::size_t, Real t) -> Point2 {
        const Real gamma = damping / 2;
        const Real omega = std::sqrt(15 - gamma * gamma);
        return {1000 * std::exp(-gamma * t) *
                    (std::cos(omega * t) + gamma / omega * std::sin(omega * t)),
                0};
    };
}

/// An orbit of semi-axis 1 m and eccentricity 0.6 around gm = 1, from the perihelion.
Point2 orbit_truth(std::size_t, Real t) {
    constexpr Real e = 0.6L;
    Real turned = t;
    for (int i = 0; i < 200; ++i)
        turned -= (turned - e * std::sin(turned) - t) / (1 - e * std::cos(turned));
    return {std::cos(turned) - e, std::sqrt(1 - e * e) * std::sin(turned)};
}

/// Two unit masses that rest at −2 m and 2 m on springs of 15, 1.5 and 15 N/m: both modes.
Point2 chain_truth(std::size_t row, Real t) {
    const Real together = std::sqrt(Real(15)) * t;
    const Real apart = std::sqrt(Real(18)) * t;
    const Real sum = (std::cos(together) + std::cos(apart)) / 2;
    const Real difference = (std::cos(together) - std::cos(apart)) / 2;
    return {row == 0 ? sum - 2 : difference + 2, 0};
}

/// RK4 over plain numbers, in steps of 1/rate s; calls `record` at each.
template <class Change>
void integrate(std::vector<Real>& y, Change change, std::int64_t steps, Real h,
               const std::function<void(std::int64_t)>& record) {
    const std::size_t n = y.size();
    std::vector<Real> k(n);
    std::vector<Real> at(n);
    std::vector<Real> sum(n);
    record(0);
    for (std::int64_t step = 1; step <= steps; ++step) {
        at = y;
        std::fill(sum.begin(), sum.end(), 0);
        for (const auto& [weight, reach] :
             {std::pair<Real, Real>{1, 0.5L}, {2, 0.5L}, {2, 1}, {1, 0}}) {
            change(at, k);
            for (std::size_t i = 0; i < n; ++i) {
                sum[i] += weight * k[i];
                at[i] = y[i] + reach * h * k[i];
            }
        }
        for (std::size_t i = 0; i < n; ++i) y[i] += h / 6 * sum[i];
        record(step);
    }
}

constexpr Real drag = 0.00816666666666666667L;

/// A motion from points recorded every 1/rate s, extrapolated from two runs, the second at half the
/// step.
template <class Change>
Truth recorded(std::vector<Real> start, Change change, Real duration, std::int64_t per_second,
               std::int64_t steps_between) {
    std::vector<std::vector<Real>> runs[2];
    for (int run = 0; run < 2; ++run) {
        const std::int64_t between = steps_between << run;
        std::vector<Real> y = start;
        const auto steps = static_cast<std::int64_t>(
            std::ceil(duration * static_cast<Real>(per_second * between)));
        integrate(y, change, steps, 1 / static_cast<Real>(per_second * between),
                  [&](std::int64_t step) {
                      if (step % between == 0) runs[run].push_back(y);
                  });
    }
    return [fine = std::move(runs[1]), coarse = std::move(runs[0]), per_second](std::size_t row,
                                                                                Real t) {
        const auto at = static_cast<std::size_t>(std::llround(t * static_cast<Real>(per_second)));
        Point2 point{};
        for (std::size_t axis = 0; axis < 2; ++axis) {
            const Real better = fine[at][4 * row + axis];
            point[axis] = better + (better - coarse[at][4 * row + axis]) / 15;
        }
        return point;
    };
}

Truth projectile_truth(const Scene& scene) {
    const SceneBody& body = scene.bodies[0];
    return recorded(
        {0, 0, body.velocity[0], body.velocity[1]},
        [](const std::vector<Real>& y, std::vector<Real>& k) {
            const Real speed = std::sqrt(y[2] * y[2] + y[3] * y[3]);
            k = {y[2], y[3], -drag * speed * y[2], -9.8 - drag * speed * y[3]};
        },
        scene.duration, 3600, 2);
}

/// The springs of the net of assets/scenes/cloth.toml.
Truth cloth_truth(const Scene& scene) {
    struct Spring {
        std::size_t a, b;
        Real length;
    };
    const SceneGrid grid = scene.grids[0];
    const auto columns = static_cast<std::size_t>(grid.count[0]);
    const auto rows = static_cast<std::size_t>(grid.count[1]);
    std::vector<Real> start;
    std::vector<Spring> springs;
    for (std::size_t r = 0; r < rows; ++r)
        for (std::size_t c = 0; c < columns; ++c) {
            const std::size_t node = r * columns + c;
            for (const double number :
                 {grid.origin[0] + static_cast<double>(c) * grid.spacing,
                  grid.origin[1] + static_cast<double>(r) * grid.spacing, 0.0, 0.0})
                start.push_back(number);
            const Real diagonal = std::sqrt(Real(2)) * grid.spacing;
            if (c + 1 < columns) springs.push_back({node, node + 1, grid.spacing});
            if (r + 1 == rows) continue;
            springs.push_back({node, node + columns, grid.spacing});
            if (c + 1 < columns) springs.push_back({node, node + columns + 1, diagonal});
            if (c > 0) springs.push_back({node, node + columns - 1, diagonal});
        }
    const std::array<std::size_t, 2> hung{(rows - 1) * columns, rows * columns - 1};
    const auto change = [=](const std::vector<Real>& y, std::vector<Real>& k) {
        const Real m = grid.matter.mass;
        for (std::size_t i = 0; i < y.size(); i += 4) {
            k[i] = y[i + 2];
            k[i + 1] = y[i + 3];
            k[i + 2] = -grid.matter.linear_drag / m * y[i + 2];
            k[i + 3] = -9.81 - grid.matter.linear_drag / m * y[i + 3];
        }
        for (const auto& [a, b, length] : springs) {
            const Real dx = y[4 * a] - y[4 * b];
            const Real dy = y[4 * a + 1] - y[4 * b + 1];
            const Real distance = std::sqrt(dx * dx + dy * dy);
            const Real along =
                (dx * (y[4 * a + 2] - y[4 * b + 2]) + dy * (y[4 * a + 3] - y[4 * b + 3])) /
                distance;
            const Real pull =
                (-grid.stiffness * (distance - length) - grid.damping * along) / m / distance;
            k[4 * a + 2] += pull * dx;
            k[4 * a + 3] += pull * dy;
            k[4 * b + 2] -= pull * dx;
            k[4 * b + 3] -= pull * dy;
        }
        for (const std::size_t node : hung)
            for (std::size_t axis = 0; axis < 2; ++axis)
                k[4 * node + 2 + axis] +=
                    (-grid.stiffness * (y[4 * node + axis] - start[4 * node + axis]) -
                     grid.damping * y[4 * node + 2 + axis]) /
                    m;
    };
    return recorded(start, change, scene.duration, 480, 12);
}

Scene asset(const char* name) {
    return read_scene(fmt::format("{}/assets/scenes/{}.toml", OILER_SOURCE, name));
}

std::vector<Case> cases(bool full) {
    const Scene projectile = parse_scene(
        "[scene]\naxes = 2\nrate = 60\nduration = 8.0\n[gravity]\nacceleration = [0.0, -9.8]\n"
        "[[body]]\nquadratic_drag = 0.00816666666666666667\n"
        "velocity = [19.28362829059618, 22.98133329356934]\n",
        "projectile");
    std::vector<Case> all{{"projectile", projectile, projectile_truth(projectile), 3600},
                          {"orbit", asset("orbit"), orbit_truth}};
    if (!full) {
        // The highest rates take too long for a test.
        for (Case& one : all) one.max_rate = 1000;
        return all;
    }
    Scene undamped = asset("article_spring_undamped");
    undamped.duration = 90;
    all.push_back({"spring", asset("article_spring"), spring_truth(0.1L)});
    all.push_back({"undamped 90 s", undamped, spring_truth(0)});
    all.push_back({"chain", asset("chain"), chain_truth});
    return all;
}

/// The distance of a point from the truth, m.
double distance(const Case& one, std::size_t row, const Point2& point, Real t) {
    const Point2 exact = one.truth(row, t);
    return static_cast<double>(std::hypot(point[0] - exact[0], point[1] - exact[1]));
}

/// Calls `check` with the times of a step, as parts of it: where the truth is known, else 17.
template <class Check>
void for_times(const Case& one, Real from, Real to, Check check) {
    constexpr int parts = 16;
    if (one.truth_per_second == 0) {
        for (int part = 0; part <= parts; ++part) check(static_cast<Real>(part) / parts);
        return;
    }
    const auto per_second = static_cast<Real>(one.truth_per_second);
    for (Real at = std::ceil(from * per_second); at <= to * per_second; ++at)
        check((at / per_second - from) / (to - from));
}

/// The largest distance of the drawn lines from the truth, m.
double independent_error(const Case& one, const Stepping& choice) {
    World world = make_world(one.scene, Settings{choice});
    const auto rate = static_cast<Real>(choice.rate.steps);
    const auto point_of = [&](std::size_t row) -> Point2 {
        const auto x = world.bodies().state(row).x;
        return {x[0], x[1]};
    };
    std::vector<Point2> before(world.bodies().size());
    double most = 0;
    while (world.time() < one.scene.duration) {
        const Real from = static_cast<Real>(world.tick()) / rate;
        for (std::size_t row = 0; row < before.size(); ++row) before[row] = point_of(row);
        world.step();
        const Real to = static_cast<Real>(world.tick()) / rate;
        for (std::size_t row = 0; row < before.size(); ++row) {
            const Point2 after = point_of(row);
            for_times(one, from, to, [&](Real part) {
                const Real t = from + part * (to - from);
                if (t > one.scene.duration) return;
                const Point2 drawn{before[row][0] + (after[0] - before[row][0]) * part,
                                   before[row][1] + (after[1] - before[row][1]) * part};
                most = std::max(most, distance(one, row, drawn, t));
            });
        }
    }
    return most;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct Sweep {
    Tradeoff tradeoff;
    double seconds = 0;
};

Sweep sweep_all(const Scene& scene, const Requirements& requirements) {
    const auto start = std::chrono::steady_clock::now();
    const Reference reference = make_reference(scene, {});
    const SweepPlan plan{.methods = requirements.methods,
                         .max_rate = requirements.max_rate,
                         .most_work = requirements.most_work};
    Sweep sweep_of{start_tradeoff(scene, reference, plan), 0};
    SweepWatch watch;
    watch.progress = [shown = -1](double share) mutable {
        const int percent = static_cast<int>(100 * share);
        if (std::exchange(shown, percent) != percent) fmt::print(stderr, "\r{:3} %", percent);
    };
    sweep(sweep_of.tradeoff, scene, reference, plan, watch);
    std::vector<TradeoffRow*> rows;
    for (RateSeries& series : sweep_of.tradeoff.all_series)
        for (TradeoffRow& row : series.rows) rows.push_back(&row);
    time_rows(scene, rows, 7, watch);
    fmt::print(stderr, "\r");
    sweep_of.seconds = seconds_since(start);
    return sweep_of;
}

/// The cost of the advice over that of the sweep's best row, timed side by side.
double cost_ratio(const Scene& scene, const Tradeoff& tradeoff, const Requirements& requirements,
                  const TradeoffRow& advised) {
    const TradeoffRow* best = nullptr;
    for (const TradeoffRow* row : tradeoff.rows())
        if (meets(row->judgement, requirements) &&
            row->stepping.rate.steps >= requirements.min_rate &&
            (!best || row->ns_per_second < best->ns_per_second))
            best = row;
    if (!best) return unknown;
    TradeoffRow a = advised;
    TradeoffRow b = *best;
    time_rows(scene, {&a, &b}, 31, {});
    return a.ns_per_second / b.ns_per_second;
}

/// The cost and the search time of the advice beside the sweep's.
std::string beside(const Case& one, const Sweep& swept, const Requirements& requirements,
                   const TradeoffRow& best, double seconds) {
    return fmt::format("cost of the sweep's best × {:.2f}  {:.3f} of its time",
                       cost_ratio(one.scene, swept.tradeoff, requirements, best),
                       seconds / swept.seconds);
}

bool run(const Case& one, const std::vector<double>& tolerances, bool sweeps) {
    Requirements requirements;
    for (const Method& method : methods()) requirements.methods.push_back(&method);
    requirements.most_work = one.most_work;
    requirements.max_rate = one.max_rate;
    Sweep swept;
    if (sweeps) swept = sweep_all(one.scene, requirements);
    fmt::print("{}{}\n", one.name,
               sweeps ? fmt::format(": a sweep of {} rows takes {:.1f} s",
                                    swept.tradeoff.rows().size(), swept.seconds)
                      : "");
    bool all_meet = true;
    for (const double tolerance : tolerances) {
        requirements.position_error = tolerance;
        const auto start = std::chrono::steady_clock::now();
        const Reference reference =
            make_reference(one.scene, {.wanted = required_reference_error(requirements) / 2});
        const Advice advice = advise(one.scene, reference, requirements, {});
        const double seconds = seconds_since(start);
        if (!advice.best || !advice.meets) {
            fmt::print("  {:<7g} no advice\n", tolerance);
            all_meet = false;
            continue;
        }
        const double error = independent_error(one, advice.best->stepping);
        const bool met = error <= tolerance;
        all_meet = all_meet && met;
        fmt::print("  {:<7g} {:<42} independent error {:<9.3g} {}  {}\n", tolerance,
                   describe(advice.best->stepping), error, met ? "met" : "MISSED",
                   sweeps ? beside(one, swept, requirements, *advice.best, seconds)
                          : fmt::format("{:.1f} s", seconds));
        std::fflush(stdout);
    }
    return all_meet;
}

/// Balls that fall, bounce, slide and come to rest between a floor and a wall.
Scene random_balls(std::uint64_t seed) {
    test::Dice dice(seed);
    constexpr const char* names[]{"velocity_verlet", "semi_implicit_euler", "rk4", "exact"};
    return parse_scene(
        fmt::format(
            "[scene]\naxes = 2\nrate = {}\nmethod = \"{}\"\nduration = {:.3g}\n[gravity]\n"
            "acceleration = [0.0, -9.81]\n[[plane]]\nnormal = [0.0, 1.0]\nrestitution = {:.2g}\n"
            "friction = {:.2g}\n[[plane]]\nnormal = [1.0, 0.0]\noffset = -6.0\nrestitution = 0.5\n"
            "[[scatter]]\ncount = {}\nseed = {}\nposition_from = [-3.0, 1.0]\n"
            "position_to = [3.0, 4.0]\nvelocity_from = [-2.0, -2.0]\nvelocity_to = [2.0, 2.0]\n"
            "linear_drag = {:.2g}\ncontact = 0.1\n",
            dice.whole(30, 300), names[dice.whole(0, 3)], dice.uniform(2, 12), dice.uniform(0, 1),
            dice.chance(0.5) ? 0.0 : dice.uniform(0, 1), static_cast<int>(dice.log_uniform(1, 500)),
            seed, dice.chance(0.5) ? 0.0 : dice.log_uniform(0.01, 1)),
        "balls");
}

struct WholeRun {
    double played = 0;    ///< ns per simulated second, one step per call
    double together = 0;  ///< at many steps per call
};

/// The time that the processor takes for a piece of work, s, so that other programs do not matter.
template <class Work>
double cpu_seconds(Work work) {
    constexpr double least = 0.02;
    const auto seconds = [](std::clock_t ticks) {
        return static_cast<double>(ticks) / static_cast<double>(CLOCKS_PER_SEC);
    };
    const std::clock_t begin = std::clock();
    int times = 0;
    do {
        work();
        ++times;
    } while (seconds(std::clock() - begin) < least);
    return seconds(std::clock() - begin) / times;
}

/// The cost of all steps of a scene. Between frames, the fastest cache loses its content.
WholeRun run_whole(const Scene& scene) {
    const std::int64_t rate = scene.stepping.rate.steps;
    const auto steps = static_cast<std::int64_t>(scene.duration * static_cast<double>(rate));
    const std::int64_t per_frame = std::max<std::int64_t>(1, rate / 60);
    std::vector<unsigned char> memory(64 * 1024);
    const World start = make_world(scene, Settings{scene.stepping});
    const auto play = [&](bool takes_steps) {
        World world = start;
        for (std::int64_t tick = 0; tick < steps; tick += per_frame) {
            for (std::size_t i = 0; i < memory.size(); i += 64)
                memory[i] = static_cast<unsigned char>(memory[i] + 1);
            asm volatile("" : : "g"(memory.data()) : "memory");
            if (!takes_steps) continue;
            for (std::int64_t i = 0; i < per_frame; ++i) world.step();
        }
    };
    const double played = cpu_seconds([&] { play(true); }) - cpu_seconds([&] { play(false); });
    const auto call = [&](std::int64_t count) {
        World world = start;
        world.step(count);
    };
    // A copy takes as long as some steps.
    const double together = cpu_seconds([&] { call(steps); }) - cpu_seconds([&] { call(1); });
    return {1e9 * played / scene.duration, 1e9 * together / scene.duration};
}

/// Whether the told costs of a scene's own setting are those of the whole run.
bool compare_costs(const std::string& name, const Scene& scene) {
    constexpr double most = 1.5;
    TradeoffRow row{.stepping = scene.stepping};
    time_rows(scene, {&row}, 5, {});
    const WholeRun whole = run_whole(scene);
    const double played = row.ns_per_second / whole.played;
    const double together = row.ns_together / whole.together;
    const bool right = std::max({played, 1 / played, together, 1 / together}) <= most;
    fmt::print(
        "{:<26} {:<42} played {:>9.3g} µs/s, told × {:<6.2f} in calls {:>9.3g}, told × {:<6.2f} "
        "{}\n",
        name, describe(scene.stepping), whole.played / 1e3, played, whole.together / 1e3, together,
        right ? "" : "WRONG");
    std::fflush(stdout);
    return right;
}

bool compare_all_costs() {
    constexpr std::int64_t most_bodies = 100'000;
    bool right = true;
    for (const auto& entry :
         std::filesystem::directory_iterator(fmt::format("{}/assets/scenes", OILER_SOURCE))) {
        if (entry.path().extension() != ".toml") continue;
        const Scene scene = read_scene(entry.path().string());
        if (scene.body_count() > most_bodies) continue;
        right = compare_costs(entry.path().stem().string(), scene) && right;
    }
    for (std::uint64_t seed = 1; seed <= 30; ++seed)
        right = compare_costs(fmt::format("balls {}", seed), random_balls(seed)) && right;
    return right;
}

}  // namespace

int main(int argc, char** argv) try {
    const std::string_view mode = argc > 1 ? argv[1] : "";
    if (mode == "--costs") return compare_all_costs() ? 0 : 1;
    const bool cloth = mode == "--cloth" || mode == "--cloth-sweep";
    std::vector<Case> chosen;
    if (cloth) {
        // A sweep over all 8 s takes hours.
        Scene scene = asset("cloth");
        scene.duration = mode == "--cloth" ? 8 : 1;
        chosen.push_back({"cloth", scene, cloth_truth(scene), 480, mode == "--cloth" ? 1e9 : 1e8});
    } else {
        chosen = cases(mode == "--full");
    }
    const std::vector<double> tolerances =
        mode.empty() ? std::vector{1e-1, 1e-3, 1e-5} : std::vector{1e-1, 1e-2, 1e-3, 1e-4};
    bool met = true;
    for (const Case& one : chosen) met = run(one, tolerances, mode != "--cloth") && met;
    return met ? 0 : 1;
} catch (const Error& error) {
    fmt::print(stderr, "oiler_advice: {}\n", error.what());
    return static_cast<int>(error.exit());
}
