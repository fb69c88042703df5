// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <cmath>

#include "oiler/app/interrupt.hpp"
#include "oiler/capture/file.hpp"
#include "oiler/cli/markup.hpp"
#include "oiler/cli/measuring.hpp"
#include "oiler/cli/tables.hpp"
#include "oiler/lab/budget.hpp"
#include "oiler/scene/read.hpp"

namespace oiler::cli {
namespace {

struct Checked {
    std::string file;
    std::vector<BudgetLine> lines{};
    std::string error{};  ///< why it could not be checked

    [[nodiscard]] bool kept() const {
        for (const BudgetLine& line : lines)
            if (!line.kept) return false;
        return true;
    }
};

/// XML has no place for control characters, and none for bytes that are no text.
std::string for_xml(std::string text) {
    for (char& c : text)
        if (c < ' ' || c > '~') c = '?';
    return escaped(text);
}

/// A test case for each number of a budget; a scene without one was skipped.
std::string to_junit(const std::vector<Checked>& all) {
    std::string cases;
    int tests = 0;
    int failures = 0;
    int skipped = 0;
    int errors = 0;
    for (const Checked& checked : all) {
        const std::string file = for_xml(checked.file);
        for (const BudgetLine& line : checked.lines) {
            ++tests;
            failures += line.kept ? 0 : 1;
            cases += fmt::format("  <testcase classname=\"{}\" name=\"{}\"", file, line.name);
            const std::string words = for_xml(describe(line));
            cases += line.kept ? fmt::format("><system-out>{}</system-out></testcase>\n", words)
                               : fmt::format("><failure message=\"{}\"/></testcase>\n", words);
        }
        if (!checked.lines.empty()) continue;
        ++tests;
        if (!checked.error.empty()) {
            ++errors;
            cases += fmt::format(
                "  <testcase classname=\"{}\" name=\"budget\"><error message=\"{}\"/></testcase>\n",
                file, for_xml(checked.error));
            continue;
        }
        ++skipped;
        cases += fmt::format(
            "  <testcase classname=\"{}\" name=\"budget\"><skipped message=\"no [budget]\"/>"
            "</testcase>\n",
            file);
    }
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"oiler check\" tests=\"{}\" "
        "failures=\"{}\" errors=\"{}\" skipped=\"{}\">\n{}</testsuite>\n",
        tests, failures, errors, skipped, cases);
}

Json to_json(const std::vector<Checked>& all) {
    Json json = Json::array();
    for (const Checked& checked : all) {
        Json one{{"scene", checked.file}, {"kept", checked.kept()}};
        if (!checked.error.empty()) one = {{"scene", checked.file}, {"error", checked.error}};
        for (const BudgetLine& line : checked.lines)
            one[line.name] = {
                {"measured", number(line.measured)}, {"budget", line.most}, {"kept", line.kept}};
        json.push_back(std::move(one));
    }
    return json;
}

/// One that cannot be checked keeps no other from it.
Checked check(const std::filesystem::path& path) {
    Checked checked{.file = path.string()};
    try {
        const Scene scene = read_scene(path.string());
        checked.lines = check_budget(scene, Settings{scene.stepping}, Interrupt::requested);
    } catch (const Error& error) {
        if (error.exit() != Exit::usage) throw;
        const std::string what = error.what();
        checked.error =
            what.starts_with(checked.file) ? what : fmt::format("{}: {}", checked.file, what);
    }
    return checked;
}

std::string text_of(const std::vector<Checked>& all) {
    std::string text;
    for (const Checked& checked : all) {
        if (checked.lines.empty() && checked.error.empty())
            text += fmt::format("{}: no [budget]\n", checked.file);
        for (const BudgetLine& line : checked.lines)
            text += fmt::format("{}: {}\n", checked.file, describe(line));
    }
    return text;
}

}  // namespace

Exit CheckCommand::run() const {
    const Interrupt interrupt;
    std::vector<Checked> all;
    for (const std::filesystem::path& path : scenes) {
        all.push_back(check(path));
        if (Interrupt::requested()) return Exit::interrupted;
    }
    if (!junit.empty()) {
        const std::string xml = to_junit(all);
        write_file(junit, std::as_bytes(std::span(xml)));
    }
    if (!json.empty()) write_json(json, to_json(all));
    if (json != "-" && junit != "-") print(text_of(all));
    Exit exit = Exit::done;
    for (const Checked& checked : all) {
        if (!checked.error.empty()) say("oiler: " + checked.error);
        if (!checked.error.empty()) exit = Exit::usage;
        if (!checked.kept() && exit == Exit::done) exit = Exit::comparison_failed;
    }
    return exit;
}

}  // namespace oiler::cli
