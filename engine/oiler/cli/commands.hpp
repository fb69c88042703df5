// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "oiler/core/error.hpp"
#include "oiler/core/size.hpp"
#include "oiler/physics/methods/methods.hpp"

namespace oiler {
namespace certify {}
namespace lab {}
}  // namespace oiler

namespace oiler::cli {

using namespace certify;
using namespace lab;

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

/// A scene that is measured, over its own duration unless another is given.
struct Measured {
    std::filesystem::path scene;
    double duration = 0;  ///< s; 0: the scene's own
    std::filesystem::path json;
    bool quiet = false;
};

/// Measures what every method costs at every rate and what it is wrong by.
struct TradeoffCommand {
    Measured measured;
    std::string methods = "all";
    std::int64_t max_rate = 0;  ///< 1/s; 0: see SweepPlan
    int shard = 1;
    int shards = 1;
    bool all = false;  ///< rows are printed
    std::filesystem::path out;
    Size size;
    Exit run() const;
};

/// Joins what the shards of a sweep wrote.
struct MergeCommand {
    std::vector<std::filesystem::path> parts;
    bool all = false;
    std::filesystem::path out;
    Size size;
    std::filesystem::path json;
    bool quiet = false;
    Exit run() const;
};

/// Finds the cheapest way to step a scene that is good enough; exit 1 where none is.
struct AdviseCommand {
    Measured measured;
    std::optional<double> position_error;  ///< m
    std::optional<double> energy_drift;
    std::optional<double> budget_us;  ///< per frame of 1/60 s
    std::int64_t min_rate = 1;        ///< 1/s
    std::string methods = "all";
    bool apply_it = false;
    Exit run() const;
};

/// Measures what a player notices at several rates.
struct RatesCommand {
    Measured measured;
    std::vector<std::int64_t> rates{20, 30, 50, 60, 100, 120, 144, 240};
    std::string methods;  ///< empty: the scene's own and the usual ones
    std::string body;     ///< name or number; empty: the one that swings most, or the first
    Exit run() const;
};

/// Holds scenes against their budgets; exit 1 where one is exceeded.
struct CheckCommand {
    std::vector<std::filesystem::path> scenes;
    std::filesystem::path junit;
    std::filesystem::path json;
    Exit run() const;
};

/// All that the lab has to say of a scene on one page.
struct ReportCommand {
    Measured measured;
    std::optional<double>
        position_error;  ///< m, to advise on; else the budget's, or 1e-3 of what moves
    std::optional<double> energy_drift;
    std::filesystem::path out;
    Exit run() const;
};

/// Plays the scene file that the words name, with the options of all games; `argv[0]` is "play".
Exit run_play(int argc, char** argv);

}  // namespace oiler::cli
