// SPDX-License-Identifier: MIT
#include "oiler/lab/ledger/ablations.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "oiler/core/error.hpp"
#include "oiler/core/require.hpp"
#include "oiler/core/timing.hpp"
#include "oiler/scene/make_world.hpp"
#include "oiler/sim/bodies.hpp"
namespace oiler::lab {
namespace {

/// Limits for leaving out springs, dampers and attractors one by one: their number, and the bodies
/// of all these worlds together.
constexpr std::size_t most_parts = 48;
constexpr std::int64_t most_part_bodies = 100'000;

template <class F>
void for_each_matter(Scene& scene, F f) {
    for (SceneBody& body : scene.bodies) f(body.matter);
    for (SceneGrid& grid : scene.grids) f(grid.matter);
    for (SceneScatter& scatter : scene.scatters) f(scatter.matter);
}

std::string_view kind_of(const SceneSpring& spring) {
    if (spring.is_link()) return "links";
    return spring.rest_length > 0 ? "coil_spring" : "spring";
}

void remove_springs(Scene& scene, std::string_view kind) {
    std::erase_if(scene.springs,
                  [&](const SceneSpring& spring) { return kind_of(spring) == kind; });
}

template <class Force>
void remove_forces(Scene& scene) {
    std::erase_if(scene.forces, [](const SceneForce& force) {
        return std::holds_alternative<Force>(force.force);
    });
}

/// A force without a table of its own.
struct Elsewhere {
    std::string_view force;
    std::string_view words;  ///< where scene files give it
    void (*leave_out)(Scene&);
};
constexpr std::array elsewhere{
    Elsewhere{"gravity", "[gravity]", [](Scene& scene) { scene.gravity.reset(); }},
    Elsewhere{"spring", "anchored [[spring]] without `rest_length`",
              [](Scene& scene) { remove_springs(scene, "spring"); }},
    Elsewhere{"linear_drag", "`linear_drag`",
              [](Scene& scene) {
                  for_each_matter(scene, [](SceneMatter& matter) { matter.linear_drag = 0; });
              }},
    Elsewhere{"quadratic_drag", "`quadratic_drag`",
              [](Scene& scene) {
                  for_each_matter(scene, [](SceneMatter& matter) { matter.quadratic_drag = 0; });
              }},
    Elsewhere{"coil_spring", "anchored [[spring]] with `rest_length`",
              [](Scene& scene) { remove_springs(scene, "coil_spring"); }},
    Elsewhere{"attractor", "[[attractor]]", [](Scene& scene) { scene.attractors.clear(); }},
};

template <class Force>
ForceDescription description_of() {
    ForceDescription force{.name = Force::name, .plural = Force::plural};
    for_each_field<Force>([&](const auto& field) { force.numbers.push_back(field.key); });
    if constexpr (HasRests<Force>)
        std::apply([&](const auto&... rest) { (force.numbers.push_back(rest.key), ...); },
                   Force::rests());
    const auto found = std::ranges::find(elsewhere, Force::name, &Elsewhere::force);
    if (found != elsewhere.end()) {
        force.words = found->words;
        force.leave_out = found->leave_out;
    } else if constexpr (BodyForce<Force>) {
        force.words = fmt::format("[[{}]]", Force::name);
        force.leave_out = remove_forces<Force>;
    }
    return force;
}

/// Turns the nodes of a grid into bodies, and its hanging springs into springs; drops the springs
/// between nodes. Bodies come before grids, so rows do not change if all grids are taken apart.
void take_apart(Scene& scene, const SceneGrid& grid) {
    const std::size_t first = scene.bodies.size();
    for (std::int64_t row = 0; row < grid.count[1]; ++row)
        for (std::int64_t column = 0; column < grid.count[0]; ++column)
            scene.bodies.push_back({.matter = grid.matter,
                                    .position = node_position(grid, column, row),
                                    .velocity = grid.velocity});
    for (const std::size_t node : anchored_nodes(grid))
        scene.springs.push_back({.body = first + node,
                                 .anchor = scene.bodies[first + node].position,
                                 .stiffness = grid.stiffness,
                                 .damping = grid.damping});
}

void leave_out_links(Scene& scene) {
    remove_springs(scene, "links");
    for (const SceneGrid& grid : scene.grids) take_apart(scene, grid);
    scene.grids.clear();
}

const ForceDescription& describe(std::string_view force) {
    const auto& all = force_descriptions();
    const auto found = std::ranges::find(all, force, &ForceDescription::name);
    require(found != all.end(), "every force has a description in the ledger");
    return *found;
}

class Ablations {
public:
    explicit Ablations(const Scene& scene) : scene_(scene) {}

