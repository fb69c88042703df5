// SPDX-License-Identifier: MIT
#include "oiler/capture/capture_folder.hpp"
#include "oiler/cli/arguments.hpp"
#include "oiler/cli/output.hpp"
#include "oiler/cli/shared_options.hpp"
#include "oiler/compare/captures/comparison.hpp"
#include "oiler/compare/captures/differences.hpp"

namespace oiler::cli {

struct CompareCommand {
    static constexpr CommandTexts texts{
        .name = "compare",
        .summary = "Compare two captures frame by frame and name the cause of a change",
        .example = "tests/golden/spring frames/spring --junit frames/spring.xml"};

    std::filesystem::path golden;
    std::filesystem::path actual;
    std::filesystem::path out;
    std::filesystem::path junit;
    std::filesystem::path json;
    std::int64_t channel = PixelTolerance{}.channel;
    std::int64_t percent = 1;

    void declare(Arguments& arguments) {
        arguments.add_required("GOLDEN", golden, "folder with the expected frames",
                               is_capture_file);
        arguments.add_required("ACTUAL", actual, "folder with the frames to check",
                               is_capture_file);
        arguments.add_output_folder(
            "--out", out, is_differences_file,
            "folder for the page of differences, ACTUAL-differences if not given");
        arguments.add_integer("--most-difference", channel, 0, 255,
                              "largest difference of a channel of a pixel, 2 if not given");
        arguments.add_integer("--most-pixels", percent, 0, 100,
                              "largest share of differing pixels in percent, 1 if not given");
        arguments.add_output("--junit", junit, "write the result as JUnit XML for CI, - for stdout",
                             kinds::junit);
        add_json(arguments, json);
    }

    [[nodiscard]] Exit run() const {
        const PixelTolerance tolerance{static_cast<int>(channel),
                                       static_cast<double>(percent) / 100};
        const Comparison comparison = compare_captures(golden, actual, tolerance);
        const std::filesystem::path folder = out.empty() ? differences_folder(actual) : out;
        const bool prints = json != "-" && junit != "-";
        if (prints) print(describe(comparison));
        if (!junit.empty()) write_file(junit, suite_of(comparison).xml(), kinds::junit);
        if (!json.empty()) write_json(json, to_json(comparison));
        write_differences(comparison, folder);
        if (prints && !comparison.passed())
            print("differences: " + (folder / "index.html").string() + "\n");
        return comparison.passed() ? Exit::done : Exit::comparison_failed;
    }
};

template Command make_command<CompareCommand>();

}  // namespace oiler::cli
