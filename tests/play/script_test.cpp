// SPDX-License-Identifier: MIT
#include "oiler/play/script.hpp"

#include "oiler/app/run_game.hpp"
#include "support/oscillator.hpp"
#include "support/program.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

std::string quoted(const std::filesystem::path& path) { return "'" + path.string() + "'"; }

/// A game that writes down what it sees.
struct Diary {
    static constexpr About about{.name = "diary", .title = "Diary"};
    World world;
    std::string text;

    explicit Diary(const Settings& settings) : world(2, settings) {}
    void update(const Input& input) {
        std::ostringstream line;
        for (const Button button : {Button(Key::space), Button(Key::left), Button(Mouse::left)})
            if (input.presses(button) + input.releases(button) + input.held(button) > 0)
                line << ' ' << name_of(button) << (input.pressed(button) ? " down" : "")
                     << (input.held(button) ? " held" : "")
                     << (input.released(button) ? " up" : "");
        if (input.stick(Stick::left_x) != 0) line << " stick " << input.stick(Stick::left_x);
        if (input.stick(Stick::right_trigger) != 0) line << " trigger";
        if (!input.text().empty()) line << " text " << input.text();
        if (input.wheel() != 0) line << " wheel " << input.wheel();
        if (input.pressed(Mouse::left))
            line << " at " << input.pointer()->x << ',' << input.pointer()->y;
        if (!line.str().empty()) text += std::to_string(world.tick()) + line.str() + '\n';
    }
    [[nodiscard]] Picture picture() const {
        return {.camera = {.centre = {10, 5}, .height = 9}, .labels = {{.text = text}}};
    }
};

std::string played(const std::string& script, std::int64_t steps) {
    AnyGameOf<Diary> game{Settings{}};
    ScriptInput input(parse_script(script, "script", {60}), game);
    game.step(0, steps, input);
    return game.picture().labels[0].text;
}

// The canvas has 40 units per metre here, so places are exact to 1/640 m.
TEST(Script, PlaysKeysAndMouse) {
    EXPECT_EQ(played("# a comment\n"
                     "\n"
                     "3 press Space  # and another\n"
                     "5 hold left\n"
                     "7 release Left\r\n"
                     "7 mouse 3.5 -1\n"
                     "8 click left\n"
                     "8\twheel -2\n",
                     12),
              "3 Space down held\n"
              "4 Space up\n"
              "5 Left down held\n"
              "6 Left held\n"
              "7 Left up\n"
              "8 Mouse left down held wheel -2 at 3.5,-1\n"
              "9 Mouse left up\n");
}

// Positions of sticks are whole 127ths.
TEST(Script, PlaysSticksAndText) {
    EXPECT_EQ(played("2 stick left_x -1\n"
                     "4 stick left_x 0\n"
                     "4 stick RIGHT_TRIGGER 0.5\n"
                     "5 stick right_trigger 0\n"
                     "6 text \"say \\\"hü\\\" # \\\\\" # a comment\n"
                     "7 text \"\"\n",
                     12),
              "2 stick -1\n"
              "3 stick -1\n"
              "4 trigger\n"
              "6 text say \"hü\" # \\\n");
}

TEST(Script, NamesTheWrongLine) {
    struct Wrong {
        const char* line;
        const char* said;
    };
    for (const Wrong& wrong : {Wrong{"x press A", "'x' is no step"},
                               Wrong{"-1 press A", "0 or more"},
                               Wrong{"1 push A", "'push': give press, hold"},
                               Wrong{"1 press Foo", "'Foo' is no button"},
                               Wrong{"1 press F3", "belongs to the loop"},
                               Wrong{"1 click Space", "left, middle or right"},
                               Wrong{"1 mouse nan 1", "'nan' is no place: give x and y in m"},
                               Wrong{"1 mouse 1 -inf", "'-inf' is no place: give x and y in m"},
                               Wrong{"1 mouse 1 2e9", "farther"},
                               Wrong{"1 mouse 1", "'' is no place: give x and y in m"},
                               Wrong{"1s5 press A", "'1s5' is no step"},
                               Wrong{"-1s press A", "0 or more"},
                               Wrong{"1e300s press A", "too late"},
                               Wrong{"nans press A", "'nans' is no step"},
                               Wrong{"1 press aim", "'aim' is no button"},
                               Wrong{"1 mouse 1 2 3", "'3' is too much"},
                               Wrong{"1 wheel 0.5", "'0.5' is no number of notches"},
                               Wrong{"1 press Spcae", "did you mean `Space`?"},
                               Wrong{"1 stick middle_x 1", "'middle_x' is no stick; give left_x"},
                               Wrong{"1 stick left_x 1.01", "left_x goes from -1 to 1"},
                               Wrong{"1 stick left_trigger -0.5", "left_trigger goes from 0 to 1"},
                               Wrong{"1 stick left_x nan", "'nan' is no position"},
                               Wrong{"1 stick left_x", "'' is no position"},
                               Wrong{"1 text hello", "in quotes"},
                               Wrong{"1 text \"hello", "no quote at its end"},
                               Wrong{"1 text \"a\" b", "'b' is too much"},
                               Wrong{R"(1 text "a\qb")", R"(write \\ for one \)"},
                               Wrong{"1 text \"a\xFF\"", "it is not UTF-8"},
                               Wrong{"1 release A", "A is not down then"},
                               Wrong{"1 hold A\n2 release A\n2 release A", "A is not down then"},
                               Wrong{"1 press A\n2 hold A\n3 hold A", "A is down already then"},
                               Wrong{"1 hold A\n3 press A", "A is down already then"},
                               Wrong{"1 hold Mouse left\n3 click left", "Mouse left is down"},
                               Wrong{"1 press A\n0 press A", "step 0 comes after step 1"}}) {
        const std::string line = line_of_error(Exit::usage, [&] {
            (void)parse_script(std::string("\n") + wrong.line, "a.txt", {60});
        });
        EXPECT_TRUE(holds(line, wrong.said));
        EXPECT_TRUE(line.starts_with("a.txt, line ")) << line;
    }
}

