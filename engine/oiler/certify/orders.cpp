// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <span>

#include "oiler/certify/measures.hpp"
#include "oiler/certify/problems.hpp"

namespace oiler::certify {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double round_off(Precision precision) {
    return precision == Precision::extended
               ? static_cast<double>(std::numeric_limits<long double>::epsilon())
               : std::numeric_limits<double>::epsilon();
}

struct Errors {
    double position = 0;
    double velocity = 0;
};

Errors errors_after_a_second(const Method& method, Damping damping, const Problem& problem,
                             Precision precision, std::int64_t steps) {
    Bodies bodies = bodies_of(problem, precision);
    if (bodies.try_step(method, {.rate = {steps}, .count = steps, .damping = damping}))
        return {nan, nan};
    Errors largest;
    for (std::size_t row = 0; row < bodies.size(); ++row) {
        const auto end = bodies.state(row);
        const auto exact = problem.end(row);
        largest.position =
            std::max(largest.position, static_cast<double>(oiler::largest(end.x - exact.x)));
        largest.velocity =
            std::max(largest.velocity, static_cast<double>(oiler::largest(end.v - exact.v)));
    }
    return largest;
}

/// The slope of −log₂(error) over the index, by least squares. NaN if slopes between neighbours
/// differ by more than 1.5: then errors do not fall as a power of dt.
double slope(std::span<const double> errors) {
    const double middle = static_cast<double>(errors.size() - 1) / 2;
    double products = 0;
    double squares = 0;
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    for (std::size_t i = 0; i < errors.size(); ++i) {
        const double at = static_cast<double>(i) - middle;
        products -= at * std::log2(errors[i]);
        squares += at * at;
        if (i == 0) continue;
        const double local = std::log2(errors[i - 1] / errors[i]);
        least = std::min(least, local);
        most = std::max(most, local);
    }
    return most - least > 1.5 ? nan : products / squares;
}

/// Uses the five finest step sizes at which both errors exceed 100 × the round-off of the steps.
MeasuredOrder measure_order(const Method& method, Damping damping, const Problem& problem,
                            Precision precision) {
    constexpr std::size_t sizes = 5;
    constexpr std::int64_t most_steps = 1 << 13;
    std::vector<double> positions;
    std::vector<double> velocities;
    for (std::int64_t steps = 4; steps <= most_steps; steps *= 2) {
        const Errors errors = errors_after_a_second(method, damping, problem, precision, steps);
        const double floor = 100 * round_off(precision) * std::sqrt(static_cast<double>(4 * steps));
        if (errors.position < floor || errors.velocity < floor) break;
        positions.push_back(errors.position);
        velocities.push_back(errors.velocity);
    }
    MeasuredOrder order{
        .problem = problem.name, .precision = precision, .claimed = problem.order(method, damping)};
    order.exact = positions.empty();
    if (positions.size() < sizes) return order;
    order.position = slope(std::span(positions).last(sizes));
    order.velocity = slope(std::span(velocities).last(sizes));
    return order;
}

}  // namespace

std::vector<MeasuredOrder> measure_orders(const Method& method, Damping damping) {
    std::vector<MeasuredOrder> orders;
    for (const Problem& problem : problems())
        for (const Precision precision : {Precision::double_, Precision::extended})
            if (problem.linear || method.order != exact_order)
                orders.push_back(measure_order(method, damping, problem, precision));
    return orders;
}

}  // namespace oiler::certify
