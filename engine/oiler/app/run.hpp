// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include "oiler/app/game.hpp"
#include "oiler/core/error.hpp"

namespace oiler {

using MakeGame = std::function<std::unique_ptr<AnyGame>(const Settings&)>;

/// What every main does around its program: an Error becomes a line on standard error, with the
/// name, and its exit code.
int guard_main(std::string_view name, const std::function<Exit()>& program);

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
