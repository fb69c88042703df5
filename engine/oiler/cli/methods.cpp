// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <cmath>
#include <iterator>
#include <span>

#include "oiler/capture/file.hpp"
#include "oiler/cli/commands.hpp"
#include "oiler/cli/tables.hpp"
#include "oiler/stability/stability.hpp"

namespace oiler::cli {
namespace {

constexpr Oscillation undamped{1, 0};

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
    text +=
        "\norder: of the error of positions and velocities as dt shrinks, where forces depend on\n"
        "position alone; damped: with linear damping; dragged: with quadratic drag, or damping "
        "along\n"
        "a spring. forces: evaluations per step, where the last one serves the next step's first.\n"
        "stable: undamped springs are bounded while ω·dt is below; ω = √(k/m). What is listed "
        "here\n"
        "is measured by `oiler certify`.\n";
    return text;
}

Json to_json() {
    Json list = Json::array();
    for (const Method& method : methods()) {
        const bool exact = method.order == exact_order;
        const auto order = [](int of) { return of == exact_order ? Json("exact") : Json(of); };
        list.push_back(
            {{"name", method.name},
             {"order", order(method.order)},
             {"damped_order", order(damped_order(method, method.damping))},
             {"dragged_order",
              exact ? Json(nullptr) : order(dragged_order(method, method.damping))},
             {"evaluations", method.evaluations > 0 ? Json(method.evaluations) : Json(nullptr)},
             {"symplectic", method.symplectic},
             {"symmetric", method.symmetric},
             {"damping", name_of(method.damping)},
             {"stability_limit", number(stability_limit(method, method.damping, undamped))},
             {"source", method.source}});
    }
    return list;
}

}  // namespace

Exit MethodsCommand::run() const {
    if (!json.empty()) write_json(json, to_json());
    if (json != "-") {
        const std::string text = table();
        write_file("-", std::as_bytes(std::span(text)));
    }
    return Exit::done;
}

}  // namespace oiler::cli