    std::vector<Ablation> run(const std::vector<std::string_view>& forces, bool linked) {
        Scene bare = scene_;
        for (const std::string_view force : forces) {
            const ForceDescription& words = describe(force);
            add(words.words, "", force, words.leave_out);
            words.leave_out(bare);
        }
        if (hangs()) {
            add("`hang` of [[grid]]", "", "hang", leave_out_hang);
            leave_out_hang(bare);
        }
        if (linked) {
            add(links_text(), "", "links", leave_out_links);
            leave_out_links(bare);
        }
        if (scene_.has_obstacles()) {
            add("obstacles", "", "obstacles", leave_out_obstacles);
            leave_out_obstacles(bare);
        }
        all_.push_back({"", "", "moving", std::move(bare)});
        add_parts();
        return std::move(all_);
    }

private:
    [[nodiscard]] bool hangs() const {
        return std::ranges::any_of(scene_.grids,
                                   [](const SceneGrid& grid) { return grid.hang != Hang::none; });
    }
    static void leave_out_hang(Scene& scene) {
        for (SceneGrid& grid : scene.grids) grid.hang = Hang::none;
    }
    static void leave_out_obstacles(Scene& scene) {
        scene.planes.clear();
        scene.obstacles.clear();
        scene.chains.clear();
        scene.tiles.clear();
    }

    [[nodiscard]] std::string_view links_text() const {
        return scene_.has_ropes() ? "springs between bodies, and ropes" : "springs between bodies";
    }

    template <class Change>
    void add(std::string_view words, std::string_view part_of, std::string_view pass,
             const Change& change) {
        all_.push_back({std::string(words), std::string(part_of), std::string(pass), scene_});
        change(all_.back().scene);
    }
    void add_parts() {
        const std::size_t parts = 2 * scene_.springs.size() + scene_.attractors.size();
        if (parts > most_parts ||
            static_cast<std::int64_t>(parts) * scene_.body_count() > most_part_bodies)
            return;
        for (std::size_t i = 0; i < scene_.springs.size(); ++i) add_spring(i);
        for (std::size_t i = 0; i < scene_.grids.size(); ++i) add_grid(i);
        for (std::size_t i = 0; i < scene_.attractors.size(); ++i)
            add(fmt::format("[[attractor]] {}", i + 1), describe("attractor").words, "",
                [&](Scene& scene) {
                    scene.attractors.erase(scene.attractors.begin() + signed_of(i));
                });
    }
    void add_spring(std::size_t i) {
        const SceneSpring& spring = scene_.springs[i];
        const std::string& name = scene_.bodies[spring.body].name;
        const std::string words = fmt::format("[[spring]] {} (of \"{}\")", i + 1, name);
        const std::string_view kind = kind_of(spring);
        add(words, kind == "links" ? links_text() : describe(kind).words, "",
            [&](Scene& scene) { scene.springs.erase(scene.springs.begin() + signed_of(i)); });
        if (spring.damping > 0)
            add("`damping` of " + words, words, "",
                [&](Scene& scene) { scene.springs[i].damping = 0; });
    }
    void add_grid(std::size_t i) {
        if (scene_.grids[i].damping > 0)
            add(fmt::format("`damping` of [[grid]] {}", i + 1), links_text(), "",
                [&](Scene& scene) { scene.grids[i].damping = 0; });
    }
    static std::ptrdiff_t signed_of(std::size_t i) { return static_cast<std::ptrdiff_t>(i); }

    const Scene& scene_;
    std::vector<Ablation> all_;
};

using Clock = std::chrono::steady_clock;

/// The limit of bodies × steps of all worlds together. A step of fewer bodies than `block` counts
/// as one of `block`.
constexpr double most_body_steps = 1.5e9;
constexpr double block = 16;
/// The limit of bodies × comparisons of all worlds together.
constexpr double most_compared_bodies = 4e7;
constexpr double most_comparing_seconds = 10;

/// Steps a world that may diverge.
class TrialRun {
public:
    explicit TrialRun(const Scene& scene) : world_(make_world(scene, Settings{scene.stepping})) {
        world_.require_applicable();
    }

