// SPDX-License-Identifier: MIT
#include "oiler/lab/sweep/tradeoff_picture.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "oiler/lab/reference/true_energy.hpp"
#include "oiler/picture/palette.hpp"
#include "oiler/plot/plot.hpp"

namespace oiler::lab {
namespace {

constexpr std::int64_t most_points = 4000;  // of a curve over time

std::int64_t steps_of(const Reference& reference, const Rate& rate) {
    return static_cast<std::int64_t>(reference.meaningful_until * static_cast<double>(rate.steps));
}

constexpr std::size_t most_methods = 8;

/// Methods differ in shape as well as in colour.
struct Style {
    Colour colour;
    Mark mark;
};
constexpr std::array<Style, most_methods> styles{{{palette::vermilion, Mark::disc},
                                                  {palette::blue, Mark::square},
                                                  {palette::green, Mark::diamond},
                                                  {palette::orange, Mark::triangle},
                                                  {palette::purple, Mark::ring},
                                                  {palette::sky_blue, Mark::disc},
                                                  {palette::grey, Mark::square},
                                                  {palette::black, Mark::diamond}}};

constexpr Box plot_box{{62, 62}, {446, 308}};

double shown_error(const Tradeoff& tradeoff, const TradeoffRow& row) {
    return row.judgement.below_floor() ? tradeoff.reference.floor.position
                                       : row.judgement.position_error;
}

/// The smallest range of whole decades around the values.
Range decades(double low, double high) {
    return {std::pow(10, std::floor(std::log10(low) + 1e-9)),
            std::pow(10, std::ceil(std::log10(high) - 1e-9))};
}

std::vector<const TradeoffRow*> rows_of(const Tradeoff& tradeoff, const Method* method) {
    std::vector<const TradeoffRow*> rows;
    for (const TradeoffRow* row : tradeoff.rows())
        if (row->stepping.method == method && row->stepping.precision == Precision::double_ &&
            row->judgement.stable)
            rows.push_back(row);
    return rows;
}

void add_if_new(std::vector<const Method*>& methods, const Method* method) {
    if (methods.size() < most_methods &&
        std::find(methods.begin(), methods.end(), method) == methods.end())
        methods.push_back(method);
}

class WorkPrecision {
public:
    WorkPrecision(const Tradeoff& tradeoff, const CostAxis& axis)
        : tradeoff_(tradeoff), axis_(axis) {}

    Picture draw() {
        const auto methods = notable_methods(tradeoff_);
        for (std::size_t i = 0; i < methods.size(); ++i) add_method(methods[i], styles[i]);
        add_front();
        add_current();
        plot_.x_label = axis_.label;
        if (axis_.of == time_of && tradeoff_.machines.size() > 1)
            plot_.x_label += fmt::format(", on {} machines", tradeoff_.machines.size());
        plot_.title = fmt::format("The cost of a timestep: {}",
                                  tradeoff_.title.empty() ? tradeoff_.scene : tradeoff_.title);
        plot_.y_label = "largest position error as drawn, m";
        plot_.caption = fmt::format(
            "Each mark is a rate, in double; the dashed line has both precisions. Errors over "
            "{:.4g} s against {}.",
            tradeoff_.reference.meaningful_until,
            tradeoff_.reference.closed_form ? "the closed form of the motion"
                                            : "fine steps in long double");
        plot_.x = decades(least_.x, most_.x);
        plot_.y = decades(least_.y, std::min(most_.y, 2 * tradeoff_.reference.extent));
        Picture picture;
        plot_.draw(picture, {});
        add_cheapest(picture);
        return picture;
    }

private:
    /// Lists the cheapest setting for each tolerance, below the legend.
    void add_cheapest(Picture& picture) const {
        constexpr float size = 7;
        constexpr float pitch = 11;
        constexpr int most = 9;
        float y = 156;
        const auto write = [&](float x, const std::string& words) {
            picture.labels.push_back(
                {.at = {x, y}, .text = words, .size = size, .colour = palette::ink});
        };
        const float left = plot_box.high.x + 9;
        write(left, fmt::format("least cost, {}, by largest error", axis_.unit_name));
        const auto front = pareto(tradeoff_, axis_.of);
        double error = std::pow(10, std::floor(std::log10(tradeoff_.reference.extent / 5)));
        for (int i = 0; i < most; ++i, error /= 10) {
            const auto row = std::find_if(front.begin(), front.end(), [&](const TradeoffRow* one) {
                return shown_error(tradeoff_, *one) <= error * (1 + 1e-9);
            });
            if (row == front.end()) break;
            y -= pitch;
            write(left,
                  error < 1e-3 ? fmt::format("{:.0e} m", error) : fmt::format("{:g} m", error));
            write(left + 36,
                  fmt::format("{} {} Hz{} {:.4g}", (*row)->stepping.method->name,
                              (*row)->stepping.rate.steps,
                              (*row)->stepping.precision == Precision::single ? " float:" : ":",
                              axis_.of(**row) / axis_.unit));
        }
    }
    void add_method(const Method* method, const Style& style) {
        Series series{
            .name = std::string(method->name), .colour = style.colour, .mark = style.mark};
        for (const TradeoffRow* row : rows_of(tradeoff_, method)) add(series, *row);
        if (!series.points.empty()) plot_.series.push_back(std::move(series));
    }
    void add_front() {
        Series series{
            .name = "best of all methods", .colour = palette::ink, .width = 2.2F, .dashed = true};
        for (const TradeoffRow* row : pareto(tradeoff_, axis_.of)) {
            // A staircase: no cheaper row is more accurate.
            if (!series.points.empty())
                series.points.push_back({axis_.of(*row) / axis_.unit, series.points.back().y});
            add(series, *row);
        }
        plot_.series.push_back(std::move(series));
    }
    void add_current() {
        const TradeoffRow* const current = tradeoff_.find(tradeoff_.current);
        if (!current || !current->judgement.stable) return;
        Series series{.name = fmt::format("current: {} Hz", tradeoff_.current.rate.steps),
                      .colour = palette::black,
                      .mark = Mark::square};
        add(series, *current);
        plot_.series.push_back(std::move(series));
    }
    void add(Series& series, const TradeoffRow& row) {
        const DataPoint at{axis_.of(row) / axis_.unit, shown_error(tradeoff_, row)};
        if (!(at.x > 0 && at.y > 0) || !std::isfinite(at.x)) return;
        least_ = {std::min(least_.x, at.x), std::min(least_.y, at.y)};
        most_ = {std::max(most_.x, at.x), std::max(most_.y, at.y)};
        series.points.push_back(at);
    }

