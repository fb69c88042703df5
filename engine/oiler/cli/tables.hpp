// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/core.h>

#include <cmath>
#include <filesystem>
#include <span>
#include <string>

#include "oiler/capture/file.hpp"
#include "oiler/core/json.hpp"
#include "oiler/physics/methods/methods.hpp"

namespace oiler::cli {

// How the commands write numbers of methods.

[[nodiscard]] inline std::string order_text(int order) {
    return order == exact_order ? "exact" : fmt::format("{}", order);
}

[[nodiscard]] inline const char* yes_or_no(bool yes) { return yes ? "yes" : "no"; }

/// Of ω·dt: ten digits, "none" for 0, "all" for infinity.
[[nodiscard]] inline std::string limit_text(double limit) {
    if (limit == 0) return "none";
    return std::isinf(limit) ? "all" : fmt::format("{:.10g}", limit);
}

/// JSON has no infinity: "infinite", and null for what is not a number.
[[nodiscard]] inline Json number(double value) {
    if (std::isnan(value)) return nullptr;
    if (std::isinf(value)) return "infinite";
    return value;
}

inline void write_json(const std::filesystem::path& path, const Json& json) {
    const std::string text =
        json.dump(2) + "\n";
    write_file(path, std::as_bytes(std::span(text)));
}

}  // namespace oiler::cli
