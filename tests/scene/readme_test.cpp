// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <regex>

#include "oiler/scene/keys.hpp"
#include "support/folder.hpp"

namespace oiler::test {
namespace {

std::string range_text(const ValueRange& range) {
    if (range.high < 1e300)
        return fmt::format(" {}{:.16g} to {:.16g}", range.without_low ? "above " : "", range.low,
                           range.high);
    if (range.low < -1e300) return "";
    return fmt::format(" {} {:g}", range.without_low ? ">" : "≥", range.low);
}

std::string type_text(const SceneKey& key) {
    switch (key.kind) {
        case KeyKind::text:
            return "text";
        case KeyKind::whole:
            return "whole number" + range_text(key.range);
        case KeyKind::number:
            return "number" + range_text(key.range);
        case KeyKind::flag:
            return "true or false";
        case KeyKind::vector:
            return "vector";
        case KeyKind::counts:
            return "one or two whole numbers" + range_text(key.range);
        case KeyKind::colour:
            return "colour";
        case KeyKind::word:
            break;
    }
    return key.name == "method" ? "method" : fmt::format("{}", fmt::join(key.words(), ", "));
}

std::string default_text(const SceneKey& key) {
    if (!key.absent.empty()) return std::string(key.absent);
    return key.kind == KeyKind::vector ? "zeros" : fmt::format("`{}`", key.value);
}

std::string row(const SceneKey& key) {
    const std::string table =
        is_repeated(key.table) ? fmt::format("[[{}]]", key.table) : fmt::format("[{}]", key.table);
    const std::string unit = key.unit.empty() ? "" : fmt::format(", {}", key.unit);
    return std::regex_replace(
        fmt::format("| `{}` | `{}` | {}{} | {} | {} |", table, key.name, type_text(key), unit,
                    default_text(key),
                    std::regex_replace(std::string(key.what), std::regex(R"(\|)"), R"(\|)")),
        std::regex("  +"), " ");
}

TEST(Readme, ListsEveryKeyOfASceneAndNoOther) {
    const std::string readme = text_of(OILER_SOURCE "/README.md");
    const std::size_t from = readme.find("\n## Scene files\n");
    ASSERT_NE(from, std::string::npos);
    const std::string section = readme.substr(from, readme.find("\n## ", from + 1) - from);
    std::string table = "| table | key | value | default | |\n|---|---|---|---|---|\n";
    for (const SceneKey& key : scene_keys()) table += row(key) + "\n";
    EXPECT_NE(section.find("\n" + table + "\n"), std::string::npos)
        << "the table of README.md should be:\n"
        << table;
}

}  // namespace
}  // namespace oiler::test
