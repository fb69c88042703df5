// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include "oiler/core/error.hpp"
#include "oiler/stability/risks.hpp"

namespace oiler {

double last_place(double number, Precision precision) {
    const auto place = []<class T>(T at) {
        return static_cast<double>(std::nextafter(at, std::numeric_limits<T>::infinity()) - at);
    };
    const double at = std::abs(number);
    return precision == Precision::single ? place(static_cast<float>(at)) : place(at);
}

namespace {

/// The part of a spring, or of a motion, that coordinates must resolve.
constexpr double coarse = 0.1;

/// The remedy of positions that are too coarse.
const char* remedy_in(Precision precision) {
    return precision == Precision::single ? "take precision double, or an origin nearer to it"
                                          : "take an origin nearer to it";
}

/// The lengths of a body that the last place of its coordinates does not resolve.
class ResolutionTest {
public:
    ResolutionTest(const Bodies& bodies, std::size_t row)
        : bodies_(bodies),
          row_(row),
          unit_(last_place(largest(bodies.position(row)), bodies.precision())),
          number_(bodies.precision() == Precision::single ? "float" : "double") {}

    [[nodiscard]] std::optional<Risk> find_risk() const {
        constexpr double fine = 1e-10;  // m, the last place of 10⁶ m in double
        if (unit_ <= fine) return std::nullopt;
        std::optional<Risk> risk = contact_risk();
        const auto check = [&](double stiffness, double rest_length, const Vec3& anchor) {
            if (!risk && stiffness > 0) risk = spring_risk(rest_length, anchor);
        };
        for_each_force_on(bodies_, row_, [&]<class Force>(const Force& force) {
            if constexpr (LineSpring<Force>)
                check(force.stiffness, force.rest_length, force.anchor);
            else if constexpr (std::is_same_v<Force, Spring>)
                check(force.stiffness, 0, force.anchor);
        });
        return risk;
    }
    /// A spring without a rest length may hang at rest, at any distance from its anchor. Its place
    /// is unknown if the last place is half a metre.
    [[nodiscard]] std::optional<Risk> spring_risk(double rest_length, const Vec3& end) const {
        const bool is_long = rest_length > 0;
        const double length_of_spring =
            is_long ? rest_length : length(bodies_.position(row_) - end);
        const bool rests = squared_length(bodies_.velocity(row_)) == 0;
        if (!(unit_ > coarse * length_of_spring) || !(is_long || (rests && unit_ >= 0.5)))
            return std::nullopt;
        const char* const what =
            is_long ? "the rest length of its spring is" : "the ends of its spring are apart by";
        return risk_of(fmt::format("{} {:.3g} m", what, length_of_spring));
    }

private:
    /// A contact hides 16 epsilons of the coordinate, the round-off of a gap.
    [[nodiscard]] std::optional<Risk> contact_risk() const {
        const auto contact = bodies_.contact(row_);
        if (!contact || !bodies_.has_obstacles()) return std::nullopt;
        const double hidden =
            16 * largest(bodies_.position(row_)) *
            (bodies_.precision() == Precision::single ? std::numeric_limits<float>::epsilon()
                                                      : std::numeric_limits<double>::epsilon());
        if (!(contact->radius > 0) || !(hidden > contact->radius)) return std::nullopt;
        return risk_of(fmt::format("rounding hides gaps of {:.2g} m, at a radius of {:.3g} m",
                                   hidden, contact->radius));
    }
    [[nodiscard]] Risk risk_of(const std::string& what) const {
        return {.row = row_,
                .of = Risk::Of::rounded_position,
                .message =
                    fmt::format("position of body {{}}: its last place in {} is {:.3g} m, and {}: "
                                "{}",
                                number_, unit_, what, remedy_in(bodies_.precision()))};
    }

