// SPDX-License-Identifier: MIT
// Checks this source tree. A fault is one line; a sound tree prints none.

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <regex>

#include "house/rules.hpp"
#include "house/scan.hpp"
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

TEST(House, ReadmeNamesTheFilesThatAPortTouches) {
    const std::string readme = read(source / "engine/README.md");
    const std::string section = readme.substr(readme.find("\n## Another system\n"));
    for (const auto& [file, text] : engine()) {
        if (!needs_this_system(text)) continue;
        const std::string name = "`" + fs::path(file).replace_extension().string() + "`";
        EXPECT_NE(section.find(name), std::string::npos) << file;
    }
}

/// References, distances that are only told, and sizes of cells that change no result.
const std::set<fs::path> may_be_inexact{"physics/closed_forms.cpp", "sim/bodies_measures.cpp",
                                        "world/neighbours.cpp"};

TEST(House, StepsCallNoFunctionWhoseLastBitVaries) {
    std::set<std::string> rooms = rooms_below("world");
    rooms.insert("world");
    rooms.erase("stability");
    for (const auto& [file, text] : engine())
        if (rooms.contains(room_of(file)) && !may_be_inexact.contains(file))
            expect_none(find_inexact_functions(file, text));
}

// Its digits depend on the processor.
TEST(House, WorldsTakeNoLongDouble) {
    for (const auto& [file, text] : engine())
        if (room_of(file) == "world") {
            EXPECT_EQ(text.find("long double"), std::string::npos) << file;
        }
}

TEST(House, DefinesNoNameTwice) { expect_none(find_doubled_names(engine())); }

TEST(House, CompilesEverySourceFile) {
    ASSERT_TRUE(fs::exists(compile_commands))
        << compile_commands << " is missing: configure with -DCMAKE_EXPORT_COMPILE_COMMANDS=ON";
    std::vector<fs::path> files;
    for (const auto& [file, text] : all_files()) files.push_back(file);
    Texts cmake_files = read_below("tests", {".txt", ".cmake"}, "");
    cmake_files.merge(read_below("engine/oiler/platform", {".txt"}, ""));
    std::erase_if(cmake_files, [](const auto& file) {
        return file.first.extension() == ".txt" && file.first.filename() != "CMakeLists.txt";
    });
    expect_none(find_uncompiled(files, compiled_files(), cmake_files));
}

TEST(House, FilesSayTheirLicenceAndAreFinished) {
    for (const auto& [file, text] : all_files()) expect_none(check_form(file, text));
}

std::size_t wrong_includes(const char* file, const std::string& header) {
    return check_includes(file, "#pragma once\n#include \"" + header + "\"\n").size();
}

std::string file_itself(const std::filesystem::path& file) { return file.string(); }

TEST(HouseRules, FindIncludesAgainstThePlan) {
    EXPECT_EQ(wrong_includes("sim/a.hpp", "oiler/world/world.hpp"), 1U);
    EXPECT_EQ(wrong_includes("core/a.hpp", "oiler/world/world.hpp"), 1U);
    EXPECT_EQ(wrong_includes("cellar/a.hpp", "oiler/world/world.hpp"), 1U);
    EXPECT_EQ(wrong_includes("world/a.hpp", "oiler/world/world.hpp"), 0U);
    EXPECT_EQ(wrong_includes("scene/a.hpp", "oiler/world/world.hpp"), 0U);
    EXPECT_EQ(wrong_includes("physics/forces/a.hpp", "oiler/math/vec.hpp"), 0U);
    EXPECT_EQ(wrong_includes("physics/forces/a.hpp", "oiler/physics/state.hpp"), 0U);
    EXPECT_EQ(wrong_includes("physics/forces/a.hpp", "oiler/sim/bodies.hpp"), 1U);
    EXPECT_EQ(wrong_includes("certify/a.hpp", "oiler/scene/scene.hpp"), 1U);
    EXPECT_EQ(wrong_includes("app/run.cpp", "oiler/cli/main.hpp"), 1U);
    EXPECT_EQ(wrong_includes("cli/main.cpp", "oiler/app/run.hpp"), 0U);
    EXPECT_EQ(wrong_includes("oiler.hpp", "oiler/app/run.hpp"), 0U);
    EXPECT_EQ(wrong_includes("app/run.cpp", "oiler/oiler.hpp"), 1U);
}

