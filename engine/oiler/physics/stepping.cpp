// SPDX-License-Identifier: MIT
#include "oiler/physics/stepping.hpp"

#include <fmt/core.h>

#include <tuple>
#include <variant>

#include "oiler/core/json.hpp"
#include "oiler/math/vec.hpp"

namespace oiler {

std::string_view name_of(Precision precision) {
    if (precision == Precision::extended) return "long double";
    return precision == Precision::single ? "float" : "double";
}

std::optional<Precision> find_precision(std::string_view name) {
    for (const Precision precision : {Precision::single, Precision::double_})
        if (name_of(precision) == name) return precision;
    return std::nullopt;
}

Damping damping_of(const Stepping& stepping) {
    return stepping.damping.value_or(stepping.method->damping);
}

std::string_view damping_name(const Stepping& stepping) {
    return stepping.damping ? name_of(*stepping.damping) : "";
}

std::string describe(const Stepping& stepping) {
    return fmt::format("{} at {} Hz in {}{}{}", stepping.method->name, stepping.rate.steps,
                       name_of(stepping.precision), stepping.damping ? ", damping in the " : "",
                       damping_name(stepping));
}

std::string caption(const Stepping& stepping) {
    return fmt::format("{} at {} Hz, {}", stepping.method->name, stepping.rate.steps,
                       name_of(stepping.precision));
}

std::string table_text(const Stepping& stepping) {
    return fmt::format("{}, {} Hz, {}{}{}", stepping.method->name, stepping.rate.steps,
                       name_of(stepping.precision), stepping.damping ? ", " : "",
                       damping_name(stepping));
}

std::string short_text(const Stepping& stepping) {
    return fmt::format("{} Hz {}", stepping.rate.steps, stepping.method->name);
}

std::string difference_text(const Stepping& stepping, const Stepping& from) {
    std::string text;
    const auto add = [&](bool differs, std::string_view word) {
        if (differs) text.append(text.empty() ? "" : ", ").append(word);
    };
    add(stepping.method != from.method, stepping.method->name);
    add(stepping.rate != from.rate, fmt::format("{} Hz", stepping.rate.steps));
    add(stepping.precision != from.precision, name_of(stepping.precision));
    return text;
}

Json to_json(const Stepping& stepping) {
    const bool has_choice = std::holds_alternative<Splitting>(stepping.method->rule);
    return {{"method", stepping.method->name},
            {"rate", stepping.rate.steps},
            {"precision", name_of(stepping.precision)},
            {"damping", has_choice ? Json(name_of(damping_of(stepping))) : Json()}};
}

void keep_earlier(std::optional<Divergence>& first, const std::optional<Divergence>& other) {
    if (!other) return;
    const auto order = [](const Divergence& d) {
        return std::tuple(d.tick, d.row, d.of == Divergence::Of::velocity, d.axis);
    };
    if (!first || order(*other) < order(*first)) first = other;
}

std::string describe(const Divergence& at, const Method& method, const Rate& rate, bool linked,
                     const NameOfRow& name) {
    const std::string when =
        fmt::format("diverged at step {} (t = {:.6g} s)", at.tick, rate.time(at.tick));
    if (at.of == Divergence::Of::solution) {
        const std::string whose =
            linked ? "the linked bodies" : fmt::format("body {}", name(at.row));
        return fmt::format("{}: {} found no solution of the equations of {}", when, method.name,
                           whose);
    }
    if (at.of == Divergence::Of::impacts)
        return fmt::format("{}: body {} meets planes too often to follow it", when, name(at.row));
    return fmt::format("{}: {} {} of body {} is no longer finite", when,
                       at.of == Divergence::Of::velocity ? "velocity" : "position",
                       axis_names[static_cast<std::size_t>(at.axis)], name(at.row));
}

}  // namespace oiler
