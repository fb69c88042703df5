// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>

#include "oiler/app/game.hpp"

namespace oiler {

using MakeGame = std::function<std::unique_ptr<AnyGame>(const Settings&)>;

/// Runs a program with the common options, see `--help`; returns its exit code.
int run_program(int argc, char** argv, const About& about, const MakeGame& make);

/// All of main: `return oiler::run<Hello>(argc, argv);`
template <class G>
int run(int argc, char** argv) {
    return run_program(argc, argv, G::about, [](const Settings& settings) {
        return std::make_unique<AnyGameOf<G>>(settings);
    });
}

}  // namespace oiler
