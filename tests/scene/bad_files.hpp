// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

#include "support/folder.hpp"

namespace oiler::test {

/// A file in tests/scene/bad, with the line and the message of its error.
struct BadFile {
    std::string path;
    int line;
    std::string message;
};

/// Reads the expected errors: the first line of each file, `# line 4: the message`, or an entry in
/// expected.json for files that a comment would change.
inline std::vector<BadFile> bad_files() {
    static const std::regex first_line(R"(# line (\d+): (.*))");
    const std::filesystem::path folder = OILER_SOURCE "/tests/scene/bad";
    const nlohmann::json expected = nlohmann::json::parse(text_of(folder / "expected.json"));
    std::vector<BadFile> files;
    for (const std::string& name : names_in(folder)) {
        if (!name.ends_with(".toml")) continue;
        const std::string path = (folder / name).string();
        if (const auto entry = expected.find(name); entry != expected.end()) {
            files.push_back({path, entry->at("line"), entry->at("message")});
            continue;
        }
        const std::string text = text_of(path);
        const std::string comment = text.substr(0, text.find('\n'));
        std::smatch match;
        if (!std::regex_match(comment, match, first_line))
            throw std::runtime_error(path +
                                     ": no expected error in its first line or in expected.json");
        files.push_back({path, std::stoi(match[1]), match[2]});
    }
    return files;
}

}  // namespace oiler::test