    const Bodies& bodies_;
    std::size_t row_;
    double unit_;  ///< m
    const char* number_;
};

/// Runs of all bodies in float and in double, body by body.
struct Departure {
    double distance = 0;  ///< m, the largest between both
    double time = 0;      ///< s, of that distance
    double extent = 0;    ///< m, of the motion in double
};

/// Runs so many steps or fewer, which take some tens of milliseconds; empty if a run diverges.
std::vector<Departure> departures_of(Bodies single, const Method& method, const Steps& steps) {
    constexpr double most_steps = 512;
    constexpr double most_work = 400'000;
    const double work = static_cast<double>(single.size() + 2 * single.link_count()) *
                        (is_implicit(method) ? 10 : 1);
    const double most = steps.count > 1 ? static_cast<double>(steps.count) : most_steps;
    const double count = std::min({most, most_steps, most_work / work});
    Bodies exact = in_double(single);
    const Bodies start = exact;
    std::vector<Departure> all(start.size());
    for (std::int64_t tick = 0; static_cast<double>(tick) < count; ++tick) {
        const Steps step{steps.rate, steps.first + tick, 1, steps.damping};
        if (single.try_step(method, step) || exact.try_step(method, step)) return {};
        for (std::size_t row = 0; row < all.size(); ++row) {
            Departure& of = all[row];
            const double distance = length(single.position(row) - exact.position(row));
            of.extent = std::max(of.extent, length(exact.position(row) - start.position(row)));
            if (distance > of.distance) {
                of.distance = distance;
                of.time = static_cast<double>(tick + 1) * steps.rate.dt();
            }
        }
    }
    return all;
}

/// The extent of a motion that is no round-off of the start, m: a body that is held may rest there.
double least_extent(const Bodies& bodies, std::size_t row, bool linked, double unit) {
    double held = linked || bodies.contact(row) ? 3 * unit : 0;
    for_each_force_on(bodies, row, [&]<class Force>(const Force& force) {
        if constexpr (LineSpring<Force>)
            held = std::max(held, 3 * unit);
        else if constexpr (std::is_same_v<Force, Spring>)
            if (force.stiffness > 0)
                held = std::max(
                    held, std::min(3 * unit, coarse * length(bodies.position(row) - force.anchor)));
    });
    return held;
}

}  // namespace

double coarse_unit(const Bodies& bodies, std::size_t row, double dt) {
    const State<double, 3> state{bodies.position(row), bodies.velocity(row)};
    const double unit = last_place(largest(state.x), Precision::single);
    Vec3 acceleration{};
    double drive = 0;
    double stiffness = 0;
    for_each_force_on(bodies, row, [&]<class Force>(const Force& force) {
        if constexpr (LineSpring<Force> || std::is_same_v<Force, Spring>)
            stiffness += std::max(force.stiffness, 0.0);
        if constexpr (std::is_same_v<Force, Drive>)
            drive += length(force.amplitude);
        else
            acceleration += accelerate(force, state, 0);
    });
    // A spring turns the acceleration within 1/ω.
    const double time = std::max(dt, 1 / std::sqrt(1 + stiffness));
    const double speed = length(state.v) + (length(acceleration) + drive) * time;
    return unit > 0.01 * speed * dt ? unit : 0;
}

void add_resolution_risks(const Bodies& bodies, std::vector<Risk>& risks) {
    const std::size_t before = risks.size();
    for (std::size_t row = 0; row < bodies.size(); ++row)
        if (auto risk = ResolutionTest(bodies, row).find_risk()) risks.push_back(std::move(*risk));
    if (risks.size() > before) return;
    for (std::size_t i = 0; i < bodies.link_count(); ++i) {
        const auto [row, other, point] = bodies.link_ends(i);
        const Vec3 end = other ? bodies.position(*other) : point;
        if (auto risk =
                ResolutionTest(bodies, row).spring_risk(bodies.link_at(i).rest_length, end)) {
            risks.push_back(std::move(*risk));
            return;
        }
    }
}

void add_float_distortions(const Bodies& bodies, const Method& method, const Steps& steps,
                           std::vector<Risk>& risks) {
    if (bodies.precision() != Precision::single) return;
    std::vector<double> units;
    for (std::size_t row = 0; row < bodies.size(); ++row)
        units.push_back(coarse_unit(bodies, row, steps.rate.dt()));
    if (std::ranges::all_of(units, [](double unit) { return unit == 0; })) return;
    const std::vector<bool> linked = bodies.linked_rows();
    const std::vector<Departure> all = departures_of(bodies, method, steps);
    for (std::size_t row = 0; row < all.size() && risks.size() < most_distortions; ++row) {
        const Departure& of = all[row];
        if (units[row] == 0 || !(of.distance > coarse * of.extent)) continue;
        if (!(of.extent > least_extent(bodies, row, linked[row], units[row]))) continue;
        risks.push_back(
            {.row = row,
             .of = Risk::Of::told,
             .message = fmt::format(
                 "position of body {{}}: its steps are rounded to {:.3g} m, the last place in "
                 "float, and after {:.3g} s it is {:.2g} m away from its place in double, in a "
                 "motion of {:.2g} m: {}",
                 units[row], of.time, of.distance, of.extent, remedy_in(Precision::single))});
    }
}

}  // namespace oiler
