// SPDX-License-Identifier: MIT
#include "oiler/app/golden.hpp"

#include "oiler/app/console.hpp"
#include "oiler/capture/file.hpp"
#include "oiler/compare/comparer.hpp"
#include "oiler/compare/differences.hpp"

namespace oiler {

Exit compare_with_golden(const Options& options) {
    const Comparison comparison = compare_captures(options.golden, options.out, {});
    const std::filesystem::path folder = differences_folder(options.out);
    write_differences(comparison, folder);
    if (!options.junit.empty()) write_file(options.junit, junit_of(comparison));
    std::string text = describe(comparison);
    text.pop_back();
    remark(options.quiet && comparison.passed(), "{}", text);
    if (comparison.passed()) return Exit::done;
    say("differences: " + (folder / "index.html").string());
    return Exit::comparison_failed;
}

}  // namespace oiler
