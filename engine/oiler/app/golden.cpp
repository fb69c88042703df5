// SPDX-License-Identifier: MIT
#include "oiler/app/golden.hpp"

#include <fmt/core.h>

#include <system_error>
#include <utility>

#include "oiler/capture/file.hpp"
#include "oiler/compare/captures/comparison.hpp"
#include "oiler/compare/captures/differences.hpp"
#include "oiler/core/error.hpp"
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

void move_file(const fs::path& from, const fs::path& to) {
    std::error_code error;
    fs::rename(from, to, error);
    if (error)
        fail(Exit::io, "cannot write {}: {}; run --update-golden again", to.string(),
             error.message());
}

}  // namespace

Exit compare_with_golden(const Options& options, const std::vector<BudgetEntry>& budget) {
    const Comparison comparison = compare_captures(options.golden, options.out, {});
    std::string text = describe(comparison);
    text.pop_back();
    remark(options.quiet && comparison.passed(), "{}", text);
    if (!options.junit.empty()) write_file(options.junit, junit_of(comparison, budget));
    const fs::path folder = differences_folder(options.out);
    write_differences(comparison, folder);
    if (comparison.passed()) return Exit::done;
    say("differences: " + (folder / "index.html").string());
    say("If the change is intended, write the golden again with --update-golden.");
    return Exit::comparison_failed;
}

fs::path folder_of_new_golden(const fs::path& golden) {
    fs::path folder = fs::absolute(golden).lexically_normal();
    if (!folder.has_filename()) folder = folder.parent_path();
    return folder.parent_path() / fmt::format(".{}.new", folder.filename().string());
}

GoldenUpdate::GoldenUpdate(const fs::path& golden, const std::string& scene)
    : golden_(golden, scene), captured_(folder_of_new_golden(golden)) {}

GoldenUpdate::~GoldenUpdate() {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(captured_, ignored))
        if (is_capture_file(entry.path().filename().string())) fs::remove(entry.path(), ignored);
    fs::remove(captured_, ignored);
}

void GoldenUpdate::commit() {
    golden_.clear();
    std::error_code error;
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(captured_, error))
        files.push_back(entry.path());
    for (const fs::path& file : files)
        if (is_capture_file(file.filename().string()) && file.filename() != manifest_name)
            move_file(file, golden_.file(file.filename().string()));
    move_file(captured_ / manifest_name, golden_.file(manifest_name));
}

}  // namespace oiler
