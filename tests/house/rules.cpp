// SPDX-License-Identifier: MIT
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>

#include "house/rules.hpp"
#include "house/scan.hpp"

namespace oiler::house {
namespace {

namespace fs = std::filesystem;

std::set<std::string> words_of(const std::string& text) {
    std::istringstream words(text);
    return {std::istream_iterator<std::string>(words), {}};
}

/// Adds the rows of a room's CMakeLists.txt.
void add_room(const fs::path& folder, Plan& plan) {
    static const std::regex row(R"(\bset\((rooms|floor_(\w+))([^)]*)\))");
    const std::string room = folder.filename().string();
    std::ifstream file(folder / "CMakeLists.txt");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    for (std::sregex_iterator at(text.begin(), text.end(), row), end; at != end; ++at) {
        const std::set<std::string> below = words_of((*at)[3]);
        if ((*at)[1] == "rooms") {
            plan[room] = below;
            continue;
        }
        std::set<std::string>& floors = plan[room + "/" + (*at)[2].str()];
        for (const std::string& floor : below) floors.insert(room + "/" + floor);
    }
}

Plan read_plan() {
    Plan plan;
    for (const auto& entry : fs::directory_iterator(fs::path(OILER_SOURCE) / "engine/oiler"))
        if (entry.is_directory()) add_room(entry.path(), plan);
    return plan;
}

namespace fs = std::filesystem;

bool has_floors(const std::string& room) {
    const auto next = plan().lower_bound(room + "/");
    return next != plan().end() && next->first.starts_with(room + "/");
}

/// Whether a file at the place `from` may include one at the place `to`. The one include of a game
/// may include all rooms, and no room it.
bool may_include(const std::string& from, const std::string& to) {
    if (from == to || from == "oiler.hpp") return true;
    if (!plan().contains(from)) return false;
    if (room_of(from) != room_of(to)) return rooms_below(room_of(from)).contains(room_of(to));
    return from == room_of(from) || plan().at(from).contains(to);
}

bool is_window_or_gl(const std::string& header) {
    const std::string top = fs::path(header).begin()->string();
    return top.starts_with("SDL") || top == "GL" || top == "EGL" || top == "GLES3" ||
           header == "osmesa.h";
}

bool is_provider(const fs::path& file) {
    return std::find(providers.begin(), providers.end(), file.string()) != providers.end();
}

/// Whether a header is included as "oiler/…".
bool is_ours(const fs::path& header) { return *header.begin() == "oiler"; }

fs::path below_oiler(const fs::path& path) { return path.lexically_relative("oiler"); }

/// Walks `graph` depth first from `node`; `path` ends with the circle once one is found.
bool walk(const Graph& graph, const std::string& node, std::vector<std::string>& path,
          std::set<std::string>& done) {
    const bool closes = std::find(path.begin(), path.end(), node) != path.end();
    if (done.count(node) == 1 && !closes) return false;
    path.push_back(node);
    if (closes) return true;
    if (const auto edges = graph.find(node); edges != graph.end())
        for (const std::string& next : edges->second)
            if (walk(graph, next, path, done)) return true;
    path.pop_back();
    done.insert(node);
    return false;
}

using Names = std::set<std::string>;

/// The optional folder that a file is in; empty for none.
std::string optional_folder_of(const fs::path& file) {
    for (const std::string folder : optional_folders)
        if (file.string().starts_with(folder + "/")) return folder;
    return {};
}

/// Whether a page has the file in place of others, by its path in the engine or in the tree.
bool is_of_page(const fs::path& file) {
    return file.parent_path().filename() == "platform" &&
           file.filename().string().starts_with("web");
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
        const bool is_beside = is_of_page(file) && path.parent_path() == file.parent_path();
        if (!is_beside && optional_folder_of(path) != folder) continue;
        const Names words = cmake_words(text);
        if (std::any_of(words.begin(), words.end(), [&](const std::string& word) {
                return names_file(word, file.filename().string(), words);
            }))
            return true;
    }
    return false;
}

}  // namespace

const Plan& plan() {
    static const Plan read = read_plan();
    return read;
}

std::set<std::string> rooms_below(const std::string& room) {
    std::set<std::string> below;
    for (const std::string& next : plan().at(room)) {
        below.insert(next);
        below.merge(rooms_below(next));
    }
    return below;
}

std::string room_of(const fs::path& file) {
    return file.empty() ? std::string() : file.begin()->string();
}

std::string place_of(const fs::path& file) {
    const std::string room = room_of(file);
    const fs::path folder = file.parent_path();
    if (!has_floors(room) || folder == room) return room;
    return room + "/" + std::next(folder.begin())->string();
}

