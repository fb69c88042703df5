// SPDX-License-Identifier: MIT
// The buttons that a player chooses for the actions of a game.
#include "oiler/play/keys.hpp"

#include "oiler/app/run_game.hpp"
#include "support/oscillator.hpp"
#include "support/program.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr Action fire{"fire", Key::space, Mouse::left};
constexpr Action jump{"jump", Key::up};
constexpr Axis aim{"aim", Key::left, Key::right, Stick::left_x};
constexpr Control controls[] = {fire, jump, aim};

TEST(Keys, AreThoseOfTheFileElseOfTheGame) {
    const std::vector<Control> chosen = parse_keys(
        "fire = [\"j\", \"Pad south\"]  # in upper or lower case\n"
        "[aim]\n"
        "negative = []\n"
        "stick = \"Right X\"\n",
        "keys.toml", controls);
    ASSERT_EQ(chosen.size(), 3U);
    EXPECT_EQ(chosen[0].positive, (Buttons{Key::j, Pad::south}));
    EXPECT_EQ(chosen[1], Control(jump));
    EXPECT_TRUE(chosen[2].negative.empty());
    EXPECT_EQ(chosen[2].positive, Buttons(Key::right));
    EXPECT_EQ(chosen[2].stick, Stick::right_x);
    EXPECT_FALSE(parse_keys("aim.stick = \"none\"", "a", controls)[2].stick);
    EXPECT_EQ(parse_keys("", "a", controls)[0], Control(fire));
}

TEST(Keys, NameTheWrongLine) {
    struct Wrong {
        const char* line;
        const char* said;
    };
    for (const Wrong& wrong :
         {Wrong{"fier = [\"A\"]",
                "fier: the game has no such action or axis, but fire, jump, "
                "aim; did you mean `fire`?"},
          Wrong{"fire = [\"Spcae\"]", "got the text \"Spcae\"; did you mean `Space`?"},
          Wrong{"fire = [1]", "expected a button such as \"Space\""},
          Wrong{"fire = \"A\"", "fire: an action: expected a list of buttons, got the text"},
          Wrong{"[fire]", "an action: expected a list of buttons, got a table"},
          Wrong{"aim = [\"A\"]",
                "aim: an axis: expected a table, got a list of 1; for example "
                "aim = {negative = [\"A\"], positive = [\"D\"]}"},
          Wrong{"aim.postive = [\"A\"]", "did you mean `positive`?"},
          Wrong{"aim.positive = \"A\"", "positive: expected a list of buttons"},
          Wrong{"aim = {negative = [\"A\"], positive = [\"D\", \"A\"]}",
                "aim: A is negative and positive"},
          Wrong{"aim.stick = \"middle\"", "expected left_x, left_y"},
          Wrong{"fire = [\"F5\"]", "F5 belongs to the loop"},
          Wrong{"fire = [\"A\", \"a\"]", "A comes twice"},
          Wrong{"fire = [\"1\",\"2\",\"3\",\"4\",\"5\",\"6\",\"7\",\"8\",\"9\"]", "at most 8"},
          Wrong{"fire = [", "not TOML"}}) {
        const std::string line = line_of_error(Exit::usage, [&] {
            (void)parse_keys(std::string("# mine\n") + wrong.line, "my.toml", controls);
        });
        EXPECT_TRUE(holds(line, wrong.said));
        EXPECT_TRUE(line.starts_with("my.toml:2: ")) << line;
    }
}

TEST(Keys, OfAGameHaveDifferentNamesAndNoKeyOfTheLoop) {
    const auto line = [](std::vector<Control> list) {
        return line_of_error(Exit::usage, [&] { check_controls(list); });
    };
    check_controls(controls);
    EXPECT_TRUE(holds(line({fire, aim, Action{"fire", Key::a}}), "two are named fire"));
    EXPECT_TRUE(holds(line({fire, Action{"", Key::a}}), "number 2 has no name"));
    EXPECT_TRUE(holds(line({Axis{"aim", Key::f7, Key::a}}), "aim has F7"));
}

/// Pushes a body while an action or an axis is held.
struct Game {
    static constexpr About about{.name = "game", .title = "Game", .controls = controls};
    World world;
    Entity body = world.spawn({});
    explicit Game(const Settings& settings) : world(1, settings) {}
    void update(const Input& input) {
        if (input.held(fire)) world.apply_force(body, {1});
        world.apply_force(body, {8.0 * static_cast<double>(input.axis(aim))});
    }
    [[nodiscard]] Picture picture() const { return {}; }
};
struct WithoutControls : Game {
    static constexpr About about{.name = "game", .title = "Game"};
    using Game::Game;
};

