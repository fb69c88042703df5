// SPDX-License-Identifier: MIT
#include "oiler/sim/methods.hpp"

#include <algorithm>
#include <array>

#include "oiler/core/error.hpp"

namespace oiler {
namespace {

constexpr std::array<long double, 0> none{};
constexpr std::array one{1.0L};
constexpr std::array zero{0.0L};
constexpr std::array kick_then_drift{Stage{Move::kick, 1.0L}, Stage{Move::drift, 1.0L}};

constexpr std::array list{
    Method{.name = "explicit_euler",
           .order = 1,
           .evaluations = 1,
           .symplectic = false,
           .rule = Tableau{.a = none, .b = one, .c = zero},
           .source = "Euler, Institutionum calculi integralis I, 1768, §650"},
    Method{.name = "semi_implicit_euler",
           .order = 1,
           .evaluations = 1,
           .symplectic = true,
           .rule = Splitting{kick_then_drift},
           .source = "Fiedler, Integration Basics, 2004; symplectic: de Vogelaere 1956"},
};

constexpr bool fits(const Splitting& rule) { return rule.stages.size() <= Splitting::most_stages; }

constexpr bool fits(const Tableau& rule) {
    const std::size_t stages = rule.b.size();
    return stages <= Tableau::most_stages && rule.c.size() == stages &&
           rule.a.size() == stages * (stages - 1) / 2;
}

static_assert(std::ranges::all_of(list, [](const Method& method) {
    return std::visit([](const auto& rule) { return fits(rule); }, method.rule);
}));

}  // namespace

std::span<const Method> methods() { return list; }

const Method& find_method(std::string_view name) {
    for (const Method& method : list)
        if (method.name == name) return method;
    fail(Exit::usage, "method {}: no such method; choose one of: {}", name, method_names());
}

std::string method_names() {
    std::string names;
    for (const Method& method : list) names.append(names.empty() ? "" : ", ").append(method.name);
    return names;
}

}  // namespace oiler
