// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "oiler/lab/reference/true_energy.hpp"
#include "oiler/lab/sweep/picture_style.hpp"
#include "oiler/lab/sweep/tradeoff_picture.hpp"

namespace oiler::lab {
namespace {

constexpr double most_points = 4000;  // of a curve

/// Runs the scene. Returns the largest energy drift so far over time, from the reference's floor
/// on; the curve ends where the run is unstable.
std::vector<DataPoint> drift_over_time(const Scene& scene, const Reference& reference,
                                       const Stepping& choice) {
    constexpr double unstable = 1e6;
    std::vector<DataPoint> points;
    World world = make_world(scene, Settings{choice}, reference.start);
    TrueEnergy true_energy(scene, reference);
    const double steps = reference.meaningful_until * static_cast<double>(choice.rate.steps);
    const auto stride = 1 + static_cast<std::int64_t>(steps / most_points);
    double most = 0;
    while (world.time() <= reference.meaningful_until) {
        const double off = world.bodies().energy().total() - true_energy.at(world.time());
        most = std::max(most, reference.share_of_energy(std::abs(off)));
        if (!std::isfinite(most) || most > unstable) break;
        if (most >= reference.floor().energy) points.push_back({world.time(), most});
        if (world.try_step(stride)) break;
    }
    return points;
}

/// The smallest range of whole decades around all values.
Range decades_of(const std::vector<Series>& curves) {
    double low = INFINITY;
    double high = 0;
    for (const Series& curve : curves)
        for (const DataPoint& at : curve.points) {
            low = std::min(low, at.y);
            high = std::max(high, at.y);
        }
    if (high == 0) return {1e-16, 1};
    const Range range{std::pow(10, std::floor(std::log10(low) + 1e-9)),
                      std::pow(10, std::ceil(std::log10(high) - 1e-9))};
    return {range.low, std::max(range.high, 10 * range.low)};
}

}  // namespace

Picture energy_over_time(const Scene& scene, const Tradeoff& tradeoff, const Reference& reference,
                         const std::vector<Stepping>& choices) {
    Plot plot{.box = plot_box,
              .title = title_of("Energy", tradeoff),
              .caption = fmt::format(
                  "Largest difference from the reference's energy so far, at {} Hz in double.",
                  choices.front().rate.steps),
              .x_label = "time, s",
              .y_label = "relative energy drift",
              .x = {0, reference.meaningful_until},
              .y_scale = Scale::logarithmic,
              .y_ticks = 12,
              .legend_beside = true};
    for (std::size_t i = 0; i < std::min(choices.size(), most_methods); ++i)
        plot.series.push_back({.name = std::string(choices[i].method->name),
                               .colour = styles[i].colour,
                               .points = drift_over_time(scene, reference, choices[i]),
                               .dashed = i % 2 == 1});
    plot.y = decades_of(plot.series);
    for (const Series& curve : plot.series) {
        if (!curve.points.empty()) continue;
        if (plot.notes.empty())
            plot.notes.push_back(fmt::format("below {:.1e}:", reference.floor().energy));
        plot.notes.push_back("  " + curve.name);
    }
    Picture picture;
    plot.draw(picture, {});
    return picture;
}

}  // namespace oiler::lab
