// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

const fs::path source = OILER_SOURCE;

/// Who may include whom, besides itself.
const std::map<std::string, Names>& allowed() {
    static const Names below_app{"core",  "sim", "world",    "picture", "plot",
                                 "scene", "lab", "platform", "render",  "capture"};
    static const Names below_cli = [] {
        Names rooms = below_app;
        rooms.insert("app");
        return rooms;
    }();
    static const std::map<std::string, Names> rooms{
        {"core", {}},
        {"sim", {"core"}},
        {"world", {"core", "sim"}},
        {"picture", {"core"}},
        {"plot", {"core", "picture"}},
        {"scene", {"core", "sim", "world", "picture"}},
        {"lab", {"core", "sim", "scene", "picture", "plot"}},
        {"platform", {"core"}},
        {"render", {"core", "picture"}},
        {"capture", {"core"}},
        {"app", below_app},
        {"cli", below_cli},
    };
    return rooms;
}

std::vector<std::string> includes(const std::string& text) {
    static const std::regex line(R"re((?:^|\n)[ \t]*#[ \t]*include[ \t]*["<]([^">]+)[">])re");
    std::vector<std::string> found;
    for (std::sregex_iterator at(text.begin(), text.end(), line), end; at != end; ++at)
        found.push_back((*at)[1]);
    return found;
}

std::string first_part(const fs::path& path) {
    return path.empty() ? std::string() : path.begin()->string();
}

bool is_window_or_gl(const std::string& header) {
    const std::string top = first_part(header);
    return top.starts_with("SDL") || top == "GL" || top == "EGL" || top == "GLES3" ||
           header == "osmesa.h";
}

bool is_provider(const fs::path& file) {
    static const Names providers{"sdl2.cpp", "osmesa.cpp", "egl.cpp"};
    return file.parent_path() == "platform" && providers.count(file.filename().string()) == 1;
}

/// What is wrong with the includes of `text` as engine/oiler/`file`, a line each.
std::vector<std::string> wrong_includes(const fs::path& file, const std::string& text) {
    std::vector<std::string> wrong;
    const std::string room = first_part(file);
    for (const std::string& header : includes(text)) {
        const fs::path path = header;
        const bool ours = first_part(path) == "oiler";
        const std::string other = ours ? std::next(path.begin())->string() : std::string();
        const bool known = allowed().count(room) == 1;
        if (ours && other != room && (!known || allowed().at(room).count(other) == 0))
            wrong.push_back(file.string() + ": " + room + " must not include " + header);
        if (is_window_or_gl(header) && !is_provider(file))
            wrong.push_back(file.string() + ": only a provider may include " + header);
        if (header.find("demos/") != std::string::npos)
            wrong.push_back(file.string() + ": nothing in engine/ includes a demo: " + header);
        if (header.starts_with("../") || header.starts_with("./"))
            wrong.push_back(file.string() + ": no full path: " + header);
    }
    return wrong;
}

/// What is wrong with the form of a file.
std::vector<std::string> wrong_form(const fs::path& file, const std::string& text) {
    std::vector<std::string> wrong;
    if (!text.starts_with("// SPDX-License-Identifier: MIT\n"))
        wrong.push_back(file.string() + ": the first line must be the SPDX line");
    if (file.extension() == ".hpp" && text.find("\n#pragma once\n") == std::string::npos)
        wrong.push_back(file.string() + ": no #pragma once");
    return wrong;
}

std::string read(const fs::path& file) {
    std::ifstream stream(file);
    std::stringstream text;
    text << stream.rdbuf();
    return text.str();
}

/// The C++ files below a folder of the source tree, by their paths relative to it.
std::vector<fs::path> files_below(const fs::path& folder) {
    std::vector<fs::path> files;
    if (!fs::exists(source / folder)) return files;
    for (const auto& entry : fs::recursive_directory_iterator(source / folder)) {
        const std::string extension = entry.path().extension().string();
        if (entry.is_regular_file() && (extension == ".hpp" || extension == ".cpp"))
            files.push_back(fs::relative(entry.path(), source / folder));
    }
    std::sort(files.begin(), files.end());
    return files;
}

void expect_nothing(const std::vector<std::string>& wrong) {
    for (const std::string& line : wrong) ADD_FAILURE() << line;
}

TEST(House, RoomsIncludeOnlyWhomTheyMay) {
    const auto files = files_below("engine/oiler");
    EXPECT_GT(files.size(), 40U);
    for (const fs::path& file : files)
        expect_nothing(wrong_includes(file, read(source / "engine/oiler" / file)));
}

TEST(House, HasOnlyTheRoomsOfThePlan) {
    std::set<std::string> rooms;
    for (const fs::path& file : files_below("engine/oiler")) rooms.insert(first_part(file));
    for (const std::string& room : rooms) EXPECT_EQ(allowed().count(room), 1U) << room;
    for (const char* room : {"core", "sim", "world", "picture"}) EXPECT_EQ(rooms.count(room), 1U);
}

