// SPDX-License-Identifier: MIT
#include "oiler/app/golden.hpp"

#include <fmt/core.h>

#include <system_error>
#include <utility>

#include "oiler/capture/file.hpp"
#include "oiler/compare/captures/comparison.hpp"
#include "oiler/compare/captures/differences.hpp"
#include "oiler/core/error.hpp"
#include "oiler/core/markup.hpp"
#include "oiler/process/console.hpp"

namespace oiler {
namespace {

namespace fs = std::filesystem;

std::string junit_of(const Comparison& comparison, const std::vector<BudgetEntry>& budget) {
    JunitSuite suite = suite_of(comparison);
    for (const BudgetEntry& entry : budget)
        suite.add("[budget]", entry.name,
                  entry.kept ? JunitSuite::Outcome::passed : JunitSuite::Outcome::failed,
                  entry.words);
    return suite.xml();
}

}  // namespace

Exit compare_with_golden(const Options& options, const std::vector<BudgetEntry>& budget) {
    const Comparison comparison = compare_captures(options.golden, options.out, {});
    std::string text = describe(comparison);
    text.pop_back();
    remark(options.quiet && comparison.passed(), "{}", text);
    if (!options.junit.empty())
        write_file(options.junit, junit_of(comparison, budget), kinds::junit);
    const fs::path folder = differences_folder(options.out);
    write_differences(comparison, folder);
    if (comparison.passed()) return Exit::done;
    say("differences: " + (folder / "index.html").string());
    say("If the change is intended, write the golden again with --update-golden.");
    return Exit::comparison_failed;
}

void write_junit_of_failure(const Options& options, Exit exit, std::string_view reason) {
    using Outcome = JunitSuite::Outcome;
    const bool failed = exit == Exit::diverged || exit == Exit::comparison_failed;
    JunitSuite suite("oiler compare");
    suite.add(options.golden.string(), "run", failed ? Outcome::failed : Outcome::error, reason);
    write_file(options.junit, suite.xml(), kinds::junit);
}

GoldenUpdate::GoldenUpdate(const fs::path& golden, const std::string& scene)
    : golden_(golden, scene) {}

void GoldenUpdate::commit() {
    commit_failed_ = true;
    golden_.replace();
    commit_failed_ = false;
}

GoldenUpdate::~GoldenUpdate() {
    if (commit_failed_) return;
    const fs::path captured = folder_of_new(golden_.path());
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(captured, ignored))
        if (is_capture_file(entry.path().filename().string())) fs::remove(entry.path(), ignored);
    fs::remove(captured, ignored);
}

}  // namespace oiler