TEST(HouseRules, FindIncludesBetweenFloors) {
    EXPECT_EQ(wrong_includes("lab/sweep/a.hpp", "oiler/lab/reference/path.hpp"), 0U);
    EXPECT_EQ(wrong_includes("lab/reference/a.hpp", "oiler/lab/sweep/judge.hpp"), 1U);
    EXPECT_EQ(wrong_includes("lab/ledger/a.hpp", "oiler/lab/advice/search.hpp"), 1U);
    EXPECT_EQ(wrong_includes("lab/a.cpp", "oiler/lab/ledger/ledger.hpp"), 0U);
    EXPECT_EQ(wrong_includes("lab/sweep/a.hpp", "oiler/lab/rates/budget.hpp"), 1U);
    EXPECT_EQ(wrong_includes("lab/sweep/a.hpp", "oiler/scene/scene.hpp"), 0U);
    EXPECT_EQ(wrong_includes("lab/sweep/a.hpp", "oiler/render/gl.hpp"), 1U);
    EXPECT_EQ(wrong_includes("cli/a.cpp", "oiler/lab/sweep/judge.hpp"), 0U);
    EXPECT_EQ(wrong_includes("scene/a.cpp", "oiler/lab/sweep/judge.hpp"), 1U);
}

TEST(HouseRules, FindPlacesThatThePlanLacks) {
    for (const char* file : {"lab/rates/a.cpp", "lab/sweep/a.cpp", "physics/forces/a.hpp"})
        EXPECT_EQ(check_place(file).size(), 0U) << file;
    for (const char* file : {"cellar/a.cpp", "lab/cellar/a.cpp", "all.hpp"})
        EXPECT_EQ(check_place(file).size(), 1U) << file;
}

TEST(HouseRules, LetOnlyProvidersSeeWindowsAndGl) {
    for (const char* header : {"SDL.h", "SDL2/SDL.h", "GL/osmesa.h", "EGL/egl.h", "GL/gl.h"}) {
        EXPECT_EQ(wrong_includes("render/gl.cpp", header), 1U) << header;
        EXPECT_EQ(wrong_includes("platform/surface.cpp", header), 1U) << header;
        EXPECT_EQ(wrong_includes("platform/egl.cpp", header), 0U) << header;
    }
    EXPECT_EQ(wrong_includes("render/gl.cpp", "glad/gl.h"), 0U);
}

TEST(HouseRules, FindWhatOnlyThisSystemHas) {
    for (const char* text : {"#include <sys/wait.h>\n", "# include <csignal>", "#include <fcntl.h>",
                             "open(\"/proc/self/exe\")", "#ifdef __SSE2__"})
        EXPECT_TRUE(needs_this_system(text)) << text;
    for (const char* text : {"#include <cerrno>\n", "a /proc/b", "#ifdef __clang__"})
        EXPECT_FALSE(needs_this_system(text)) << text;
}

TEST(HouseRules, FindFunctionsWhoseLastBitVaries) {
    EXPECT_EQ(find_inexact_functions("a.cpp", "x = std::cos(y) + std::hypot(x, y);").size(), 2U);
    EXPECT_EQ(find_inexact_functions("a.cpp", "x = std::sqrt(y) + std::fma(x, y, y);").size(), 0U);
    EXPECT_EQ(find_inexact_functions("a.cpp", "// std::cos(y)\n").size(), 0U);
}

TEST(HouseRules, FindDemosAndRelativePaths) {
    EXPECT_EQ(wrong_includes("app/run.cpp", "demos/hello.hpp"), 1U);
    EXPECT_EQ(wrong_includes("sim/a.cpp", "../core/error.hpp"), 1U);
}

TEST(HouseRules, FindCirclesOfFiles) {
    Texts texts{{"sim/a.hpp", "#include \"oiler/sim/b.hpp\"\n"},
                {"sim/b.hpp", "#include \"oiler/sim/c.hpp\"\n"},
                {"sim/c.hpp", "#include <vector>\n"}};
    EXPECT_EQ(find_circle(include_graph(texts, file_itself)), Faults{});
    texts["sim/c.hpp"] = "#include \"oiler/sim/b.hpp\"\n";
    EXPECT_EQ(find_circle(include_graph(texts, file_itself)),
              (Faults{"sim/b.hpp", "sim/c.hpp", "sim/b.hpp"}));
    EXPECT_EQ(find_circle(include_graph(texts, room_of)), Faults{});
    texts["sim/c.hpp"] = "#include \"oiler/sim/c.hpp\"\n";
    EXPECT_EQ(find_circle(include_graph(texts, file_itself)), (Faults{"sim/c.hpp", "sim/c.hpp"}));
}

