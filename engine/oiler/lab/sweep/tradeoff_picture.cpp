// SPDX-License-Identifier: MIT
#include "oiler/lab/sweep/tradeoff_picture.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "oiler/picture/palette.hpp"
#include "oiler/plot/plot.hpp"
namespace oiler::lab {
namespace {

constexpr std::size_t most_methods = 6;

/// Methods differ in shape as well as in colour.
struct MethodStyle {
    Colour colour;
    Mark mark;
};
constexpr std::array<MethodStyle, most_methods> styles{{{palette::vermilion, Mark::disc},
                                                        {palette::blue, Mark::square},
                                                        {palette::green, Mark::diamond},
                                                        {palette::orange, Mark::triangle},
                                                        {palette::purple, Mark::ring},
                                                        {palette::sky_blue, Mark::disc}}};

/// Leaves room for the longest name of a method beside the box.
constexpr Box plot_box{{54, 62}, {420, 308}};

std::string title_of(const char* words, const Tradeoff& tradeoff) {
    return fmt::format("{}: {}", words, tradeoff.title.empty() ? tradeoff.scene : tradeoff.title);
}
constexpr double most_decades = 7;    // of errors, so that those of games have room
constexpr double always_room = 1e-4;  // m, for the errors of games in wide scenes
constexpr double air = 1.6;           // at the ends of both axes, a factor
constexpr int tolerances = 4;         // of the list of winners, powers of ten

/// A pale band below the curves.
constexpr Colour front_colour = palette::mix(palette::orange, palette::paper, 0.55F);

double shown_error(const Tradeoff& tradeoff, const TradeoffRow& row) {
    return row.judgement.below_floor() ? tradeoff.reference.floor.position
                                       : row.judgement.position_error;
}

std::string in_metres(double length) {
    if (length >= 1) return fmt::format("{:g} m", length);
    if (length >= 0.01) return fmt::format("{:g} cm", 1e2 * length);
    return length >= 1e-4 ? fmt::format("{:g} mm", 1e3 * length)
                          : fmt::format("{:g} µm", 1e6 * length);
}

/// The stable rows of a method in double, in ascending order of their rates.
std::vector<const TradeoffRow*> rows_of(const Tradeoff& tradeoff, const Method* method) {
    std::vector<const TradeoffRow*> rows;
    for (const TradeoffRow* row : tradeoff.rows())
        if (row->stepping.method == method && row->stepping.precision == Precision::double_ &&
            row->judgement.stable)
            rows.push_back(row);
    std::ranges::stable_sort(rows, {},
                             [](const TradeoffRow* row) { return row->stepping.rate.steps; });
    return rows;
}

void add_if_new(std::vector<const Method*>& methods, const Method* method) {
    if (methods.size() < most_methods && std::ranges::find(methods, method) == methods.end())
        methods.push_back(method);
}

class WorkPrecision {
public:
    WorkPrecision(const Tradeoff& tradeoff, const CostAxis& axis)
        : tradeoff_(tradeoff),
          axis_(axis),
          methods_(notable_methods(tradeoff)),
          current_(tradeoff.find(tradeoff.current)),
          front_(pareto(tradeoff, axis.of)) {}

    Picture draw() {
        set_ranges();
        std::erase_if(front_, [&](const TradeoffRow* row) { return !is_shown(*row); });
        add_front();
        for (std::size_t i = 0; i < methods_.size(); ++i) add_method(methods_[i], styles[i]);
        add_others();
        add_current();
        add_winners();
        plot_.title = title_of("The cost of a timestep", tradeoff_);
        plot_.x_label = axis_.label;
        if (axis_.of == time_of && tradeoff_.machines.size() > 1)
            plot_.x_label += fmt::format(", on {} machines", tradeoff_.machines.size());
        plot_.y_label = "largest position error as drawn, m";
        plot_.caption = caption();
        Picture picture;
        plot_.draw(picture, {});
        return picture;
    }

private:
    [[nodiscard]] std::optional<DataPoint> point(const TradeoffRow& row) const {
        const DataPoint at{axis_.of(row) / axis_.unit, shown_error(tradeoff_, row)};
        if (!(at.x > 0 && at.y > 0) || !std::isfinite(at.x) || !std::isfinite(at.y))
            return std::nullopt;
        return at;
    }
    [[nodiscard]] std::vector<DataPoint> points(const std::vector<const TradeoffRow*>& rows) const {
        std::vector<DataPoint> found;
        for (const TradeoffRow* row : rows)
            if (const auto at = point(*row)) found.push_back(*at);
        return found;
    }
    [[nodiscard]] bool has_current() const {
        return current_ && current_->judgement.stable && point(*current_);
    }
    [[nodiscard]] bool is_shown(const TradeoffRow& row) const {
        const auto at = point(row);
        return at && at->y >= plot_.y.low && at->y <= plot_.y.high;
    }

