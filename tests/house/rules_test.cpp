// SPDX-License-Identifier: MIT
#include "house/rules.hpp"
#include "support/test.hpp"

namespace oiler::house {
namespace {

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
}

}  // namespace
}  // namespace oiler::house