    void step(std::int64_t count) try {
        if (!diverged_) world_.step(count);
    } catch (const Error& error) {
        if (error.exit() != Exit::diverged) throw;
        diverged_ = error.what();
    }
    [[nodiscard]] const Bodies& bodies() const { return world_.bodies(); }
    [[nodiscard]] const std::optional<std::string>& diverged() const { return diverged_; }

private:
    World world_;
    std::optional<std::string> diverged_;
};

class Comparing {
public:
    Comparing(const Scene& scene, const std::vector<Ablation>& ablations)
        : whole_(scene), start_(whole_.bodies()) {
        trials_.reserve(ablations.size());
        for (const Ablation& ablation : ablations) trials_.emplace_back(ablation.scene);
        result_.without.resize(ablations.size());
    }

    Comparison run(std::int64_t wanted, const LedgerProgress& progress) {
        const std::int64_t steps = std::min(wanted, most_steps());
        const std::int64_t stride = (steps + most_samples() - 1) / most_samples();
        const auto started = Clock::now();
        const auto goes_on = [&] {
            return result_.steps < 2 || seconds_since(started) < most_comparing_seconds;
        };
        while (result_.steps < steps && !whole_.diverged() && goes_on()) {
            advance(std::min({stride, steps - result_.steps, affordable(seconds_since(started))}));
            progress(comparing_share * static_cast<double>(result_.steps) /
                     static_cast<double>(steps));
        }
        result_.diverged = whole_.diverged();
        for (std::size_t i = 0; i < trials_.size(); ++i)
            result_.without[i].diverged = trials_[i].diverged();
        return std::move(result_);
    }

private:
    [[nodiscard]] double worlds() const { return static_cast<double>(trials_.size() + 1); }
    [[nodiscard]] double bodies() const { return static_cast<double>(start_.size()); }

    [[nodiscard]] std::int64_t most_steps() const {
        const double most = most_body_steps / worlds() / std::max(bodies(), block);
        return std::max<std::int64_t>(2, std::llround(most));
    }
    [[nodiscard]] std::int64_t most_samples() const {
        const double most = most_compared_bodies / worlds() / std::max(bodies(), block);
        return std::max<std::int64_t>(1, std::llround(most));
    }

    /// The number of steps that take about 1 s, if those so far took `seconds`.
    [[nodiscard]] std::int64_t affordable(double seconds) const {
        const double steps = static_cast<double>(result_.steps) / std::max(seconds, 1e-9);
        return std::max<std::int64_t>(1, std::llround(steps));
    }

    void advance(std::int64_t count) {
        whole_.step(count);
        result_.steps += count;
        if (whole_.diverged()) return;
        ++result_.samples;
        const Vec3 along = whole_.bodies().deviation_from(start_).along;
        for (int axis = 0; axis < 3; ++axis)
            result_.moved[axis] = std::max(result_.moved[axis], along[axis]);
        for (std::size_t i = 0; i < trials_.size(); ++i) advance(trials_[i], i, count);
    }
    void advance(TrialRun& trial, std::size_t i, std::int64_t count) {
        trial.step(count);
        if (trial.diverged()) return;
        double& change = result_.without[i].change;
        change = std::max(change, whole_.bodies().deviation_from(trial.bodies()).distance);
    }

    TrialRun whole_;
    Bodies start_;
    std::vector<TrialRun> trials_;
    Comparison result_;
};

}  // namespace

const std::vector<ForceDescription>& force_descriptions() {
    static const std::vector<ForceDescription> all = [] {
        std::vector<ForceDescription> descriptions;
        for_each_index<force_count>([&](auto kind) {
            descriptions.push_back(
                description_of<std::tuple_element_t<kind, ForceList<double, 3>>>());
        });
        return descriptions;
    }();
    return all;
}

std::vector<Ablation> ablations(const Scene& scene, const std::vector<std::string_view>& forces,
                                bool linked) {
    return Ablations(scene).run(forces, linked);
}

Comparison compare(const Scene& scene, const std::vector<Ablation>& ablations, std::int64_t steps,
                   const LedgerProgress& progress) {
    return Comparing(scene, ablations).run(steps, progress);
}

}  // namespace oiler::lab
