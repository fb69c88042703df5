// SPDX-License-Identifier: MIT
// Captures scenes with one change each, and compares the cause that `oiler compare` names.
#include "cli/desk.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

/// The text with its only `from` replaced.
std::string with(std::string text, const std::string& from, const std::string& to) {
    EXPECT_EQ(count_of(text, from), 1U) << from;
    return text.replace(text.find(from), from.size(), to);
}

/// Two bodies that have no force in common.
const std::string two_bodies = R"([scene]
axes = 2
rate = 100
duration = 1.0
[gravity]
acceleration = [0.0, -9.81]
[[body]]
name = "a"
position = [1.0, 2.0]
velocity = [0.5, 0.0]
colour = "#0072b2"
[[body]]
name = "b"
position = [-1.5, 1.0]
velocity = [0.5, 0.0]
)";

const std::string pendulum = R"([scene]
axes = 2
rate = 100
duration = 1.0
[gravity]
acceleration = [0.0, -9.81]
[[body]]
name = "bob"
position = [1.0, 0.0]
linear_drag = 0.1
[[body]]
name = "tail"
position = [2.0, 0.0]
quadratic_drag = 0.001
[[spring]]
body = "bob"
anchor = [0.0, 0.0]
stiffness = 200.0
rest_length = 1.0
[[spring]]
body = "tail"
to = "bob"
stiffness = 150.0
damping = 0.3
rest_length = 1.0
)";

/// A fall that a small drag changes in few of its steps: float rounds it away in the others.
const std::string fall = R"([scene]
axes = 1
rate = 1000
precision = "float"
duration = 1.0
[gravity]
acceleration = [-9.81]
[[body]]
name = "stone"
position = [100.0]
velocity = [3.0]
linear_drag = 0.00001
)";

/// The tick of the first row in which two traces differ, -1 if there is none.
std::int64_t first_different_tick(const std::string& golden, const std::string& actual) {
    std::istringstream before(golden);
    std::istringstream after(actual);
    std::string a;
    std::string b;
    while (std::getline(before, a) && std::getline(after, b))
        if (a != b) return std::stoll(a);
    return -1;
}

class Compare : public testing::Test {
protected:
    void SetUp() override {
        const Outcome drawn = desk.run("hello --headless --frames 1 --size 16x9 --out probe");
        if (drawn.exit == 3) GTEST_SKIP() << drawn.err;
    }
    /// Captures the scene into the folder NAME/frames, with a trace.
    void capture(const std::string& name, const std::string& scene, const std::string& options) {
        std::filesystem::create_directory(desk.folder() / name);
        desk.put(name + "/scene.toml", scene);
        const Outcome run =
            desk.run("cd " + name + "; oiler play scene.toml --headless --quiet --size 64x36 " +
                     "--out frames --trace trace.csv " + options);
        ASSERT_EQ(run.exit, 0) << run.err;
    }
    [[nodiscard]] Outcome compare(const std::string& options = "") const {
        return desk.run("oiler compare golden/frames actual/frames " + options);
    }
    /// Compares captures of two scenes and returns what was printed.
    std::string change(const std::string& golden, const std::string& actual,
                       const std::string& options) {
        capture("golden", golden, options);
        capture("actual", actual, options);
        const Outcome run = compare("--json result.json");
        EXPECT_EQ(run.exit, 1) << run.out << run.err;
        EXPECT_EQ(run.err, "");
        return run.out;
    }
    Desk desk;
};

struct Constant {
    const char* name;
    const std::string* scene;
    const char* golden;
    const char* actual;
    const char* options;
};

void PrintTo(const Constant& constant, std::ostream* stream) { *stream << constant.name; }

class CompareForces : public Compare, public testing::WithParamInterface<Constant> {};

// The traces of the same runs tell the tick.
TEST_P(CompareForces, NamesTheFirstTickThatDiffers) {
    const Constant& constant = GetParam();
    const std::string text = change(
        *constant.scene, with(*constant.scene, constant.golden, constant.actual), constant.options);
    const std::int64_t tick =
        first_different_tick(desk.text("golden/trace.csv"), desk.text("actual/trace.csv"));
    ASSERT_GT(tick, 0);
    const std::string start = "simulation changed at tick " + std::to_string(tick);
    EXPECT_TRUE(text.starts_with(start + ": ") || text.starts_with(start + "; ")) << text << start;
    const bool has_records = !holds(constant.options, "--png none");
    EXPECT_EQ(holds(text.substr(0, text.find('\n')), "body '"), has_records) << text;
    EXPECT_TRUE(holds(text, "scene file changed, line "));
    RecordProperty("tick", std::to_string(tick));
}

