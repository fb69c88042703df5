// SPDX-License-Identifier: MIT
// Asks `oiler advise` about random scenes, steps what it advises, and compares that with a motion
// that no code of the engine computes. Exits with 1 if an advice is wrong.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <map>

#include "oiler/core/error.hpp"
#include "trap/traps.hpp"
#include "trap/truth.hpp"

using namespace oiler;
using namespace oiler::trap;

namespace {

struct Options {
    std::uint64_t count = 300;
    std::uint64_t seed = 1;
    std::optional<std::uint64_t> only{};
    Program program{};
    bool shows = false;  ///< prints the scene files
    bool self_check = false;
    bool obstacles = false;
};

/// The verdicts of each kind of scene, and the slowest answer.
struct Tally {
    std::map<std::string, std::array<int, verdict_count>> of_kind{};
    std::array<int, verdict_count> total{};
    double slowest = 0;
    std::uint64_t slowest_seed = 0;

    void add(std::uint64_t seed, const Trap& trap, const Answer& answer, Verdict verdict) {
        ++of_kind[trap.kind][static_cast<std::size_t>(verdict)];
        ++total[static_cast<std::size_t>(verdict)];
        if (answer.seconds > slowest) {
            slowest = answer.seconds;
            slowest_seed = seed;
        }
    }
    [[nodiscard]] bool is_clean() const {
        for (std::size_t i = 0; i < verdict_count; ++i)
            if (is_failure(static_cast<Verdict>(i)) && total[i] > 0) return false;
        return true;
    }
};

void run(std::uint64_t seed, const Options& options, Tally& tally) {
    const auto kinds = obstacle_kinds();
    const Kind& kind = options.obstacles ? kinds[seed % kinds.size()] : trap::kind_of(seed);
    const Trap trap = make_trap(seed, kind, options.program.plain);
    if (options.shows) fmt::print("{}", trap.text);
    fmt::print("{:>5} {:<14} {} bodies {:.3g} s  extent {:.3g} m  {}\n", seed, trap.kind,
               trap.truth->size(), trap.scene.duration, trap.extent, trap.question.options());
    std::fflush(stdout);
    const Answer answer = ask(options.program, trap.text, trap.question);
    const Judgement judgement = judge(trap, answer);
    fmt::print("      {} in {:.2f} s: {}\n", name_of(judgement.verdict), answer.seconds,
               judgement.words);
    std::fflush(stdout);
    tally.add(seed, trap, answer, judgement.verdict);
}

void print_row(const std::string& name, const std::array<int, verdict_count>& counts) {
    fmt::print("{:<16}", name);
    for (const int count : counts) fmt::print("{:>14}", count);
    fmt::print("\n");
}

void print(const Tally& tally) {
    fmt::print("\n{:<16}", "");
    for (std::size_t i = 0; i < verdict_count; ++i)
        fmt::print("{:>14}", name_of(static_cast<Verdict>(i)));
    fmt::print("\n");
    for (const auto& [kind, counts] : tally.of_kind) print_row(kind, counts);
    print_row("all", tally.total);
    fmt::print("slowest advice: {:.2f} s, seed {}\n", tally.slowest, tally.slowest_seed);
}

void declare(CLI::App& app, Options& options) {
    app.add_option("--count", options.count, "number of scenes");
    app.add_option("--seed", options.seed, "seed of the first scene; the others follow");
    app.add_option("--only", options.only, "the scene of this seed alone, with its file");
    app.add_option("--oiler", options.program.path, "the program to ask");
    app.add_option("--patience", options.program.patience, "longest wait for an advice, s");
    app.add_flag("--plain", options.program.plain,
                 "without --at-steps and --display; step_error and damping may be missing");
    app.add_flag("--obstacles", options.obstacles, "scenes with obstacles alone");
    app.add_flag("--self-check", options.self_check, "check the true motions alone");
}

bool run(const Options& options) {
    Tally tally;
    if (options.only) {
        run(*options.only, options, tally);
    } else {
        for (std::uint64_t i = 0; i < options.count; ++i) run(options.seed + i, options, tally);
    }
    print(tally);
    return tally.is_clean();
}

}  // namespace

int main(int argc, char** argv) try {
    CLI::App app("Checks the advice of `oiler advise` with random scenes");
    Options options;
    declare(app, options);
    CLI11_PARSE(app, argc, argv);
    options.shows = options.only.has_value();
    if (options.self_check) return self_check(options.seed) ? 0 : 1;
    return run(options) ? 0 : 1;
} catch (const Error& error) {
    fmt::print(stderr, "oiler_trap: {}\n", error.what());
    return static_cast<int>(error.exit());
}
