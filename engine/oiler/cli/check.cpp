// SPDX-License-Identifier: MIT
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "oiler/cli/measuring.hpp"
#include "oiler/cli/output.hpp"
#include "oiler/cli/shared_options.hpp"
#include "oiler/core/markup.hpp"
#include "oiler/lab/rates/budget.hpp"
#include "oiler/process/console.hpp"
#include "oiler/process/interrupt.hpp"
#include "oiler/scene/make_world.hpp"
#include "oiler/scene/read.hpp"
#include "oiler/sim/step_work.hpp"

namespace oiler::cli {

using namespace lab;

namespace {

struct CheckResult {
    std::string file;
    std::vector<std::string> warnings{};  ///< of the pre-flight
    std::string divergence{};             ///< empty if the run stays finite
    bool has_budget = false;
    std::vector<BudgetEntry> lines{};
    std::string error{};  ///< the reason why the check is impossible

    [[nodiscard]] bool kept() const {
        return divergence.empty() && std::ranges::all_of(lines, &BudgetEntry::kept);
    }
};

/// The reason why no number of a budget was checked, without an error.
std::string why_no_lines(const CheckResult& result) {
    return result.has_budget ? "[budget] not checked: the run diverges" : "no [budget]";
}

/// One test case for each number of a budget, one for the warnings of a scene and one for a run
/// that diverged. A scene without a budget is a skipped case, a budget without numbers a failed
/// one.
void add(JunitSuite& suite, const CheckResult& result) {
    using Outcome = JunitSuite::Outcome;
    if (!result.warnings.empty())
        suite.add(result.file, "preflight", Outcome::passed,
                  fmt::format("{}", fmt::join(result.warnings, "; ")));
    if (!result.divergence.empty())
        suite.add(result.file, "run", Outcome::failed, result.divergence);
    for (const BudgetEntry& line : result.lines)
        suite.add(result.file, line.name, line.kept ? Outcome::passed : Outcome::failed,
                  line.words);
    if (!result.lines.empty()) return;
    if (!result.error.empty())
        suite.add(result.file, "budget", Outcome::error, result.error);
    else
        suite.add(result.file, "budget", result.has_budget ? Outcome::failed : Outcome::skipped,
                  why_no_lines(result));
}

std::string to_junit(const std::vector<CheckResult>& all) {
    JunitSuite suite("oiler check");
    for (const CheckResult& result : all) add(suite, result);
    return suite.xml();
}

Json to_json(const std::vector<CheckResult>& all) {
    Json json = Json::array();
    for (const CheckResult& result : all) {
        Json entry{{"scene", result.file}, {"kept", result.kept()}, {"warnings", result.warnings}};
        if (result.lines.empty() && result.kept()) entry["kept"] = nullptr;
        if (!result.divergence.empty()) entry["diverged"] = result.divergence;
        if (!result.error.empty()) entry = {{"scene", result.file}, {"error", result.error}};
        for (const BudgetEntry& line : result.lines) {
            entry[line.name] = {
                {"measured", number(line.measured)}, {"budget", line.most}, {"kept", line.kept}};
            if (line.is_limit()) entry[line.name]["is_limit"] = true;
        }
        json.push_back(std::move(entry));
    }
    return json;
}

std::int64_t steps_of(const Scene& scene) {
    return static_cast<std::int64_t>(scene.duration *
                                     static_cast<double>(scene.stepping.rate.steps));
}

/// Throws Error{diverged} if the energy is not finite after all steps, at the first such tick.
void require_finite_energy(const World& end, World start) {
    if (std::isfinite(end.energy().total())) return;
    for (; start.tick() < end.tick(); start.step()) start.require_finite(start.energy());
    end.require_finite(end.energy());
}

/// Runs the scene for its duration. Returns the message of a divergence, or an empty text.
std::string find_divergence(World world, const Scene& scene, const std::string& file, bool quiet) {
    const World start = world;
    constexpr std::int64_t most_body_steps = 1'000'000;  // between two polls
    const std::int64_t steps = steps_of(scene);
    const auto count = static_cast<double>(steps);
    announce(quiet, file, count,
             count * StepWork(world.bodies()).seconds_per_step(*scene.stepping.method));
    Progress progress(quiet, "steps of " + file, steps);
    const std::int64_t stride =
        std::max<std::int64_t>(1, most_body_steps / static_cast<std::int64_t>(world.body_count()));
    try {
        for (std::int64_t done = 0; done < steps && !Interrupt::requested(); done += stride) {
            progress.show(done);
            world.step(std::min(steps - done, stride));
        }
        require_finite_energy(world, start);
    } catch (const Error& error) {
        if (error.exit() != Exit::diverged) throw;
        return error.what();
    }
    return {};
}

/// Turns an error of usage into a result, so that the other scenes are still checked.
CheckResult check(const std::filesystem::path& path, bool quiet) {
    CheckResult result{.file = path.string()};
    try {
        const Scene scene = read_scene(path.string());
        result.has_budget = !scene.budget.is_empty();
        World world = make_world(scene, Settings{scene.stepping});
        world.require_applicable();
        result.warnings = world.preflight();
        const bool may_be_unstable = !world.instabilities(steps_of(scene), 1).empty();
        result.divergence = find_divergence(std::move(world), scene, result.file, quiet);
        if (result.divergence.empty() && may_be_unstable && scene.budget.is_empty() &&
            is_unstable(scene, Settings{scene.stepping}, Interrupt::requested))
            result.divergence =
                "unstable: bodies move to more than 10 times the extent of the true motion";
        Percent percent(quiet, "of the reference of " + result.file);
        result.lines =
            check_budget(scene, Settings{scene.stepping}, Interrupt::requested, std::ref(percent));
    } catch (const Error& error) {
        if (error.exit() != Exit::usage) throw;
        if (!result.divergence.empty()) return result;
        const std::string message = error.what();
        result.error = message.starts_with(result.file)
                           ? message
                           : fmt::format("{}: {}", result.file, message);
    }
    return result;
}

/// `quiet`: failures only.
std::string text_of(const std::vector<CheckResult>& all, bool quiet) {
    std::string text;
    for (const CheckResult& result : all) {
        if (quiet && result.kept()) continue;
        for (const std::string& warning : result.warnings)
            text += fmt::format("{}: warning: {}\n", result.file, warning);
        if (!result.divergence.empty())
            text += fmt::format("{}: {}\n", result.file, result.divergence);
        if (result.lines.empty() && result.error.empty())
            text += fmt::format("{}: {}\n", result.file, why_no_lines(result));
        for (const BudgetEntry& line : result.lines)
            text += fmt::format("{}: {}\n", result.file, line.words);
    }
    return text;
}

/// An error outweighs a divergence, and that outweighs an exceeded budget.
Exit exit_of(const std::vector<CheckResult>& all) {
    Exit exit = Exit::done;
    for (const CheckResult& result : all) {
        if (!result.error.empty()) exit = Exit::usage;
        if (!result.divergence.empty() && exit != Exit::usage) exit = Exit::diverged;
        if (!result.kept() && exit == Exit::done) exit = Exit::comparison_failed;
    }
    return exit;
}

}  // namespace

struct CheckCommand {
    static constexpr CommandTexts texts{
        .name = "check",
        .summary = "Run scenes and check their [budget]: exit 1 if exceeded, 5 if a run diverges",
        .example = "assets/scenes/*.toml --junit budgets.xml"};