TEST(House, FilesSayTheirLicenceAndHeadersAreIncludedOnce) {
    std::size_t count = 0;
    for (const char* folder : {"engine", "demos", "tests"})
        for (const fs::path& file : files_below(folder)) {
            expect_nothing(wrong_form(folder / file, read(source / folder / file)));
            ++count;
        }
    EXPECT_GT(count, 55U);
}

/// The name before "_test"; empty for files that are no tests.
std::string tested(const fs::path& file) {
    const std::string name = file.stem().string();
    return name.ends_with("_test") ? name.substr(0, name.size() - 5) : std::string();
}

/// The tests that `text`, the CMakeLists.txt of tests/, lists as "room/name".
Names listed_tests(const std::string& text) {
    static const std::regex line(
        R"re(foreach\(name ([^)]*)\)|oiler_test\((\w+) (\w+|\$\{name\}))re");
    Names listed;
    std::string several;
    for (std::sregex_iterator at(text.begin(), text.end(), line), end; at != end; ++at) {
        if ((*at)[1].matched) several = (*at)[1];
        std::istringstream names((*at)[3] == "${name}" ? several : (*at)[3].str());
        for (std::string name; names >> name;) listed.insert((*at)[2].str() + "/" + name);
    }
    return listed;
}

// Unlisted tests are never built and never fail.
TEST(House, EveryTestIsBuilt) {
    const Names listed = listed_tests(read(source / "tests/CMakeLists.txt"));
    std::size_t count = 0;
    for (const fs::path& file : files_below("tests")) {
        if (tested(file).empty() || file == "house_test.cpp") continue;
        EXPECT_EQ(listed.count((file.parent_path() / tested(file)).string()), 1U) << file;
        ++count;
    }
    EXPECT_GT(count, 70U);
}

TEST(HouseRules, FindTheTestsThatAreListed) {
    const std::string text =
        "oiler_test(sim rest)\noiler_test(lab advise json::json)\n"
        "foreach(name play check)\n  oiler_test(cli ${name})\nendforeach()\n";
    EXPECT_EQ(listed_tests(text), (Names{"cli/check", "cli/play", "lab/advise", "sim/rest"}));
    EXPECT_EQ(tested("sim/rest_test.cpp"), "rest");
    EXPECT_EQ(tested("sim/only_sim.cpp"), "");
}

TEST(HouseRules, FindAnIncludeThatIsNotAllowed) {
    const std::string above = "#pragma once\n#include \"oiler/world/world.hpp\"\n";
    EXPECT_EQ(wrong_includes("sim/a.hpp", above).size(), 1U);
    EXPECT_EQ(wrong_includes("core/a.hpp", above).size(), 1U);
    EXPECT_EQ(wrong_includes("scene/a.hpp", above).size(), 0U);
    EXPECT_EQ(wrong_includes("lab/a.hpp", above).size(), 1U);
    EXPECT_EQ(wrong_includes("world/a.hpp", above).size(), 0U);
    EXPECT_EQ(wrong_includes("cellar/a.hpp", above).size(), 1U);
    EXPECT_EQ(wrong_includes("sim/a.cpp", "  #  include <oiler/app/run.hpp>").size(), 1U);
    EXPECT_EQ(wrong_includes("app/run.cpp", "#include \"oiler/cli/main.hpp\"").size(), 1U);
    EXPECT_EQ(wrong_includes("cli/main.cpp", "#include \"oiler/app/run.hpp\"").size(), 0U);
}

TEST(HouseRules, LetOnlyProvidersSeeWindowsAndGl) {
    for (const char* header :
         {"<SDL.h>", "<SDL2/SDL.h>", "<GL/osmesa.h>", "<EGL/egl.h>", "<GL/gl.h>"}) {
        const std::string text = std::string("#include ") + header + "\n";
        EXPECT_EQ(wrong_includes("render/gl.cpp", text).size(), 1U) << header;
        EXPECT_EQ(wrong_includes("platform/surface.cpp", text).size(), 1U) << header;
        EXPECT_EQ(wrong_includes("platform/egl.cpp", text).size(), 0U) << header;
    }
    EXPECT_EQ(wrong_includes("render/gl.cpp", "#include <glad/gl.h>\n").size(), 0U);
}

TEST(HouseRules, FindDemosAndRelativePaths) {
    EXPECT_EQ(wrong_includes("app/run.cpp", "#include \"demos/hello.hpp\"").size(), 1U);
    EXPECT_EQ(wrong_includes("sim/a.cpp", "#include \"../core/error.hpp\"").size(), 1U);
}

TEST(HouseRules, FindMissingLicencesAndGuards) {
    const std::string licence = "// SPDX-License-Identifier: MIT\n";
    EXPECT_EQ(wrong_form("a.cpp", licence).size(), 0U);
    EXPECT_EQ(wrong_form("a.cpp", "\n" + licence).size(), 1U);
    EXPECT_EQ(wrong_form("a.hpp", licence).size(), 1U);
    EXPECT_EQ(wrong_form("a.hpp", licence + "#pragma once\n").size(), 0U);
}

}  // namespace