TEST(HouseRules, FindCirclesOfFloorsAndRooms) {
    const Texts floors{{"lab/sweep/a.hpp", "#include \"oiler/lab/advice/a.hpp\"\n"},
                       {"lab/advice/b.hpp", "#include \"oiler/lab/sweep/b.hpp\"\n"}};
    EXPECT_EQ(find_circle(include_graph(floors, file_itself)), Faults{});
    EXPECT_EQ(find_circle(include_graph(floors, place_of)),
              (Faults{"lab/advice", "lab/sweep", "lab/advice"}));
    const Texts rooms{{"lab/sweep/a.hpp", "#include \"oiler/scene/a.hpp\"\n"},
                      {"scene/b.hpp", "#include \"oiler/lab/advice/b.hpp\"\n"}};
    EXPECT_EQ(find_circle(include_graph(rooms, place_of)), Faults{});
    EXPECT_EQ(find_circle(include_graph(rooms, room_of)), (Faults{"lab", "scene", "lab"}));
}

TEST(HouseRules, FindMissingLicencesAndGuards) {
    const std::string licence = "// SPDX-License-Identifier: MIT\n";
    EXPECT_EQ(check_form("a.cpp", licence).size(), 0U);
    EXPECT_EQ(check_form("a.cpp", "\n" + licence).size(), 1U);
    EXPECT_EQ(check_form("a.hpp", licence).size(), 1U);
    EXPECT_EQ(check_form("a.hpp", licence + "#pragma once\n").size(), 0U);
}

TEST(HouseRules, FindUnfinishedWork) {
    const std::string licence = "// SPDX-License-Identifier: MIT\n";
    EXPECT_EQ(check_form("a.cpp", licence + "// TO" + "DO: units\n").size(), 1U);
    EXPECT_EQ(check_form("a.cpp", licence + "int a;  // FIX" + "ME\n").size(), 1U);
    EXPECT_EQ(check_form("a.cpp", licence + "int TO" + "DOS;\n").size(), 0U);
}

TEST(HouseRules, FindANameThatTwoFilesDefine) {
    const std::string range = "namespace oiler {\nstruct Range { double low; };\n}\n";
    Texts texts{{"plot/ticks.hpp", range}, {"scene/keys.hpp", range}};
    EXPECT_EQ(find_doubled_names(texts),
              (Faults{"plot/ticks.hpp, scene/keys.hpp: each defines oiler::Range"}));
    texts["scene/keys.hpp"] =
        "namespace oiler {\nstruct Range;\nstruct Key { Range* range; };\n}\n";
    EXPECT_EQ(find_doubled_names(texts), Faults{});
    texts["scene/keys.cpp"] = "namespace oiler {\nnamespace {\nstruct Range {};\n}\n}\n";
    EXPECT_EQ(find_doubled_names(texts), Faults{});
    texts["scene/keys.cpp"] = "namespace oiler {\nconstexpr int Range = 3;\n}\n";
    EXPECT_EQ(find_doubled_names(texts).size(), 1U);
    texts["scene/keys.cpp"] = "namespace oiler {\n";
    EXPECT_EQ(find_doubled_names(texts), Faults{"scene/keys.cpp: brackets do not match"});
    texts["scene/keys.cpp"] = "";
    texts["platform/web.cpp"] = range;
    EXPECT_EQ(find_doubled_names(texts), Faults{});
    texts["platform/sdl2.cpp"] = range;
    EXPECT_EQ(find_doubled_names(texts).size(), 1U);
}

/// Whether the rule objects to `file` when `text` is the CMake file `cmake`.
bool is_uncompiled(const char* file, const char* cmake, const std::string& text) {
    return !find_uncompiled({file}, {"tests/sim/energy_test.cpp"}, {{cmake, text}}).empty();
}

