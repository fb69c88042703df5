// SPDX-License-Identifier: MIT
#include "oiler/lab/advice/passing_time.hpp"

#include <algorithm>
#include <cmath>

#include "oiler/scene/make_world.hpp"

namespace oiler::lab {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

double distance(const World& one, const World& other) {
    double largest = 0;
    for (std::size_t row = 0; row < one.bodies().size(); ++row)
        largest =
            std::max(largest, length(one.bodies().position(row) - other.bodies().position(row)));
    return largest;
}

}  // namespace

double passing_time(const Scene& scene, const Stepping& stepping, const Growth& growth,
                    double tolerance) {
    constexpr std::int64_t finer = 8;
    // A step that may land takes as long as some 20 others.
    const double most_work = scene.has_obstacles() ? 1e5 : 2e6;
    constexpr double most_samples = 4096;
    if (std::holds_alternative<ExactFlow>(stepping.method->rule)) return never;
    Stepping finer_stepping = stepping;
    finer_stepping.rate.steps *= finer;
    finer_stepping.precision = Precision::double_;
    World run = make_world(scene, Settings{stepping});
    World fine = make_world(scene, Settings{finer_stepping});
    const double work = static_cast<double>(run.bodies().size() + 2 * run.bodies().link_count()) *
                        (std::holds_alternative<ImplicitStage>(stepping.method->rule) ? 10 : 1);
    const double dt = stepping.rate.dt();
    const double until = std::min(growth.holds_until(tolerance), most_work / finer / work * dt);
    const auto stride =
        static_cast<std::int64_t>(std::max(1.0, std::ceil(until / dt / most_samples)));
    const double left = tolerance - growth.lines;
    for (std::int64_t tick = stride; static_cast<double>(tick) * dt < until; tick += stride) {
        if (run.try_step(stride) || fine.try_step(stride * finer)) return run.time();
        if (static_cast<double>(tick) * dt > growth.until && distance(run, fine) > left)
            return static_cast<double>(tick) * dt;
    }
    return never;
}

}  // namespace oiler::lab
