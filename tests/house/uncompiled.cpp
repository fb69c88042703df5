// SPDX-License-Identifier: MIT
#include <algorithm>
#include <regex>

#include "house/blank.hpp"
#include "house/plan.hpp"
#include "house/rules.hpp"

namespace oiler::house {
namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

/// The optional folder that a file is in; empty for none.
std::string optional_folder_of(const fs::path& file) {
    for (const std::string folder : optional_folders)
        if (file.string().starts_with(folder + "/")) return folder;
    return {};
}

/// The arguments and commands of a CMake file, without folders: "state_hash.cpp" for
/// "${CMAKE_CURRENT_LIST_DIR}/state_hash.cpp".
Names cmake_words(const std::string& text) {
    static const std::regex word(R"re([^\s()";]+)re");
    const std::string code = without_cmake_comments(text);
    Names words;
    for (std::sregex_iterator at(code.begin(), code.end(), word), end; at != end; ++at)
        words.insert(fs::path(at->str()).filename().string());
    return words;
}

/// Whether `word` names the file: by itself, or as "peer_${name}.cpp" where another word is the
/// value of the variable.
bool names_file(const std::string& word, const std::string& file, const Names& words) {
    static const std::regex variable(R"(\$\{\w+\})");
    std::smatch found;
    if (!std::regex_search(word, found, variable)) return word == file;
    const std::string before = found.prefix();
    const std::string after = found.suffix();
    if (file.size() <= before.size() + after.size() || !file.starts_with(before) ||
        !file.ends_with(after))
        return false;
    return words.count(file.substr(before.size(), file.size() - before.size() - after.size())) == 1;
}

bool is_named(const fs::path& file, const std::string& folder, const Texts& cmake_files) {
    for (const auto& [path, text] : cmake_files) {
        if (optional_folder_of(path) != folder) continue;
        const Names words = cmake_words(text);
        if (std::any_of(words.begin(), words.end(), [&](const std::string& word) {
                return names_file(word, file.filename().string(), words);
            }))
            return true;
    }
    return false;
}

}  // namespace

Faults find_uncompiled(const std::vector<fs::path>& files, const std::set<fs::path>& compiled,
                       const Texts& cmake_files) {
    Faults faults;
    for (const fs::path& file : files) {
        if (file.extension() != ".cpp" || compiled.count(file) == 1) continue;
        const std::string folder = optional_folder_of(file);
        if (folder.empty() || !is_named(file, folder, cmake_files))
            faults.push_back(file.string() + ": no build compiles it");
    }
    return faults;
}

}  // namespace oiler::house
