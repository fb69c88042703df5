// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <fstream>
#include <regex>

#include "oiler/scene/keys.hpp"
#include "oiler/scene/read.hpp"
#include "support/folder.hpp"
#include "support/test.hpp"

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
    const std::string table = scene_table(key.table).is_repeated()
                                  ? fmt::format("[[{}]]", key.table)
                                  : fmt::format("[{}]", key.table);
    const std::string unit = key.unit.empty() ? "" : fmt::format(", {}", key.unit);
    return std::regex_replace(
        fmt::format("| `{}` | `{}` | {}{} | {} | {} |", table, key.name, type_text(key), unit,
                    default_text(key),
                    std::regex_replace(std::string(key.what), std::regex(R"(\|)"), R"(\|)")),
        std::regex("  +"), " ");
}

const std::string root = OILER_SOURCE;
const std::vector<std::string> pages{"/README.md", "/demos/README.md", "/assets/scenes/README.md",
                                     "/engine/README.md", "/tests/README.md"};

/// The matches of the first group of the expression in a text.
std::vector<std::string> found(const std::string& text, const char* expression) {
    const std::regex regex(expression);
    std::vector<std::string> words;
    for (std::sregex_iterator at(text.begin(), text.end(), regex), end; at != end; ++at)
        words.push_back((*at)[1]);
    return words;
}

bool mentions_all_files(const std::string& page, const std::string& folder,
                        const std::string& extension, bool with_extension) {
    const std::string text = text_of(root + page);
    bool all = true;
    for (const auto& entry : std::filesystem::directory_iterator(root + folder)) {
        if (entry.path().extension() != extension) continue;
        const auto name = with_extension ? entry.path().filename() : entry.path().stem();
        all = all && text.find(name.string()) != std::string::npos;
        EXPECT_TRUE(all) << page << " does not mention " << name;
    }
    return all;
}

TEST(Readme, ListsEveryKeyOfASceneAndNoOther) {
    const std::string section = text_of(root + "/assets/scenes/README.md");
    std::string table = "| table | key | value | default | |\n|---|---|---|---|---|\n";
    for (const SceneKey& key : scene_keys()) table += row(key) + "\n";
    EXPECT_TRUE(holds(section, "\n" + table + "\n"))
        << "the table of assets/scenes/README.md should be:\n"
        << table;
}

TEST(Readme, ListsEverySceneAndEveryDemo) {
    EXPECT_TRUE(mentions_all_files("/assets/scenes/README.md", "/assets/scenes", ".toml", true));
    EXPECT_TRUE(mentions_all_files("/demos/README.md", "/demos", ".cpp", false));
}

TEST(Readme, ShowsValidScenes) {
    const Folder folder;
    int scenes = 0;
    for (const std::string& page : pages)
        for (const std::string& block : found(text_of(root + page), "\n```toml\n([^`]*)\n```")) {
            const auto file = folder / "scene.toml";
            std::ofstream(file) << block;
            EXPECT_NO_THROW((void)read_scene(file.string())) << page;
            ++scenes;
        }
    EXPECT_GE(scenes, 2);
}

TEST(Readme, ShowsHelloAsItIs) {
    std::string hello = text_of(root + "/demos/hello.cpp");
    hello.erase(0, hello.find('\n') + 1);  // the licence
    EXPECT_TRUE(holds(text_of(root + "/README.md"), "\n```cpp\n" + hello + "```\n"))
        << "README.md should show demos/hello.cpp";
}

TEST(Readme, LinksLeadToFiles) {
    const std::regex code("```[^`]*```");
    for (const std::string& page : pages) {
        const std::string prose = std::regex_replace(text_of(root + page), code, "");
        for (const std::string& link : found(prose, R"(\]\(([^)#:]+)[)#])")) {
            const auto folder = std::filesystem::path(root + page).parent_path();
            EXPECT_TRUE(std::filesystem::exists(folder / link)) << page << ": " << link;
        }
    }
}

TEST(Readme, TheFirstPageIsShort) {
    const std::string text = text_of(root + "/README.md");
    EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 200);
}

}  // namespace
}  // namespace oiler::test
