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

/// Adds a sheet that says what happened, and what is left to do.
void add_notice(Picture& picture, const std::string& text, const std::string& remedy);

}  // namespace oiler