TEST(Script, HasTimesAndActions) {
    constexpr Action fire{"fire", Key::j, Mouse::left};
    constexpr Axis aim{"aim", Key::left, Key::right};
    const std::array<Control, 2> controls{fire, aim};
    const auto lines = parse_script(
        "0.14s press fire\n0.141s press Space\n1s press fire\n"
        "1.5s click left\n75 press J\n1e2s text \"s\"",
        "a.txt", {50}, controls);
    std::vector<std::int64_t> steps;
    for (const ScriptLine& line : lines) steps.push_back(line.step);
    EXPECT_EQ(steps, (std::vector<std::int64_t>{7, 8, 50, 75, 75, 5000}));
    EXPECT_EQ(lines[0].events[0].button, Button(Key::j).id());
    EXPECT_EQ(lines[1].events[0].button, Button(Key::space).id());
    EXPECT_EQ(lines[3].events[0].button, Button(Mouse::left).id());
}

TEST(Script, BeginsWithoutAByteOrderMark) {
    EXPECT_EQ(line_of_error(Exit::usage,
                            [] {
                                (void)parse_script(
                                    "\xEF\xBB\xBF"
                                    "1 press A",
                                    "a.txt", {60});
                            }),
              "a.txt, line 1: it begins with a byte order mark; save it as UTF-8 without one");
    EXPECT_EQ(
        parse_script("1 text \"\\\"\\\\\xEF\xBF\xBD\"", "a.txt", {60}).at(0).events.at(0).text,
        "\"\\\xEF\xBF\xBD");
}

// Space adds 15 m/s before a step, in numbers and in frames alike.
TEST(Script, IsPlayedByPrograms) {
    const Folder folder;
    put(folder / "kick.txt", "10 press Space\n");
    const auto trace = [&](const std::string& options) {
        const auto path = folder / "trace.csv";
        shell("hello --quiet --trace " + quoted(path) + " " + options, 0);
        return text_of(path);
    };
    const std::string script = "--script " + quoted(folder / "kick.txt");
    const std::string idle = trace("--steps 60");
    const std::string kicked = trace("--steps 60 " + script);
    EXPECT_EQ(kicked.substr(0, kicked.find("\n11,")), idle.substr(0, idle.find("\n11,")));
    EXPECT_NE(kicked.substr(kicked.find("\n11,")), idle.substr(idle.find("\n11,")));
    const std::string filmed = trace("--headless --fps 60 --frames 61 --png none --out " +
                                     quoted(folder / "frames") + " " + script);
    EXPECT_EQ(filmed, kicked);
    EXPECT_EQ(trace("--steps 60 --script - < " + quoted(folder / "kick.txt")), kicked);
    shell("hello --steps 1 --script " + quoted(folder / "none.txt"), 2);
    const Outcome wrong = shell("echo 3 push A | hello --steps 1 --script -", 2);
    EXPECT_TRUE(holds(wrong.err, "standard input, line 1: 'push'"));
}

struct Deaf {
    static constexpr About about{.name = "deaf", .title = "Deaf"};
    World world;
    explicit Deaf(const Settings& settings) : world(1, settings) {}
    [[nodiscard]] Picture picture() const { return {}; }
};

TEST(Script, OfAGameThatSeesNoInputIsRemarkedOn) {
    const Folder folder;
    put(folder / "kick.txt", "10 press Space\n");
    Options options;
    options.steps = 20;
    options.script = folder / "kick.txt";
    options.record = folder / "a";
    options.settings.stepping = {.method = &find_method("rk4"), .rate = {60}};
    testing::internal::CaptureStderr();
    (void)run_game(options, Deaf::about, [](const Settings& settings) {
        return std::make_unique<AnyGameOf<Deaf>>(settings);
    });
    const std::string said = testing::internal::GetCapturedStderr();
    for (const char* const option : {"--script: deaf has no update", "--record: deaf has no up"})
        EXPECT_TRUE(holds(said, option));
}

}  // namespace
}  // namespace oiler::test
