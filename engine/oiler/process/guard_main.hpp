// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string_view>

#include "oiler/core/error.hpp"

namespace oiler {

/// Runs the program of a main function and returns its exit code. An Error becomes a line on
/// standard error that starts with `name`. An interrupted program prints one, too, and its exit
/// code is Exit::interrupted whatever `program` returns: see Interrupt.
int guard_main(std::string_view name, const std::function<Exit()>& program);

}  // namespace oiler