constexpr const char* thirty = "--fps 30 --frames 20";
INSTANTIATE_TEST_SUITE_P(
    Constants, CompareForces,
    testing::Values(
        Constant{"Stiffness", &pendulum, "200.0", "201.0", thirty},
        Constant{"StiffnessOfALink", &pendulum, "150.0", "150.1", thirty},
        Constant{"Gravity", &pendulum, "9.81", "9.82", thirty},
        Constant{"Damping", &pendulum, "0.3", "0.4", thirty},
        Constant{"LinearDrag", &pendulum, "0.1", "0.2", thirty},
        Constant{"QuadraticDrag", &pendulum, "0.001", "0.002", thirty},
        Constant{"ManyTicksPerFrame", &pendulum, "0.001", "0.002", "--fps 3 --frames 4"},
        Constant{"ManyFramesPerTick", &pendulum, "0.001", "0.002", "--fps 300 --frames 40"},
        Constant{"WithoutPng", &pendulum, "0.001", "0.002", "--fps 30 --frames 20 --png none"},
        Constant{"Late", &fall, "0.00001", "0.00002", "--fps 25 --frames 26"},
        Constant{"Later", &fall, "0.00001", "0.00000", "--fps 1 --frames 2"},
        Constant{"WithRk4", &pendulum, "0.3", "0.4", "--fps 30 --frames 9 --method rk4"}),
    [](const auto& constant) { return constant.param.name; });

// At frame 0 no bit differs, at the next frame all frames differ.
TEST_F(Compare, NamesBodyAndFieldOfAChangedForce) {
    const std::string text =
        change(two_bodies, with(two_bodies, "-9.81", "-9.82"), "--fps 100 --frames 3");
    EXPECT_TRUE(text.starts_with("simulation changed at tick 1: body 'a', vy: -0.0981")) << text;
    EXPECT_TRUE(holds(text, ", by 0.0001 m/s\n"));
    EXPECT_TRUE(holds(text, "scene file changed, line 6: `acceleration = [0.0, -9.81]` → "));
    EXPECT_TRUE(holds(text, "3 frames: 1 equal; 2 simulation\n"));
    EXPECT_EQ(desk.json("result.json").at("counts").at("simulation"), 2);
}

TEST_F(Compare, NamesTheObstacleThatChanged) {
    const std::string lift =
        two_bodies +
        "\n"
        "[[obstacle]]\nname = 'lift'\nshape = 'box'\ncentre = [9.0, 2.0]\nsize = [2.0, 1.0]\n"
        "velocity = [0.0, 0.5]\n";
    const std::string at_start = "simulation changed at tick 0: obstacle 'lift', ";
    for (const auto& [from, to, words] : {std::array{"[9.0, 2.0]", "[9.0, 2.5]", "y: 2 → 2.5\n"},
                                          {"[2.0, 1.0]", "[2.0, 1.5]", "height: 1 → 1.5\n"},
                                          {"[0.0, 0.5]", "[0.0, 0.25]", "vy: 0.5 → 0.25\n"}}) {
        const std::string text = change(lift, with(lift, from, to), "--fps 100 --frames 3");
        EXPECT_TRUE(text.starts_with(at_start + words)) << text;
    }
}

TEST_F(Compare, EqualCapturesPass) {
    capture("golden", pendulum, "--fps 30 --frames 5");
    capture("actual", pendulum, "--fps 30 --frames 5 --threads 3");
    const Outcome run = compare();
    EXPECT_EQ(run.exit, 0);
    EXPECT_EQ(run.out, "5 frames are equal\n");
    EXPECT_FALSE(std::filesystem::exists(desk.folder() / "actual/frames-differences"));
}

