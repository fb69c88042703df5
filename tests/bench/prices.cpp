// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>

#include "bench/bench.hpp"
#include "bench/scenes.hpp"

namespace oiler::bench {
namespace {

constexpr std::size_t body_count = 10'000;
constexpr int per_call = 64;

constexpr std::array method_names{"semi_implicit_euler",
                                  "velocity_verlet",
                                  "rk2_midpoint",
                                  "rk4",
                                  "pefrl",
                                  "implicit_midpoint",
                                  "exact"};

/// The forces of a row of the table. They are so weak that nothing diverges, sleeps or becomes
/// subnormal in the millions of steps of a long measurement.
struct Priced {
    std::string_view name;
    std::string_view without_one;  ///< the row with one force less; empty if there is none
    bool falls;                    ///< under gravity
    int springs;
    std::function<GivenForces(std::size_t row, int axes)> forces;

    [[nodiscard]] bool is_linear() const {
        bool linear = true;
        for_each_given(forces(0, 1),
                       [&]<class Force>(const Force&) { linear = linear && Linear<Force>; });
        return linear;
    }
};

Vec3 scattered(std::size_t i, int axes) {
    Vec3 numbers{};
    for (int axis = 0; axis < axes; ++axis)
        numbers[axis] =
            static_cast<double>((i * 37 + static_cast<std::size_t>(axis) * 59) % 193) / 8;
    return numbers;
}

template <class Force>
GivenForces given(const Force& force) {
    GivenForces forces;
    std::get<std::optional<Force>>(forces) = force;
    return forces;
}

Spring spring_at(std::size_t row, int axes) {
    return {scattered(row, axes), soft_spring.stiffness, soft_spring.damping};
}

const std::vector<Priced>& rows() {
    const auto own_spring = [](std::size_t row, int axes) { return given(spring_at(row, axes)); };
    static const std::vector<Priced> all{
        {"no force", "", false, 0, [](std::size_t, int) { return GivenForces{}; }},
        {"gravity", "no force", true, 0, [](std::size_t, int) { return GivenForces{}; }},
        {"gravity, linear drag", "gravity", true, 0,
         [](std::size_t, int) { return given(LinearDrag{1e-4}); }},
        {"spring, shared", "no force", false, 1,
         [](std::size_t, int axes) { return given(spring_at(3, axes)); }},
        {"spring, own anchors", "no force", false, 1, own_spring},
        {"gravity, spring", "spring, own anchors", true, 1, own_spring},
        {"two springs", "spring, own anchors", false, 2, own_spring},
        {"gravity, quadratic drag", "gravity", true, 0,
         [](std::size_t, int) { return given(QuadraticDrag{1e-4}); }},
        {"coil spring", "no force", false, 0,
         [](std::size_t row, int axes) {
             return given(CoilSpring{scattered(row, axes), 0.01, 0.01 / 60, 3});
         }},
        {"attractor", "no force", false, 0,
         [](std::size_t, int) {
             return given(Attractor{{200}, 1});
         }},
    };
    return all;
}

Bodies bodies_of(const Priced& priced, Precision precision, int axes) {
    Bodies bodies(axes, precision);
    if (priced.falls) bodies.set_gravity(within(gravity, axes));
    for (std::size_t row = 0; row < body_count; ++row) {
        bodies.add(start_of(row, axes), priced.forces(row, axes));
        if (priced.springs > 1) bodies.attach_at(1, row, spring_at(row + 7, axes));
    }
    return bodies;
}

/// ns per body and step.
struct Price {
    double many = 0;
    double one = 0;
};

Price price_of(const Bench& bench, const Priced& priced, const Method& method, Precision precision,
               int axes) {
    Bodies many = bodies_of(priced, precision, axes);
    Bodies one = many;
    const auto steps = [&](Bodies& bodies, int count) -> Work {
        return repeated(
            [&bodies, &method, count] { bodies.step(method, {.rate = rate, .count = count}); });
    };
    const std::vector<double> seconds = race({steps(many, per_call), steps(one, 1)}, bench.effort);
    return {Bench::ns(seconds[0], double{body_count} * per_call),
            Bench::ns(seconds[1], double{body_count})};
}

using Prices = std::vector<std::pair<std::string_view, Price>>;

Prices prices_of(const Bench& bench, const Priced& priced, Precision precision, int axes) {
    Prices prices;
    for (const char* name : method_names) {
        const Method& method = find_method(name);
        const bool is_linear_only =
            method.order == exact_order || std::string_view(name) == "implicit_midpoint";
        if (!is_linear_only || priced.is_linear())
            prices.emplace_back(name, price_of(bench, priced, method, precision, axes));
    }
    return prices;
}

/// Leaving a force out costs at most 5 % more.
void add_targets(Bench& bench, const std::string& where, const Priced& priced, const Prices& prices,
                 const Prices& without) {
    for (const auto& [method, price] : prices)
        for (const auto& [other, cheaper] : without)
            if (method == other)
                bench.report.target(
                    {"T8",
                     fmt::format("{}, {}: {} / {}", where, method, priced.without_one, priced.name),
                     cheaper.many / price.many, at_most(1.05),
                     fmt::format("{:.3f} ns, {:.3f} ns", cheaper.many, price.many)});
}

void add_implicit_target(Bench& bench, const std::string& where, const Prices& prices) {
    const auto at = [&](std::string_view name) {
        return std::ranges::find(prices, name, &Prices::value_type::first)->second.many;
    };
    bench.report.target({"T8", where + ", spring, own anchors: implicit_midpoint / velocity_verlet",
                         at("implicit_midpoint") / at("velocity_verlet"), at_most(20)});
}

void measure(Bench& bench, Precision precision, int axes) {
    const std::string where = columns(precision, axes);
    if (!bench.wants("prices: " + where)) return;
    std::vector<Prices> all;
    for (const Priced& priced : rows()) {
        all.push_back(prices_of(bench, priced, precision, axes));
        Row many{std::string(priced.name), {}};
        Row one = many;
        for (const auto& [method, price] : all.back()) {
            many.numbers.emplace_back(method, price.many);
            one.numbers.emplace_back(method, price.one);
        }
        const std::string title = "Prices, ns per body and step, " + where;
        bench.report.add(title + ", 64 steps per call", std::move(many));
        bench.report.add(title + ", one step per call", std::move(one));
        for (std::size_t i = 0; i + 1 < all.size(); ++i)
            if (rows()[i].name == priced.without_one)
                add_targets(bench, where, priced, all.back(), all[i]);
        if (priced.name == "spring, own anchors") add_implicit_target(bench, where, all.back());
    }
}

}  // namespace

void bench_prices(Bench& bench) {
    for (const Precision precision : {Precision::single, Precision::double_})
        for (const int axes : {2, 3})
            if (axes == 2 || bench.full) measure(bench, precision, axes);
}

}  // namespace oiler::bench
