// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "oiler/core/error.hpp"
#include "oiler/core/size.hpp"
#include "oiler/sim/methods.hpp"

namespace oiler {

// The commands of the program `oiler`, one to a file. Files that are empty paths are not written,
// "-" is standard output. All throw Error; what they return is the program's exit code.

/// Prints the list of methods.
struct MethodsCommand {
    std::filesystem::path json;
    Exit run() const;
};

/// Measures methods, and fails where one is not what its table claims.
struct CertifyCommand {
    std::vector<const Method*> methods;
    std::optional<Damping> damping;
    std::int64_t steps = 1'000'000;  ///< of the long run
    std::filesystem::path json;
    bool quiet = false;
    Exit run() const;
};

/// Simulates where damped springs stay bounded, into stability.csv and stability.png.
struct StabilityCommand {
    std::vector<const Method*> methods;
    std::optional<Damping> damping;
    std::filesystem::path out;
    Size size;
    bool quiet = false;
    Exit run() const;
};

/// Draws the article's figures.
struct FiguresCommand {
    std::filesystem::path out;
    Size size;
    bool quiet = false;
    Exit run() const;
};

/// Measures what a scene pays for and what each part of it changes.
struct LedgerCommand {
    std::filesystem::path scene;
    std::int64_t steps = 0;  ///< at most; 0: as many as the scene's duration has
    std::filesystem::path json;
    bool quiet = false;
    Exit run() const;
};

/// Plays the scene file that the words name, with the options of all games; `argv[0]` is "play".
Exit run_play(int argc, char** argv);

}  // namespace oiler
