// SPDX-License-Identifier: MIT
#include "oiler/certify/certify.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include "oiler/cli/output.hpp"
#include "oiler/cli/shared_options.hpp"
#include "oiler/process/console.hpp"
#include "oiler/process/interrupt.hpp"

namespace oiler::cli {

using namespace certify;

namespace {

/// Formats the measured orders of positions and velocities: "4.00/4.01".
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
        "{:>8} {:>8}  {}\n",
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

std::string certify_legend(std::int64_t steps) {
    return fmt::format(R"(
spring, orbit, damped, dragged: measured convergence orders of positions/velocities in long double.
forces: evaluations per step in a run; alone: evaluations of a step without reuse. MᵀJM−J:
symplectic defect, 0 for a symplectic method; reversal: defect of a step forward and back, 0 for a
symmetric method. stable ω·dt: stability limit of the step matrix, confirmed by runs at (1 ± 10⁻⁶)
times the limit. lowest, highest: extremes of the energy's relative change in a run of up to {}
steps at the ω·dt to their left; trend: relative growth per step of the quantity to conserve.
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
    const auto to_item = [](const MeasuredOrder& order) { return to_json(order); };
    return {{"method", certificate.method->name},
            {"damping", name_of(certificate.damping)},
            {"orders", Json::list(certificate.orders, to_item)},
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

struct Results {
    Json certificates = Json::array();
    std::string failures;  ///< a line each
};

}  // namespace

struct CertifyCommand {
    static constexpr CommandTexts texts{
        .name = "certify",
        .summary = "Measure each method's properties; exit 1 if one misses its claims",
        .example = "velocity_verlet rk4"};

    MethodOptions chosen;
    std::int64_t steps = 1'000'000;  ///< of the long run
    std::filesystem::path json;
    bool quiet = false;

    void declare(Arguments& arguments) {
        chosen.declare(arguments);
        arguments.add_integer("--steps", steps, 1000, 1'000'000'000,
                              "steps of the long run for energy, 1000000 if not given");
        add_json(arguments, json);
        add_quiet(arguments, quiet);
    }

    [[nodiscard]] bool has_table() const { return json != "-"; }

    /// Returns fewer certificates when interrupted.
    [[nodiscard]] Results measure(const std::vector<const Method*>& methods) const {
        // A table on the terminal shows the progress itself.
        Progress progress(quiet || (has_table() && isatty(STDOUT_FILENO) == 1), "methods",
                          static_cast<std::int64_t>(methods.size()));
        Results results;
        for (const Method* method : methods) {
            if (Interrupt::requested()) break;
            const Certificate certificate =
                certify::certify(*method, chosen.damping_of(*method), steps);
            results.certificates.push_back(to_json(certificate));
            if (has_table()) print(row_of(certificate));
            progress.show(static_cast<std::int64_t>(results.certificates.size()));
            for (const std::string& failure : certificate.failures)
                results.failures += fmt::format("{}: {}\n", method->name, failure);
        }
        return results;
    }

    [[nodiscard]] Exit run() const {
        const std::vector<const Method*> methods = chosen.methods();
        if (has_table()) print(header());
        Results results = measure(methods);
        if (Interrupt::requested() && !Interrupt::by_time_limit()) return Exit::interrupted;
        if (has_table()) print(certify_legend(steps));
        if (!json.empty()) write_json(json, results.certificates);
        if (results.failures.empty()) return Exit::done;
        results.failures.pop_back();
        say(results.failures);
        return Exit::comparison_failed;
    }
};

template Command make_command<CertifyCommand>();

}  // namespace oiler::cli
