// SPDX-License-Identifier: MIT
#include "oiler/certify/certify.hpp"

#include <fmt/core.h>

#include <utility>

#include "oiler/stability/stability.hpp"

namespace oiler::certify {
namespace {

std::string wrong_order(const MeasuredOrder& order) {
    const std::string where = fmt::format("{} in {}", order.problem, name_of(order.precision));
    if (order.claimed == exact_order)
        return order.exact ? "" : fmt::format("{}: errors exceed round-off", where);
    if (order.exact)
        return fmt::format("{}: errors are only round-off, no order can be measured", where);
    if (!order.measured())
        return order.precision == Precision::extended
                   ? fmt::format("{}: errors do not fall as a power of dt, claimed {}", where,
                                 order.claimed)
                   : "";
    if (std::abs(order.slope() - order.claimed) <= 0.4) return "";
    return fmt::format("{}: positions fall as dt^{:.2f}, velocities as dt^{:.2f}, claimed {}",
                       where, order.position, order.velocity, order.claimed);
}

std::string wrong_property(std::string_view property, bool claimed, double defect) {
    // Far above round-off and the error of central differences, far below the defect of a method of
    // order 8 without the property.
    constexpr double none_left = 1e-13;
    if (claimed == (defect < none_left)) return "";
    return fmt::format("claimed {}{}, but the defect is {:.2g}", claimed ? "" : "not ", property,
                       defect);
}

std::string wrong_evaluations(const Certificate& certificate) {
    const int claimed = evaluations_with(*certificate.method, certificate.damping);
    if (claimed == 0 || std::abs(certificate.evaluations - claimed) < 0.01) return "";
    return fmt::format("{:.3f} force evaluations per step, claimed {}", certificate.evaluations,
                       claimed);
}

std::string wrong_limit(const Certificate& certificate) {
    if (certificate.limit_confirmed) return "";
    return fmt::format("runs do not confirm the limit ω·dt = {:.10g} of the step matrix",
                       certificate.limit);
}

std::string wrong_energy(const LongRun& run) {
    if (std::abs(run.trend - run.predicted) <= run.allowed) return "";
    return fmt::format("energy grows by {:.2g} per step over {} steps, expected {:.2g} ± {:.2g}",
                       run.trend, run.steps, run.predicted, run.allowed);
}

std::vector<std::string> failures_of(const Certificate& certificate) {
    const Method& method = *certificate.method;
    std::vector<std::string> found;
    const auto add = [&](std::string what) {
        if (!what.empty()) found.push_back(std::move(what));
    };
    for (const MeasuredOrder& order : certificate.orders) add(wrong_order(order));
    add(wrong_property("symplectic", method.symplectic, certificate.symplectic_defect));
    add(wrong_property("symmetric", method.symmetric, certificate.reversal_defect));
    add(wrong_evaluations(certificate));
    add(wrong_limit(certificate));
    add(wrong_energy(certificate.energy));
    return found;
}

}  // namespace

double slope_over_index(std::span<const double> values) {
    const double middle = static_cast<double>(values.size() - 1) / 2;
    double products = 0;
    double squares = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double at = static_cast<double>(i) - middle;
        products += at * values[i];
        squares += at * at;
    }
    return products / squares;
}

Certificate certify(const Method& method, Damping damping, std::int64_t steps) {
    const double limit = stability_limit(method, damping, {1, 0});
    Certificate certificate{.method = &method,
                            .damping = damping,
                            .orders = measure_orders(method, damping),
                            .symplectic_defect = symplectic_defect(method),
                            .reversal_defect = reversal_defect(method),
                            .evaluations = evaluations_per_step(method, damping, true),
                            .single_evaluations = evaluations_per_step(method, damping, false),
                            .limit = limit,
                            .limit_confirmed = confirm_limit(method, damping, limit),
                            .energy = run_long(method, damping, limit, steps),
                            .failures = {}};
    certificate.failures = failures_of(certificate);
    return certificate;
}

}  // namespace oiler::certify
