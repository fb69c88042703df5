// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include "oiler/app/game.hpp"
#include "oiler/core/error.hpp"

namespace oiler {

using MakeGame = std::function<std::unique_ptr<AnyGame>(const Settings&)>;

/// Runs the program of a main function and returns its exit code. An Error becomes a line on
/// standard error that starts with `name`. An interrupted program prints one, too, and its exit
/// code is Exit::interrupted whatever `program` returns: see Interrupt.
int guard_main(std::string_view name, const std::function<Exit()>& program);

/// Runs a game with the common options, see `--help`. Returns its exit code.
int run_program(int argc, char** argv, const About& about, const MakeGame& make);

/// The body of main: `return oiler::run<Hello>(argc, argv);`
template <class G>
int run(int argc, char** argv) {
    return run_program(argc, argv, G::about, [](const Settings& settings) {
        return std::make_unique<AnyGameOf<G>>(settings);
    });
}

}  // namespace oiler