TEST_F(Compare, AChangedGoldenHasItsCauseAPageARemedyAndAJunitWithTheBudget) {
    const std::string budget = "\n[budget]\nposition_error = 1e-12\n";
    capture("golden", two_bodies, "--frames 3");
    desk.put("golden/scene.toml", with(two_bodies, "#0072b2", "#0072b5") + budget);
    const Outcome run = desk.run(
        "cd golden; oiler play scene.toml --headless --quiet --size 64x36 --frames 3 --golden "
        "frames --out ../new --junit ../new.xml",
        1);
    EXPECT_TRUE(run.err.starts_with(
        "picture changed at frame 0: 1 disc of another colour, by at most 3/255"))
        << run.err;
    EXPECT_TRUE(holds(run.err, "differences: ../new-differences/index.html\n"));
    EXPECT_TRUE(holds(run.err,
                      "If the change is intended, write the golden again with "
                      "--update-golden.\n"));
    EXPECT_TRUE(std::filesystem::exists(desk.folder() / "new-differences/index.html"));
    const std::string junit = desk.text("new.xml");
    EXPECT_TRUE(holds(junit, "failures=\"2\""));
    EXPECT_TRUE(holds(junit, "#0072b5"));
    EXPECT_TRUE(holds(junit, "classname=\"[budget]\" name=\"position_error\"><failure"));
}

// An older file of --junit would show CI the result of another run.
TEST_F(Compare, ARunThatEndsWithoutAComparisonReplacesAnOlderJunit) {
    capture("golden", pendulum, "--fps 30 --frames 5");
    const std::string play =
        "oiler play golden/scene.toml --headless --quiet --size 64x36 --fps 30 --frames 5 "
        "--golden golden/frames --out new --junit new.xml";
    desk.run(play, 0);
    EXPECT_TRUE(holds(desk.text("new.xml"), "failures=\"0\" errors=\"0\""));

    desk.put("golden/scene.toml", with(pendulum, "stiffness = 200.0", "stiffness = 1e300"));
    const Outcome diverged = desk.run(play, 5);
    const std::string failure = desk.text("new.xml");
    EXPECT_TRUE(holds(failure, "tests=\"1\" failures=\"1\" errors=\"0\""));
    EXPECT_TRUE(holds(diverged.err, "oiler: diverged at step 3 ")) << diverged.err;
    EXPECT_TRUE(holds(failure,
                      "classname=\"golden/frames\" name=\"run\"><failure message=\"diverged at "
                      "step 3 "))
        << failure;

    desk.put("golden/scene.toml", pendulum);
    desk.run(play + " --time-limit 0", 4);
    const std::string error = desk.text("new.xml");
    EXPECT_TRUE(holds(error, "tests=\"1\" failures=\"0\" errors=\"1\"")) << error;
    EXPECT_TRUE(holds(error, "name=\"run\"><error message=\"the time limit is reached\""));
}

/// Names and bytes of a folder's files.
std::string contents_of(const Desk& desk, const std::string& folder) {
    return desk.run("cd '" + folder + "'; md5sum .[!.]* * 2>&1").out;
}

// Neither a divergence nor a stop nor a full disk takes the old golden.
TEST_F(Compare, AGoldenIsReplacedOnlyByACompleteOne) {
    capture("golden", pendulum, "--fps 30 --frames 5");
    const std::string before = contents_of(desk, "golden/frames");
    const std::vector<std::string> files = desk.names("golden");
    const std::string update =
        "cd golden; env -u CI -u JENKINS_URL oiler play scene.toml --headless --quiet --size 64x36 "
        "--golden frames --update-golden ";
    desk.put("golden/scene.toml", with(pendulum, "200.0", "900000000.0"));
    desk.run(update + "--fps 30 --frames 20", 5);
    EXPECT_EQ(contents_of(desk, "golden/frames"), before);
    desk.put("golden/scene.toml", with(pendulum, "200.0", "201.0"));
    desk.run(update + "--frames 100000 & sleep 1; kill -TERM $!; wait $!", 130);
    EXPECT_EQ(contents_of(desk, "golden/frames"), before);
    EXPECT_EQ(desk.names("golden"), files);
    desk.run(update + "--fps 30 --frames 2", 0);
    EXPECT_EQ(
        desk.run(
                "mkdir other; cp golden/scene.toml other; cd other; env -u CI -u JENKINS_URL oiler "
                "play scene.toml --headless --quiet --size 64x36 --frames 1 --golden new/folder/ "
                "--update-golden && ls -A new new/folder | tr '\\n' ' '")
            .out,
        "new: folder  new/folder: frame_000000.png frames.jsonl.gz manifest.json ");
    EXPECT_EQ(desk.names("golden/frames"),
              (std::vector<std::string>{"frame_000000.png", "frame_000001.png", "frames.jsonl.gz",
                                        "manifest.json"}));
    EXPECT_EQ(desk.names("golden"), files);
    desk.run(
        "cd golden; oiler play scene.toml --headless --quiet --size 64x36 --fps 30 "
        "--frames 2 --golden frames/ --out ../now",
        0);
}

}  // namespace
}  // namespace oiler::test