TEST(HouseCompiles, FindsATestThatIsNotListed) {
    const char* cmake = "tests/CMakeLists.txt";
    EXPECT_FALSE(is_uncompiled("tests/sim/energy_test.cpp", cmake, ""));
    EXPECT_TRUE(is_uncompiled("tests/sim/sleep_test.cpp", cmake, ""));
    EXPECT_TRUE(is_uncompiled("tests/sim/sleep_test.cpp", cmake, "# oiler_test(sim sleep)\n"));
    EXPECT_TRUE(
        is_uncompiled("tests/sim/sleep_test.cpp", cmake, "add_executable(a sleep_test.cpp)"));
    EXPECT_TRUE(is_uncompiled("engine/oiler/sim/body.cpp", cmake, "body.cpp"));
    EXPECT_FALSE(is_uncompiled("engine/oiler/sim/body.hpp", cmake, ""));
}

TEST(HouseCompiles, AcceptsOptionalFilesThatCMakeNames) {
    const char* bench = "tests/bench/CMakeLists.txt";
    EXPECT_FALSE(is_uncompiled("tests/bench/main.cpp", bench, "add_executable(b main.cpp)"));
    EXPECT_TRUE(is_uncompiled("tests/bench/main.cpp", bench, "add_executable(b domain.cpp)"));
    EXPECT_TRUE(is_uncompiled("tests/bench/main.cpp", bench, "# add_executable(b main.cpp)\n"));
    EXPECT_TRUE(is_uncompiled("tests/bench/main.cpp", bench, "#[[\nmain.cpp\n]]\n"));
    EXPECT_TRUE(is_uncompiled("tests/fuzz/main.cpp", bench, "add_executable(b main.cpp)"));
    EXPECT_TRUE(is_uncompiled("tests/bench/main.cpp", "tests/CMakeLists.txt", "main.cpp"));
    const char* platform = "engine/oiler/platform/CMakeLists.txt";
    EXPECT_FALSE(is_uncompiled("engine/oiler/platform/web.cpp", platform, "set(sources web.cpp)"));
    EXPECT_TRUE(is_uncompiled("engine/oiler/platform/web.cpp", platform, "set(sources egl.cpp)"));
    EXPECT_TRUE(is_uncompiled("engine/oiler/platform/egl.cpp", platform, "set(sources egl.cpp)"));
    EXPECT_FALSE(is_uncompiled("tests/bits/hash.cpp", "tests/bits/bits.cmake",
                               "set(sources ${CMAKE_CURRENT_LIST_DIR}/hash.cpp)"));
}

TEST(HouseCompiles, AcceptsFilesNamedByAVariable) {
    const char* bench = "tests/bench/CMakeLists.txt";
    const std::string peer = "target_sources(b PRIVATE peer_${name}.cpp)\n";
    EXPECT_FALSE(is_uncompiled("tests/bench/peer_ode.cpp", bench, peer + "oiler_peer(ode A::a)"));
    EXPECT_TRUE(is_uncompiled("tests/bench/peer_ode.cpp", bench, peer + "oiler_peer(gsl A::a)"));
    EXPECT_TRUE(is_uncompiled("tests/bench/peer_ode.cpp", bench, peer + "# oiler_peer(ode A::a)"));
}

using Names = std::vector<std::string>;

/// The definitions of a text in namespace n, without "n::".
Names names_in_namespace(const std::string& text) {
    Names names;
    const Definitions found = find_definitions("namespace n {\n" + text + "\n}  // namespace n\n");
    EXPECT_TRUE(found.balanced) << text;
    for (const std::string& name : found.names) {
        EXPECT_TRUE(name.starts_with("n::")) << name;
        names.push_back(name.substr(3));
    }
    return names;
}

TEST(HouseScan, FindsTypes) {
    EXPECT_EQ(names_in_namespace("struct A { int a; struct B {}; };"), Names{"A"});
    EXPECT_EQ(names_in_namespace("class A final : public B<int> { A(); };"), Names{"A"});
    EXPECT_EQ(names_in_namespace("union A { int a; };"), Names{"A"});
    EXPECT_EQ(names_in_namespace("enum class A : std::uint8_t { a, b };"), Names{"A"});
    EXPECT_EQ(names_in_namespace("struct [[nodiscard]] alignas(64) A {};"), Names{"A"});
    EXPECT_EQ(names_in_namespace("template <class T, int N = (1 > 0)> struct A {};"), Names{"A"});
    EXPECT_EQ(names_in_namespace("template <class T> using A = std::vector<T>;"), Names{"A"});
    EXPECT_EQ(
        names_in_namespace("template <class T> concept A = requires(T t) { t.x(); } && B<T>;"),
        Names{"A"});
}

