// SPDX-License-Identifier: MIT
#include "house/plan.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>

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

}  // namespace oiler::house