class PlayedKeys : public testing::Test {
protected:
    template <class G = Game>
    Exit run(std::vector<std::string> words) {
        words.insert(words.begin(), "game");
        words.insert(words.end(), {"--quiet", "--json", path("report")});
        std::vector<char*> argv;
        for (std::string& word : words) argv.push_back(word.data());
        const CommandLine line =
            parse_command_line(static_cast<int>(argv.size()), argv.data(), G::about);
        return run_game(line.options, G::about, [](const Settings& settings) {
            return std::make_unique<AnyGameOf<G>>(settings);
        });
    }
    /// Plays 60 steps and returns the state hash.
    template <class G = Game>
    std::string play(std::vector<std::string> words) {
        EXPECT_EQ(run<G>(std::move(words)), Exit::done);
        const std::string report = text_of(path("report"));
        return report.substr(report.find("\"state_hash\""), 40);
    }
    [[nodiscard]] std::string path(const char* name) const { return (folder_ / name).string(); }

    Folder folder_;
};

TEST_F(PlayedKeys, AreRecordedAndReplayed) {
    put(path("keys.toml"), "fire = [\"J\"]\naim = {positive = [\"D\"]}\n");
    put(path("default.txt"), "5 hold Space\n20 release Space\n30 hold Right\n");
    put(path("chosen.txt"), "5 hold J\n20 release J\n30 hold D\n");
    const std::vector<std::string> chosen{"--steps",         "60",       "--keys",
                                          path("keys.toml"), "--script", path("chosen.txt"),
                                          "--record",        path("a")};
    const std::string hash = play(chosen);
    EXPECT_EQ(play({"--steps", "60", "--script", path("default.txt"), "--record", path("b")}),
              hash);
    EXPECT_NE(play({"--steps", "60", "--script", path("chosen.txt")}), hash);
    EXPECT_EQ(play({"--steps", "60", "--replay", path("a")}), hash);
    EXPECT_EQ(play({"--steps", "60", "--replay", path("b")}), hash);
    EXPECT_EQ(run({"--replay", path("a"), "--what-if", "200"}), Exit::done) << "reproduced";
    const RecordingHeader header = read_recording(path("a")).header;
    EXPECT_EQ(
        header.controls,
        (std::vector<RecordedControl>{
            {{.positive = Key::j}, "fire"},
            {{.positive = Key::up}, "jump"},
            {{.is_axis = true, .negative = Key::left, .positive = Key::d, .stick = Stick::left_x},
             "aim"}}));
}

TEST_F(PlayedKeys, AreRefusedWhereTheyHaveNoEffect) {
    put(path("keys.toml"), "fire = [\"J\"]\n");
    (void)play({"--steps", "1", "--record", path("a")});
    const auto line = [&]<class G>(std::vector<std::string> words, G) {
        return line_of_error(Exit::usage, [&] { (void)play<typename G::type>(std::move(words)); });
    };
    EXPECT_EQ(line({"--steps", "1", "--replay", path("a"), "--keys", path("keys.toml")},
                   std::type_identity<Game>{}),
              "--keys: comes from the recording of --replay; leave it out");
    EXPECT_EQ(
        line({"--steps", "1", "--keys", path("keys.toml")}, std::type_identity<WithoutControls>{}),
        "--keys: game has no actions to choose buttons for; leave it out");
    EXPECT_TRUE(
        holds(line({"--steps", "1", "--keys", path("none.toml")}, std::type_identity<Game>{}),
              "none.toml"));
}

TEST_F(PlayedKeys, OfADamagedHeaderAreRefused) {
    (void)play({"--steps", "1", "--record", path("a")});
    const std::string text = text_of(path("a"));
    for (const auto& [from, to] :
         {std::pair{"\"Space\"", "\"Spice\""}, std::pair{"\"rate\":100", "\"rate\":0"},
          std::pair{"\"stick\":\"left_x\"", "\"stick\":\"left_z\""},
          std::pair{"\"positive\":[", "\"positive\":3,\"x\":["}}) {
        std::string changed = text;
        const std::size_t at = changed.find(from);
        ASSERT_NE(at, std::string::npos) << text;
        put(path("b"), changed.replace(at, std::string(from).size(), to));
        EXPECT_TRUE(holds(line_of_error(Exit::usage, [&] { (void)read_recording(path("b")); }),
                          "its second line is damaged"));
    }
    std::string old = text;
    put(path("b"), old.replace(old.find("OILERREC 3"), 10, "OILERREC 2"));
    EXPECT_TRUE(holds(line_of_error(Exit::usage, [&] { (void)read_recording(path("b")); }),
                      "another format"));
}

}  // namespace
}  // namespace oiler::test
