// SPDX-License-Identifier: MIT
// Checks this source tree. A fault is one line; a sound tree prints none.
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <regex>

#include "house/plan.hpp"
#include "house/rules.hpp"
#include "support/test.hpp"

namespace oiler::house {
namespace {

namespace fs = std::filesystem;

const fs::path source = OILER_SOURCE;
const fs::path compile_commands = OILER_COMPILE_COMMANDS;

std::string read(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// The files below source/`folder` with one of `endings`, by their paths relative to `base`.
Texts read_below(const fs::path& folder, const std::set<std::string>& endings,
                 const fs::path& base) {
    Texts texts;
    for (const auto& entry : fs::recursive_directory_iterator(source / folder))
        if (entry.is_regular_file() && endings.count(entry.path().extension().string()) == 1)
            texts[entry.path().lexically_relative(source / base)] = read(entry.path());
    return texts;
}

/// The engine's files, by their paths as includes give them.
const Texts& engine() {
    static const Texts texts = read_below("engine/oiler", {".hpp", ".cpp"}, "engine/oiler");
    return texts;
}

/// All C++ files, by their paths in the source tree.
const Texts& all_files() {
    static const Texts texts = [] {
        Texts all;
        for (const char* folder : {"engine", "demos", "tests"})
            all.merge(read_below(folder, {".hpp", ".cpp"}, ""));
        return all;
    }();
    return texts;
}

/// The source files that CMake compiles, alone or in a file that includes several, by their paths
/// in the source tree.
std::set<fs::path> compiled_files() {
    std::set<fs::path> files;
    const auto add = [&](const fs::path& file) { files.insert(file.lexically_relative(source)); };
    for (const auto& command : nlohmann::json::parse(read(compile_commands))) {
        const fs::path file = command.at("file").get<std::string>();
        if (file.parent_path().filename() != "Unity") {
            add(file);
            continue;
        }
        std::istringstream lines(read(file));
        for (std::string line; std::getline(lines, line);)
            if (line.starts_with("#include \"")) add(line.substr(10, line.size() - 11));
    }
    return files;
}

void expect_none(const Faults& faults) {
    for (const std::string& fault : faults) ADD_FAILURE() << fault;
}

void expect_no_circle(const Graph& graph) {
    std::string line;
    for (const std::string& node : find_circle(graph)) line += (line.empty() ? "" : " > ") + node;
    EXPECT_EQ(line, "");
}

TEST(House, KnowsItsFiles) {
    EXPECT_GT(engine().size(), 150U);
    EXPECT_GT(all_files().size(), engine().size() + 80);
    for (const char* file : {"core/error.hpp", "world/world.hpp", "picture/picture.hpp"})
        EXPECT_EQ(engine().count(file), 1U) << file;
}

TEST(House, HasOnlyThePlacesOfThePlan) {
    for (const auto& [file, text] : engine()) expect_none(check_place(file));
}

TEST(House, IncludesOnlyWhatThePlanAllows) {
    for (const auto& [file, text] : engine()) expect_none(check_includes(file, text));
}

TEST(House, HasNoCircle) {
    expect_no_circle(include_graph(engine(), room_of));
    expect_no_circle(include_graph(engine(), place_of));
    expect_no_circle(include_graph(engine(), [](const fs::path& file) { return file.string(); }));
}

TEST(House, PlanHasNoCircle) {
    EXPECT_GT(plan().size(), 25U);
    expect_no_circle(plan());
}

/// The last column of the table "Rooms" of engine/README.md, without commas.
Plan rooms_of_readme() {
    Plan rooms;
    std::istringstream lines(read(source / "engine/README.md"));
    static const std::regex row(R"(\| `(\w+)` \|.*\| ([^|]*)\|)");
    std::smatch found;
    for (std::string line; std::getline(lines, line);)
        if (std::regex_match(line, found, row)) {
            std::string below = found[2];
            std::erase(below, ',');
            std::istringstream words(below);
            rooms[found[1]] = {std::istream_iterator<std::string>(words), {}};
        }
    return rooms;
}

TEST(House, ReadmeHasTheRoomsOfThePlan) {
    const Plan readme = rooms_of_readme();
    for (const auto& [place, below] : plan())
        if (place == room_of(place)) {
            ASSERT_TRUE(readme.contains(place)) << place;
            EXPECT_EQ(readme.at(place), below) << place;
        }
}

TEST(House, DefinesNoNameTwice) { expect_none(find_doubled_names(engine())); }

TEST(House, CompilesEverySourceFile) {
    ASSERT_TRUE(fs::exists(compile_commands))
        << compile_commands << " is missing: configure with -DCMAKE_EXPORT_COMPILE_COMMANDS=ON";
    std::vector<fs::path> files;
    for (const auto& [file, text] : all_files()) files.push_back(file);
    Texts cmake_files = read_below("tests", {".txt", ".cmake"}, "");
    std::erase_if(cmake_files, [](const auto& file) {
        return file.first.extension() == ".txt" && file.first.filename() != "CMakeLists.txt";
    });
    expect_none(find_uncompiled(files, compiled_files(), cmake_files));
}

TEST(House, FilesSayTheirLicenceAndAreFinished) {
    for (const auto& [file, text] : all_files()) expect_none(check_form(file, text));
}

}  // namespace
}  // namespace oiler::house
