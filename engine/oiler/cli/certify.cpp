// SPDX-License-Identifier: MIT
#include "oiler/certify/certify.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include "oiler/app/console.hpp"
#include "oiler/cli/commands.hpp"
#include "oiler/cli/tables.hpp"

namespace oiler::cli {
namespace {

/// "4.00/4.01", of positions and velocities.
std::string slopes(const Certificate& certificate, std::string_view problem) {
    for (const MeasuredOrder& order : certificate.orders) {
        if (order.problem != problem || order.precision != Precision::extended) continue;
        if (order.exact) return "exact";
        return fmt::format("{:.2f}/{:.2f}", order.position, order.velocity);
    }
    return "-";
}

template <class... Cells>
std::string row(const Cells&... cells) {
    return fmt::format(
        "{:<31} {:>5}  {:>9} {:>9} {:>9} {:>9}  {:>7} {:>7}  {:>8} {:>8}  {:>12}  {:>5} {:>8} "
        "{:>8} "
        "{:>8}  {}\n",
        cells...);
}

std::string header() {
    return row("method", "order", "spring", "orbit", "damped", "dragged", "forces", "alone",
               "MᵀJM−J", "reversal", "stable ω·dt", "ω·dt", "lowest", "highest", "trend", "");
}

std::string row_of(const Certificate& certificate) {
    const LongRun& run = certificate.energy;
    const auto small = [](double number) { return fmt::format("{:.1e}", number); };
    return row(certificate.method->name, order_text(certificate.method->order),
               slopes(certificate, "spring"), slopes(certificate, "orbit"),
               slopes(certificate, "damped spring"), slopes(certificate, "fall with drag"),
               fmt::format("{:.3f}", certificate.evaluations),
               fmt::format("{:.3f}", certificate.single_evaluations),
               small(certificate.symplectic_defect), small(certificate.reversal_defect),
               limit_text(certificate.limit), fmt::format("{:.3g}", run.omega_dt),
               small(run.lowest - 1), small(run.highest - 1), small(run.trend),
               certificate.failures.empty() ? "ok" : "FAILS");
}

std::string legend(std::int64_t steps) {
    return fmt::format(R"(
spring, orbit, damped, dragged: slopes of the errors of positions/velocities over dt, in long
double. forces: evaluations per step in a run; alone: where nothing is left of the step before.
MᵀJM−J: 0 for a symplectic step; reversal: 0 where stepping back retraces the way. stable ω·dt: by
the step matrix, and confirmed by runs 10⁻⁶ on both sides of it. lowest, highest: energy less that
at the start, over it, in a run of up to {} steps at the ω·dt before them; trend: relative
growth per step of what the method should conserve.
)",
                       steps);
}

Json to_json(const MeasuredOrder& order) {
    return {{"problem", order.problem},
            {"precision", name_of(order.precision)},
            {"claimed", order.claimed == exact_order ? Json("exact") : Json(order.claimed)},
            {"exact", order.exact},
            {"position", number(order.position)},
            {"velocity", number(order.velocity)}};
}

Json to_json(const Certificate& certificate) {
    const LongRun& run = certificate.energy;
    Json orders = Json::array();
    for (const MeasuredOrder& order : certificate.orders) orders.push_back(to_json(order));
    return {{"method", certificate.method->name},
            {"damping", name_of(certificate.damping)},
            {"orders", orders},
            {"symplectic", certificate.method->symplectic},
            {"symplectic_defect", number(certificate.symplectic_defect)},
            {"symmetric", certificate.method->symmetric},
            {"reversal_defect", number(certificate.reversal_defect)},
            {"evaluations", certificate.evaluations},
            {"single_evaluations", certificate.single_evaluations},
            {"stability_limit", number(certificate.limit)},
            {"stability_limit_confirmed", certificate.limit_confirmed},
            {"energy",
             {{"steps", run.steps},
              {"omega_dt", run.omega_dt},
              {"lowest", run.lowest},
              {"highest", run.highest},
              {"trend", number(run.trend)},
              {"predicted", run.predicted},
              {"allowed", run.allowed}}},
            {"failures", certificate.failures}};
}

void print(const std::string& text) { write_file("-", std::as_bytes(std::span(text))); }

}  // namespace

Exit CertifyCommand::run() const {
    const bool table = json != "-";
    Json certificates = Json::array();
    std::string failures;
    Progress progress(quiet || (table && isatty(STDOUT_FILENO) == 1), "methods",
                      static_cast<std::int64_t>(methods.size()));
    if (table) print(header());
    for (const Method* method : methods) {
        const Certificate certificate = certify::certify(*method, damping.value_or(method->damping), steps);
        certificates.push_back(to_json(certificate));
        if (table) print(row_of(certificate));
        progress.show(static_cast<std::int64_t>(certificates.size()));
        for (const std::string& failure : certificate.failures)
            failures += fmt::format("{}: {}\n", method->name, failure);
    }
    if (table) print(legend(steps));
    if (!json.empty()) write_json(json, certificates);
    if (failures.empty()) return Exit::done;
    failures.pop_back();
    say(failures);
    return Exit::comparison_failed;
}

}  // namespace oiler::cli
