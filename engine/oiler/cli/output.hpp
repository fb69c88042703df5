// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/core.h>

#include <cmath>
#include <string>

#include "oiler/capture/file.hpp"
#include "oiler/core/json.hpp"
#include "oiler/core/utf8.hpp"
#include "oiler/physics/methods/methods.hpp"

namespace oiler::cli {

// Texts of the commands, and the numbers in their tables and JSON.

/// Writes text, not data, to standard output, see for_terminal(). Throws Error{io}.
inline void print(const std::string& text) { write_file("-", for_terminal(text)); }
/// Throws Error{io}.
inline void write_json(const std::filesystem::path& path, const Json& json) {
    write_file(path, json.dump(2) + "\n", kinds::json);
}

[[nodiscard]] inline std::string order_text(int order) {
    return order == exact_order ? "exact" : fmt::format("{}", order);
}

[[nodiscard]] inline const char* yes_or_no(bool yes) { return yes ? "yes" : "no"; }

/// Formats a limit of ω·dt in ten digits: "none" for 0, "all" for infinity.
[[nodiscard]] inline std::string limit_text(double limit) {
    if (limit == 0) return "none";
    return std::isinf(limit) ? "all" : fmt::format("{:.10g}", limit);
}

/// Formats a measured value, "-" for NaN.
[[nodiscard]] inline std::string cell(double value, const char* format) {
    return std::isnan(value) ? "-" : fmt::format(fmt::runtime(format), value);
}

/// JSON has no infinity and no NaN: they become "infinite" and null.
[[nodiscard]] inline Json number(double value) {
    if (std::isnan(value)) return nullptr;
    if (std::isinf(value)) return "infinite";
    return value;
}

}  // namespace oiler::cli
