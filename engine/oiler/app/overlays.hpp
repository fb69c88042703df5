// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "oiler/app/verdict.hpp"
#include "oiler/picture/picture.hpp"

namespace oiler {

/// Adds what the loop does at the moment, such as a pause, at the lower right; nothing if empty.
void add_status(Picture& picture, std::string status);

[[nodiscard]] Colour colour_of(Verdict::Grade grade);

/// Adds a line across the top, with a mark in the colour of its grade.
void add_verdict(Picture& picture, const Verdict& verdict);

/// Adds a sheet that says why the run ended, and which keys are left.
void add_failure(Picture& picture, const std::string& why, bool has_past);

}  // namespace oiler
