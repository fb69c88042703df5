// SPDX-License-Identifier: MIT
#include "oiler/physics/stepping.hpp"

#include <fmt/core.h>

#include <variant>

#include "oiler/core/json.hpp"

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

}  // namespace oiler