    const Tradeoff& tradeoff_;
    CostAxis axis_;
    DataPoint least_{INFINITY, INFINITY};
    DataPoint most_{0, 0};
    Plot plot_{.box = plot_box,
               .x_scale = Scale::logarithmic,
               .y_scale = Scale::logarithmic,
               .y_ticks = 16,
               .legend_beside = true};
};

}  // namespace

std::vector<const Method*> notable_methods(const Tradeoff& tradeoff) {
    std::vector<const Method*> methods;
    const auto has_rows = [&](const Method* method) { return !rows_of(tradeoff, method).empty(); };
    if (has_rows(tradeoff.current.method)) methods.push_back(tradeoff.current.method);
    for (const Method* method : obvious_methods())
        if (has_rows(method)) add_if_new(methods, method);
    std::map<const Method*, int> best;
    for (const TradeoffRow* row : pareto(tradeoff, time_of)) ++best[row->stepping.method];
    std::vector<std::pair<int, const Method*>> order;
    for (const Method& method : oiler::methods())
        if (best.contains(&method)) order.emplace_back(-best[&method], &method);
    std::stable_sort(order.begin(), order.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [count, method] : order)
        if (has_rows(method)) add_if_new(methods, method);
    return methods;
}

Picture work_precision(const Tradeoff& tradeoff, const CostAxis& axis) {
    return WorkPrecision(tradeoff, axis).draw();
}

Picture energy_over_time(const Scene& scene, const Tradeoff& tradeoff, const Reference& reference,
                         const std::vector<Stepping>& choices) {
    Plot plot{.box = plot_box,
              .title = fmt::format("Energy: {}",
                                   tradeoff.title.empty() ? tradeoff.scene : tradeoff.title),
              .caption = fmt::format("Largest difference from the reference's energy so far, at {} "
                                     "Hz; values below {:.1e} are not shown.",
                                     choices.front().rate.steps, reference.floor().energy),
              .x_label = "time, s",
              .y_label = "relative energy drift",
              .x = {0, reference.meaningful_until},
              .y_scale = Scale::logarithmic,
              .y_ticks = 12,
              .legend_beside = true};
    double low = INFINITY;
    double high = 0;
    for (std::size_t i = 0; i < std::min(choices.size(), most_methods); ++i) {
        Series series{.name = std::string(choices[i].method->name),
                      .colour = styles[i].colour,
                      .dashed = i % 2 == 1};
        World world = make_world(scene, Settings{choices[i]}, reference.start);
        TrueEnergy true_energy(scene, reference);
        const std::int64_t stride = 1 + steps_of(reference, choices[i].rate) / most_points;
        double most = 0;
        while (world.time() <= reference.meaningful_until) {
            const double off = world.bodies().energy().total() - true_energy.at(world.time());
            most = std::max(most, reference.share_of_energy(std::abs(off)));
            if (!std::isfinite(most) || most > 1e6) break;
            if (most >= reference.floor().energy) {
                low = std::min(low, most);
                high = std::max(high, most);
                series.points.push_back({world.time(), most});
            }
            if (world.try_step(stride)) break;
        }
        plot.series.push_back(std::move(series));
    }
    plot.y = high > 0 ? decades(low, high) : Range{1e-16, 1};
    if (plot.y.high <= plot.y.low) plot.y.high = 10 * plot.y.low;
    Picture picture;
    plot.draw(picture, {});
    return picture;
}

}  // namespace oiler::lab
