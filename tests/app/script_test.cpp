// SPDX-License-Identifier: MIT
#include "oiler/app/script.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "support/oscillator.hpp"
#include "support/program.hpp"

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
    ScriptInput input(parse_script(script, "script"), game);
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

TEST(Script, NamesTheWrongLine) {
    struct Wrong {
        const char* line;
        const char* said;
    };
    for (const Wrong& wrong :
         {Wrong{"x press A", "'x' is no step"}, Wrong{"-1 press A", "0 or more"},
          Wrong{"1 push A", "'push': give press, hold"}, Wrong{"1 press Foo", "'Foo' is no button"},
          Wrong{"1 press F3", "belongs to the loop"},
          Wrong{"1 click Space", "left, middle or right"},
          Wrong{"1 mouse nan 1", "nan m is farther"}, Wrong{"1 mouse 1 -inf", "-inf m is farther"},
          Wrong{"1 mouse 1", "'' is no place in m"}, Wrong{"1 mouse 1 2 3", "'3' is too much"},
          Wrong{"1 wheel 0.5", "'0.5' is no number of notches"},
          Wrong{"1 press A\n0 press A", "step 0 comes after step 1"}}) {
        const std::string line = line_of_error(
            Exit::usage, [&] { (void)parse_script(std::string("\n") + wrong.line, "a.txt"); });
        EXPECT_NE(line.find(wrong.said), std::string::npos) << line;
        EXPECT_TRUE(line.starts_with("a.txt, line ")) << line;
    }
}

// Space adds 15 m/s before a step, in numbers and in frames alike.
TEST(Script, IsPlayedByPrograms) {
    const Folder folder;
    put(folder / "kick.txt", "10 press Space\n");
    const auto trace = [&](const std::string& options) {
        const auto path = folder / "trace.csv";
        EXPECT_EQ(shell("hello --quiet --trace " + quoted(path) + " " + options).exit, 0);
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
    EXPECT_EQ(shell("hello --steps 1 --script " + quoted(folder / "none.txt")).exit, 2);
}

}  // namespace
}  // namespace oiler::test
