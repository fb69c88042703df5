// SPDX-License-Identifier: MIT
#include "oiler/process/guard_main.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <new>
#include <string>

#include "oiler/core/floating_point.hpp"
#include "oiler/process/console.hpp"
#include "oiler/process/interrupt.hpp"

namespace oiler {
namespace {

struct Ending {
    Exit exit = Exit::done;
    std::string error{};  ///< a line without the program's name; empty: none
};

/// Names of files and options may have line breaks.
std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

Ending ending_of(std::string_view name, const std::function<Exit()>& program) {
    try {
        fill_closed_streams();
        Interrupt::handle_signals(name);
        require_ieee_arithmetic();
        return {program()};
    } catch (const Error& error) {
        return {error.exit(), error.what()};
    } catch (const std::bad_alloc&) {
        return {Exit::io, "not enough memory; take fewer bodies or a shorter time"};
    }
}

}  // namespace

int guard_main(std::string_view name, const std::function<Exit()>& program) {
    Ending ending = ending_of(name, program);
    if (Interrupt::requested())
        ending = {Exit::interrupted,
                  "interrupted" + (ending.error.empty() ? "" : ": " + ending.error)};
    if (!ending.error.empty()) say(fmt::format("{}: {}", name, one_line(ending.error)));
    return static_cast<int>(ending.exit);
}

}  // namespace oiler
