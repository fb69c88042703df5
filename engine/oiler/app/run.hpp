// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "oiler/game/game.hpp"

namespace oiler {

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