    /// Sets the axes: from the largest error that makes sense `most_decades` downwards, and the
    /// costs of the points among these.
    void set_ranges() {
        std::vector<DataPoint> all = points(front_);
        for (const Method* method : methods_)
            for (const DataPoint& at : points(rows_of(tradeoff_, method))) all.push_back(at);
        if (all.empty()) return;
        const auto [least, most] = std::ranges::minmax(all, {}, &DataPoint::y);
        double high = std::min(most.y, 2 * tradeoff_.reference.extent);
        if (has_current()) high = std::max(high, point(*current_)->y);
        high = std::max(high, least.y);
        const double low = std::min(high * std::pow(10, -most_decades), always_room);
        is_cut_ = least.y < low;
        plot_.y = {std::max(least.y / air, low), high * air};
        std::erase_if(
            all, [&](const DataPoint& at) { return at.y < plot_.y.low || at.y > plot_.y.high; });
        const auto [cheapest, dearest] = std::ranges::minmax(all, {}, &DataPoint::x);
        plot_.x = {cheapest.x / air, dearest.x * air};
    }
    void add_front() {
        plot_.series.push_back({.name = "Pareto front: least cost",
                                .colour = front_colour,
                                .points = points(front_),
                                .width = 9});
    }
    /// Whether a curve cannot be seen beside another: all of its marks are on the other's.
    [[nodiscard]] bool is_hidden_by(const std::vector<DataPoint>& curve,
                                    const std::vector<DataPoint>& other) const {
        constexpr float near = 2;  // units, less than the radius of a mark
        return std::ranges::all_of(curve, [&](const DataPoint& one) {
            return std::ranges::any_of(other, [&](const DataPoint& another) {
                const Point a = plot_.to_canvas(one);
                const Point b = plot_.to_canvas(another);
                return std::hypot(a.x - b.x, a.y - b.y) < near;
            });
        });
    }
    void add_method(const Method* method, const MethodStyle& style) {
        std::vector<DataPoint> curve = points(rows_of(tradeoff_, method));
        if (curve.empty()) return;
        const auto same = std::ranges::find_if(plot_.series, [&](const Series& other) {
            return other.mark != Mark::none && is_hidden_by(curve, other.points);
        });
        if (same != plot_.series.end()) {
            same->name += fmt::format("\n= {}", method->name);
            return;
        }
        plot_.series.push_back({.name = std::string(method->name),
                                .colour = style.colour,
                                .points = std::move(curve),
                                .mark = style.mark});
    }
    /// Marks the rows on the front and on no curve, so that each corner of the front has a mark.
    void add_others() {
        Series series{.name = "other settings on the front",
                      .colour = palette::grey,
                      .width = 0,
                      .mark = Mark::disc};
        for (const TradeoffRow* row : front_)
            if (row->stepping.precision == Precision::single ||
                std::ranges::find(methods_, row->stepping.method) == methods_.end())
                series.points.push_back(*point(*row));
        plot_.series.push_back(std::move(series));
    }
    void add_current() {
        if (!has_current()) return;
        plot_.series.push_back(
            {.name = fmt::format("current: {} Hz\n{}", tradeoff_.current.rate.steps,
                                 tradeoff_.current.method->name),
             .colour = palette::black,
             .points = {*point(*current_)},
             .width = 0,
             .mark = Mark::frame});
    }
    /// Marks and lists the cheapest settings within tolerances: from the largest power of ten that
    /// is small for the scene and at most 1 m.
    void add_winners() {
        Series series{
            .name = "least cost within:", .colour = palette::ink, .width = 0, .mark = Mark::halo};
        const double first = std::floor(std::log10(tradeoff_.reference.extent / 5));
        for (int i = 0; i < tolerances; ++i) {
            const double tolerance = std::pow(10, std::min(first, 0.0) - i);
            const auto found = std::ranges::find_if(front_, [&](const TradeoffRow* one) {
                return shown_error(tradeoff_, *one) <= tolerance * (1 + 1e-9);
            });
            if (found == front_.end()) break;
            const TradeoffRow& row = **found;
            series.points.push_back(*point(row));
            plot_.notes.push_back(fmt::format("{}: {:.4g} {}", in_metres(tolerance),
                                              axis_.of(row) / axis_.unit, axis_.unit_name));
            plot_.notes.push_back(
                fmt::format("  {} {} Hz{}", row.stepping.method->name, row.stepping.rate.steps,
                            row.stepping.precision == Precision::single ? " float" : ""));
        }
        plot_.series.push_back(std::move(series));
    }
    [[nodiscard]] std::string caption() const {
        std::string text = "Each mark is a rate, in double on the curves. ";
        if (current_ && !current_->judgement.stable) text += "The current setting is unstable. ";
        if (is_cut_) text += fmt::format("Errors below {:.0e} m are not shown. ", plot_.y.low);
        return text + fmt::format("Errors over {:.4g} s against {}.",
                                  tradeoff_.reference.meaningful_until,
                                  tradeoff_.reference.closed_form ? "the closed form"
                                                                  : "fine steps in long double");
    }

    const Tradeoff& tradeoff_;
    CostAxis axis_;
    std::vector<const Method*> methods_;
    const TradeoffRow* current_;
    std::vector<const TradeoffRow*> front_;
    bool is_cut_ = false;
    Plot plot_{.box = plot_box,
               .x = {0.1, 10},
               .y = {0.1, 10},
               .x_scale = Scale::logarithmic,
               .y_scale = Scale::logarithmic,
               .y_ticks = 16,
               .legend_beside = true};
};

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
        const double off = world.energy().total() - true_energy.at(world.time());
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
    std::ranges::stable_sort(order, {}, &std::pair<int, const Method*>::first);
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