Faults check_place(const fs::path& file) {
    if (file == "oiler.hpp" || plan().contains(place_of(file))) return {};
    return {file.string() + ": the plan has no " + place_of(file)};
}

Faults check_includes(const fs::path& file, const std::string& text) {
    Faults faults;
    const auto report = [&](const std::string& what) {
        faults.push_back(file.string() + ": " + what);
    };
    for (const std::string& header : find_includes(text)) {
        if (is_ours(header) && !may_include(place_of(file), place_of(below_oiler(header))))
            report(place_of(file) + " must not include " + header);
        if (is_window_or_gl(header) && !is_provider(file))
            report("only a provider may include " + header);
        if (header.find("demos/") != std::string::npos)
            report("nothing in engine/ includes a demo: " + header);
        if (header.starts_with("../") || header.starts_with("./"))
            report("not a full path: " + header);
    }
    return faults;
}

Graph include_graph(const Texts& texts, std::string (*node_of)(const fs::path&)) {
    Graph graph;
    for (const auto& [file, text] : texts)
        for (const fs::path header : find_includes(text)) {
            if (!is_ours(header)) continue;
            const std::string from = node_of(file);
            const std::string to = node_of(below_oiler(header));
            if (from != to || file == below_oiler(header)) graph[from].insert(to);
        }
    return graph;
}

std::vector<std::string> find_circle(const Graph& graph) {
    std::set<std::string> done;
    for (const auto& [node, edges] : graph) {
        std::vector<std::string> path;
        if (!walk(graph, node, path, done)) continue;
        path.erase(path.begin(), std::find(path.begin(), path.end(), path.back()));
        return path;
    }
    return {};
}

bool needs_this_system(const std::string& text) {
    static const std::regex use(
        R"re(#\s*include <(sys/|unistd|dlfcn|fcntl|poll|c?signal)|\b(setenv|clock_gettime)\(|"/(proc|dev)/|__(x86_64|aarch64|SSE|AVX|linux))re");
    return std::regex_search(text, use);
}

Faults find_inexact_functions(const fs::path& file, const std::string& text) {
    static const std::regex call(
        R"(\bstd::(a?(sin|cos|tan)h?|atan2|exp2?|expm1|log(2|10|1p)?|pow|hypot|cbrt)\b)");
    const std::string code = code_of(text);
    Faults faults;
    for (std::sregex_iterator at(code.begin(), code.end(), call), end; at != end; ++at)
        faults.push_back(file.string() + ": its last bit depends on the processor: " + at->str());
    return faults;
}

Faults check_form(const fs::path& file, const std::string& text) {
    // Written so that this line does not match itself.
    static const std::regex unfinished(R"(\b(TO)DO\b|\bFIX(ME)\b)");
    Faults faults;
    if (!text.starts_with("// SPDX-License-Identifier: MIT\n"))
        faults.push_back(file.string() + ": the first line must be the SPDX line");
    if (file.extension() == ".hpp" && text.find("\n#pragma once\n") == std::string::npos)
        faults.push_back(file.string() + ": no #pragma once");
    if (std::smatch found; std::regex_search(text, found, unfinished))
        faults.push_back(file.string() + ": unfinished: " + found.str());
    return faults;
}

Faults find_doubled_names(const Texts& texts) {
    Faults faults;
    std::map<std::string, std::set<std::string>> files_of;
    for (const auto& [file, text] : texts) {
        const Definitions found = find_definitions(text);
        if (!found.balanced) faults.push_back(file.string() + ": brackets do not match");
        if (is_of_page(file)) continue;
        for (const std::string& name : found.names) files_of[name].insert(file.string());
    }
    for (const auto& [name, files] : files_of) {
        if (files.size() < 2) continue;
        std::string list;
        for (const std::string& file : files) list += (list.empty() ? "" : ", ") + file;
        faults.push_back(list + ": each defines " + name);
    }
    return faults;
}

Faults find_uncompiled(const std::vector<fs::path>& files, const std::set<fs::path>& compiled,
                       const Texts& cmake_files) {
    Faults faults;
    for (const fs::path& file : files) {
        if (file.extension() != ".cpp" || compiled.count(file) == 1) continue;
        const std::string folder = optional_folder_of(file);
        if ((folder.empty() && !is_of_page(file)) || !is_named(file, folder, cmake_files))
            faults.push_back(file.string() + ": no build compiles it");
    }
    return faults;
}

}  // namespace oiler::house
