// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <iterator>

#include "oiler/cli/output.hpp"
#include "oiler/cli/shared_options.hpp"
#include "oiler/stability/stability.hpp"

namespace oiler::cli {
namespace {

constexpr Oscillation undamped{1, 0};

constexpr const char* methods_legend = R"(
order: convergence order of positions and velocities when forces depend on position alone.
damped: order with linear damping. dragged: order with quadratic drag, or damping along a spring.
forces: evaluations per step; a reused last evaluation counts once. stable ω·dt: undamped springs
stay bounded below this limit, ω = √(k/m). `oiler certify` measures all of these properties.
)";

std::string evaluations(const Method& method) {
    return method.evaluations > 0 ? fmt::format("{}", method.evaluations) : "solves";
}

std::string table() {
    std::string text = fmt::format("{:<31} {:>5} {:>6} {:>7} {:>6}  {:<10} {:<9} {:>12}  {}\n",
                                   "method", "order", "damped", "dragged", "forces", "symplectic",
                                   "symmetric", "stable ω·dt", "source");
    const auto out = std::back_inserter(text);
    for (const Method& method : methods()) {
        const double limit = stability_limit(method, method.damping, undamped);
        fmt::format_to(
            out, "{:<31} {:>5} {:>6} {:>7} {:>6}  {:<10} {:<9} {:>12}  {}\n", method.name,
            order_text(method.order), order_text(damped_order(method, method.damping)),
            method.order == exact_order ? "-" : order_text(dragged_order(method, method.damping)),
            evaluations(method), yes_or_no(method.symplectic), yes_or_no(method.symmetric),
            limit_text(limit), method.source);
    }
    return text + methods_legend;
}

Json to_json() {
    return Json::list(methods(), [](const Method& method) -> Json {
        const bool exact = method.order == exact_order;
        const auto order = [](int of) { return of == exact_order ? Json("exact") : Json(of); };
        return {
            {"name", method.name},
            {"order", order(method.order)},
            {"damped_order", order(damped_order(method, method.damping))},
            {"dragged_order", exact ? Json(nullptr) : order(dragged_order(method, method.damping))},
            {"evaluations", method.evaluations > 0 ? Json(method.evaluations) : Json(nullptr)},
            {"symplectic", method.symplectic},
            {"symmetric", method.symmetric},
            {"damping", name_of(method.damping)},
            {"stability_limit", number(stability_limit(method, method.damping, undamped))},
            {"source", method.source}};
    });
}

}  // namespace

struct MethodsCommand {
    static constexpr CommandTexts texts{.name = "methods",
                                        .summary = "List the integration methods",
                                        .example = "--json methods.json",
                                        .may_take_long = false};

    std::filesystem::path json;

    void declare(Arguments& arguments) { add_json(arguments, json); }

    [[nodiscard]] Exit run() const {
        if (!json.empty()) write_json(json, to_json());
        if (json != "-") print(table());
        return Exit::done;
    }
};

template Command make_command<MethodsCommand>();

}  // namespace oiler::cli