    std::vector<std::filesystem::path> scenes;
    std::filesystem::path junit;
    std::filesystem::path json;
    bool quiet = false;

    void declare(Arguments& arguments) {
        arguments.add_required("SCENE", scenes, "scene files");
        arguments.add_output("--junit", junit, "write the result as JUnit XML for CI, - for stdout",
                             kinds::junit);
        add_json(arguments, json);
        arguments.add_flag("--quiet", quiet, "print only scenes that fail");
    }

    [[nodiscard]] Exit run() const {
        std::vector<CheckResult> all;
        for (const std::filesystem::path& path : scenes) {
            const bool is_begun = !Interrupt::requested();
            if (is_begun) all.push_back(check(path, quiet));
            if (!Interrupt::requested()) continue;
            if (!Interrupt::by_time_limit()) return Exit::interrupted;
            if (is_begun) all.pop_back();
            all.push_back({.file = path.string(),
                           .error = fmt::format("{}: not checked to its end: {}", path.string(),
                                                Interrupt::reason())});
        }
        if (!junit.empty()) write_file(junit, to_junit(all), kinds::junit);
        if (!json.empty()) write_json(json, to_json(all));
        if (json != "-" && junit != "-") print(text_of(all, quiet));
        for (const CheckResult& result : all)
            if (!result.error.empty()) say("oiler: " + result.error);
        return exit_of(all);
    }
};

template Command make_command<CheckCommand>();

}  // namespace oiler::cli