TEST(HouseScan, FindsVariables) {
    EXPECT_EQ(names_in_namespace("inline constexpr std::array a{1, 2};"), Names{"a"});
    EXPECT_EQ(names_in_namespace("constexpr double a = f(3) < 2;"), Names{"a"});
    EXPECT_EQ(names_in_namespace("const std::map<int, B<int>> a = [] { return f(); }();"),
              Names{"a"});
    EXPECT_EQ(names_in_namespace("const int a[] = {1, 2};"), Names{"a"});
    EXPECT_EQ(names_in_namespace("template <class T> constexpr T a = T(3);"), Names{"a"});
}

TEST(HouseScan, FindsSignaturesOfFunctions) {
    EXPECT_EQ(names_in_namespace("int f(const A& a, unsigned b = 2) { return g({1}); }"),
              Names{"f(const A&,unsigned)"});
    EXPECT_EQ(names_in_namespace("std::function<void(int)> f() { return {}; } int g() {}"),
              (Names{"f()", "g()"}));
    EXPECT_EQ(names_in_namespace("A::A(int a) : a_{a}, b_(a) {} void A::f() const {}"),
              Names{"A::f() const"});
    EXPECT_EQ(names_in_namespace("bool operator==(A a, A b) { return true; }"),
              Names{"operator==(A,A)"});
    EXPECT_EQ(names_in_namespace("template <class T> [[nodiscard]] auto f(T t) -> int { }"),
              Names{"template<class T> f(T)"});
    EXPECT_EQ(names_in_namespace("template <B T> auto f(T t) { return [](int a) { }; }"),
              Names{"template<B T> f(T)"});
}

TEST(HouseScan, IgnoresDeclarationsMembersAndSpecialisations) {
    for (const char* text :
         {"struct A;", "enum class A : int;", "class A; template <class T> struct B;",
          "template <> struct A<int> { int a; };", "template <class T> struct A<T*> {};",
          "template <> constexpr bool a<int> = true;", "template <> void f<int>(int) {}",
          "template const A<int>& f();", "extern int a;", "int f(const A& a, int b = 2);",
          "using std::swap;", "using namespace b;", "namespace a = b::c;", "static_assert(true);",
          "namespace { struct A {}; int a = 1; void f() {} }", "struct A::B { int a; };",
          "namespace a { namespace { struct A {}; } }", "template <class T> void A<T>::f() {}"})
        EXPECT_EQ(names_in_namespace(text), Names{}) << text;
}

TEST(HouseScan, ReadsNeitherCommentsNorLiteralsNorPreprocessorLines) {
    EXPECT_EQ(names_in_namespace("// struct A {};\n/* struct B {\n */ struct C {};"), Names{"C"});
    EXPECT_EQ(names_in_namespace("#define A \\\n struct B {\nstruct C {};"), Names{"C"});
    EXPECT_EQ(names_in_namespace("auto a = \"} // \\\" {\"; struct B {};"), (Names{"a", "B"}));
    EXPECT_EQ(names_in_namespace("auto a = R\"x(}\" )\" struct C {)x\"; struct B {};"),
              (Names{"a", "B"}));
    EXPECT_EQ(names_in_namespace("char a = '{'; int b = 1'000'000; char c = '\\'';"),
              (Names{"a", "b", "c"}));
}

TEST(HouseScan, NamesTheNamespace) {
    EXPECT_EQ(find_definitions("namespace a::b { struct A {}; } struct A {};").names,
              (Names{"a::b::A", "A"}));
    EXPECT_EQ(find_definitions("namespace a { extern \"C\" { struct A {}; } struct B {}; }").names,
              (Names{"a::A", "a::B"}));
    EXPECT_EQ(find_definitions("namespace a { inline namespace b { struct A {}; } }").names,
              Names{"a::b::A"});
}

TEST(HouseScan, FindsUnmatchedBrackets) {
    for (const char* text : {"namespace a {", "}", "void f() { {", "int a = (1;"})
        EXPECT_FALSE(find_definitions(text).balanced) << text;
}

TEST(HouseScan, FindsIncludesOutsideComments) {
    EXPECT_EQ(find_includes("#include <a>\n  #  include \"b/c.hpp\"\n"), (Names{"a", "b/c.hpp"}));
    EXPECT_EQ(find_includes("// #include <a>\n/*\n#include <b>\n*/\n"), Names{});
}

}  // namespace
}  // namespace oiler::house
