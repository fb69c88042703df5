// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>

#include "oiler/app/interrupt.hpp"
#include "oiler/capture/file.hpp"
#include "oiler/cli/measuring.hpp"
#include "oiler/cli/tables.hpp"
#include "oiler/lab/budget.hpp"
#include "oiler/scene/read.hpp"

namespace oiler {
namespace {

struct Checked {
    std::string file;
    std::vector<BudgetLine> lines;

    [[nodiscard]] bool kept() const {
        for (const BudgetLine& line : lines)
            if (!line.kept) return false;
        return true;
    }
};

/// For XML, which has no place for control characters, and none for bytes that are no text.
std::string escaped(const std::string& text) {
    std::string safe;
    for (const char c : text) {
        const bool printable = c >= ' ' && c <= '~';
        if (c == '&')
            safe += "&amp;";
        else if (c == '<')
            safe += "&lt;";
        else if (c == '"')
            safe += "&quot;";
        else
            safe += printable ? c : '?';
    }
    return safe;
}

/// A test case for each number of a budget; a scene without one was skipped.
std::string to_junit(const std::vector<Checked>& all) {
    std::string cases;
    int tests = 0;
    int failures = 0;
    int skipped = 0;
    for (const Checked& checked : all) {
        const std::string file = escaped(checked.file);
        for (const BudgetLine& line : checked.lines) {
            ++tests;
            failures += line.kept ? 0 : 1;
            cases += fmt::format("  <testcase classname=\"{}\" name=\"{}\"", file, line.name);
            const std::string words = escaped(words_of(line));
            cases += line.kept ? fmt::format("><system-out>{}</system-out></testcase>\n", words)
                               : fmt::format("><failure message=\"{}\"/></testcase>\n", words);
        }
        if (!checked.lines.empty()) continue;
        ++tests;
        ++skipped;
        cases += fmt::format(
            "  <testcase classname=\"{}\" name=\"budget\"><skipped message=\"no [budget]\"/>"
            "</testcase>\n",
            file);
    }
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"oiler check\" tests=\"{}\" "
        "failures=\"{}\" errors=\"0\" skipped=\"{}\">\n{}</testsuite>\n",
        tests, failures, skipped, cases);
}

nlohmann::ordered_json to_json(const std::vector<Checked>& all) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const Checked& checked : all) {
        nlohmann::ordered_json one{{"scene", checked.file}, {"kept", checked.kept()}};
        for (const BudgetLine& line : checked.lines)
            one[line.name] = {
                {"measured", number(line.measured)}, {"budget", line.most}, {"kept", line.kept}};
        json.push_back(std::move(one));
    }
    return json;
}

}  // namespace

Exit CheckCommand::run() const {
    const Interrupt interrupt;
    std::vector<Checked> all;
    std::string text;
    bool kept = true;
    for (const std::filesystem::path& path : scenes) {
        const Scene scene = read_scene(path.string());
        Checked checked{path.string(), {}};
        try {
            checked.lines = check_budget(scene, settings_of(scene), Interrupt::requested);
        } catch (const Error& error) {
            throw Error(error.exit(), fmt::format("{}: {}", path.string(), error.what()));
        }
        if (Interrupt::requested()) return Exit::interrupted;
        if (checked.lines.empty()) text += fmt::format("{}: no [budget]\n", path.string());
        for (const BudgetLine& line : checked.lines)
            text += fmt::format("{}: {}\n", path.string(), words_of(line));
        kept = kept && checked.kept();
        all.push_back(std::move(checked));
    }
    if (!junit.empty()) {
        const std::string xml = to_junit(all);
        write_file(junit, std::as_bytes(std::span(xml)));
    }
    if (!json.empty()) write_json(json, to_json(all));
    if (json != "-" && junit != "-" && !quiet) print(text);
    return kept ? Exit::done : Exit::comparison_failed;
}

}  // namespace oiler
