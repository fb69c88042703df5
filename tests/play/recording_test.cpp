// SPDX-License-Identifier: MIT
// Recordings of games: what is replayed is what was played, or the difference is named.
#include "oiler/play/recording.hpp"

#include <sys/resource.h>

#include <csignal>
#include <random>

#include "oiler/app/playback.hpp"
#include "oiler/core/step_clock.hpp"
#include "support/oscillator.hpp"
#include "support/program.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr std::int64_t ten_seconds = 600;

struct Score {
    int hits = 0;
};

/// A game whose bodies depend on every kind of input, on timers and on random numbers.
struct Game {
    static constexpr Action fire{"fire", Key::space, Mouse::left};
    static constexpr Axis aim{"aim", Key::left, Key::right, Stick::left_x};
    static constexpr Control controls[] = {fire, aim};
    static constexpr About about{.name = "game", .title = "Game", .rate = 60, .controls = controls};
    World world;
    Entity player;

    explicit Game(const Settings& settings) : world(2, settings) {
        world.set_gravity({0, -9.81});
        world.add_plane({.normal = {0, 1}, .restitution = 0.7});
        player = world.spawn({.position = {0, 2}, .contact = Contact{0.2}});
        world.add(player, Score{});
    }
    void update(const Input& input) {
        world.apply_force(player, {3.0 * static_cast<double>(input.axis(aim))});
        for (int i = 0; i < input.presses(fire); ++i) world.schedule(0.1, Score{1});
        world.due<Score>([&](const Score& hit) {
            world.get<Score>(player).hits += hit.hits;
            world.apply_impulse(player, {world.random().uniform(-1, 1), 2});
        });
        if (const auto at = input.pointer(); at && input.wheel() != 0)
            world.set_velocity(player, {static_cast<double>(at->x), 0});
        world.get<Score>(player).hits += static_cast<int>(input.text().size());
        if (input.pressed(Key::r)) *this = Game(world.settings());
    }
    [[nodiscard]] Picture picture() const {
        return {.camera = {.centre = to_point(world.position(player)), .height = 9}};
    }
};

Settings settings_of(int threads = 1) {
    return {
        .stepping = {.method = &find_method("rk4"), .rate = {60}}, .seed = 7, .threads = threads};
}

/// Somebody who plays at random.
class RandomPlayer final : public InputSource {
public:
    explicit RandomPlayer(unsigned seed) : random_(seed) {}
    Input next(std::int64_t step) override {
        constexpr Button buttons[] = {Key::space, Key::left, Key::right, Mouse::left};
        if (random_() % 8 == 0) queue_.set(buttons[random_() % 4], random_() % 2 == 0);
        if (random_() % 8 == 0) queue_.point_at(Point{static_cast<float>(random_() % 640), 100.3F});
        if (random_() % 16 == 0) queue_.turn_wheel(1);
        if (random_() % 32 == 0)
            queue_.deflect(Stick::left_x, static_cast<Deflection>(random_() % 100));
        if (random_() % 64 == 0) queue_.enter("ü");
        if (step == 200) queue_.restart();
        if (step == 300) queue_.set(Key::r, true);
        return queue_.take({.centre = {static_cast<float>(step % 50), 1}, .height = 9});
    }

private:
    std::mt19937 random_;
    InputQueue queue_;
};

/// Records ten seconds and returns the hash of their end.
std::uint64_t record(const std::filesystem::path& path, unsigned seed, bool finish = true) {
    AnyGameOf<Game> game(settings_of());
    TraceWriter none({}, {}, game.world());
    Playback playback(game, none, Keep::nothing);
    RandomPlayer player(seed);
    InputRecorder tape(player, path, header_of("game", settings_of(), Game::controls));
    playback.watch(tape);
    playback.step_to(ten_seconds, tape);
    if (finish) tape.finish(playback.steps(), game);
    return game.world().state_hash();
}
/// Replays a recording in frames and returns the hash of its end.
std::uint64_t replay(const Recording& recording, int threads = 1, int fps = 60) {
    AnyGameOf<Game> game(settings_of(threads));
    TraceWriter none({}, {}, game.world());
    Playback playback(game, none, Keep::nothing);
    Replay inputs(recording, "file");
    playback.watch(inputs);
    for (std::int64_t i = 0; playback.steps() < recording.steps; ++i) {
        const HeadlessFrame frame = headless_frame(i, 60, fps);
        (void)playback.show(std::min(frame.step, recording.steps), 0, inputs);
    }
    return game.world().state_hash();
}

TEST(Recordings, AreReplayedToTheSameBitsWithAnyThreadsAndFrames) {
    const Folder folder;
    for (const unsigned seed : {1U, 2U, 3U}) {
        const std::uint64_t hash = record(folder / "a", seed);
        const Recording recording = read_recording(folder / "a");
        EXPECT_TRUE(recording.complete);
        EXPECT_EQ(recording.steps, ten_seconds);
        EXPECT_EQ(recording.states.size(), std::size_t{ten_seconds});
        for (const int threads : {1, 3})
            for (const int fps : {30, 60, 144}) EXPECT_EQ(replay(recording, threads, fps), hash);
    }
}

// The force of a key that goes down a step later acts a step later.
TEST(Recordings, NameTheStepFromWhichAChangedInputIsSeen) {
    const Folder folder;
    record(folder / "a", 4);
    Recording recording = read_recording(folder / "a");
    for (auto& event : recording.events)
        if (event.step > 100 && event.event.what == InputEvent::What::edge &&
            event.event.button == Button(Key::right).id()) {
            const std::int64_t step = event.step;
            event.event.button = Button(Key::z).id();
            const std::string line =
                line_of_error(Exit::comparison_failed, [&] { (void)replay(recording); });
            EXPECT_EQ(line, fmt::format("file: the replay differs in the bodies after step {}; it "
                                        "is equal after {}; if the game was changed, "
                                        "--replay-anyway plays on",
                                        step + 1, step));
            return;
        }
    FAIL() << "no such event";
}

TEST(Recordings, NameThePartThatDiffers) {
    const Folder folder;
    record(folder / "a", 5);
    Recording recording = read_recording(folder / "a");
    for (auto& event : recording.events)
        if (event.event.what == InputEvent::What::text) {
            event.event.text += "!";
            EXPECT_TRUE(
                holds(line_of_error(Exit::comparison_failed, [&] { (void)replay(recording); }),
                      "differs in components, timers, random numbers or members of the game"));
            return;
        }
    FAIL() << "no text";
}

/// A game that keeps its shots beside the world, and perhaps says so.
struct Forgetful {
    static constexpr About about{.name = "shots", .title = "Shots"};
    World world;
    int shots = 0;
    explicit Forgetful(const Settings& settings) : world(1, settings) {}
    void update(const Input& input) { shots += input.presses(Key::space); }
};
struct Honest : Forgetful {
    using Forgetful::Forgetful;
    void hash(StateHash& hash) const { hash.add(shots); }
};

TEST(Recordings, CompareTheMembersThatAGameHashes) {
    AnyGameOf<Forgetful> forgetful(settings_of());
    AnyGameOf<Honest> honest(settings_of());
    EXPECT_EQ(forgetful.state_hash(), forgetful.world().state_hash());
    const std::uint64_t before = honest.state_hash();
    EXPECT_NE(before, honest.world().state_hash());
    InputQueue queue;
    queue.set(Key::space, true);
    struct Once final : InputSource {
        Input input;
        Input next(std::int64_t) override { return input; }
    } once;
    once.input = queue.take({});
    AnyGameOf<Honest> idle(settings_of());
    Once none;
    idle.step(0, 1, none);
    honest.step(0, 1, once);
    forgetful.step(0, 1, once);
    EXPECT_EQ(forgetful.state_hash(), idle.world().state_hash()) << "it keeps its shots to itself";
    EXPECT_NE(honest.state_hash(), idle.state_hash());
    EXPECT_NE(part_hashes(honest).whole, part_hashes(idle).whole);
    EXPECT_EQ(part_hashes(honest).bodies, part_hashes(idle).bodies);
}

// A killed program leaves whole chunks, and a part of the next one.
TEST(Recordings, SurviveAKilledProgram) {
    const Folder folder;
    put(folder / "a", "OILERREC old");
    record(folder / "a", 6, false);
    EXPECT_EQ(text_of(folder / "a"), "OILERREC old");
    const Recording recording = read_recording(part_of(folder / "a"));
    EXPECT_FALSE(recording.complete);
    EXPECT_EQ(recording.steps, ten_seconds) << "the last second was complete";
    const std::string text = text_of(part_of(folder / "a"));
    std::int64_t longest = 0;
    std::size_t in_first_second = 0;
    for (std::size_t size = text.find("}\n") + 2; size < text.size(); size += 97) {
        put(folder / "cut", text.substr(0, size));
        try {
            const Recording cut = read_recording(folder / "cut");
            EXPECT_GE(cut.steps, std::max(longest, std::int64_t{60})) << size;
            EXPECT_EQ(cut.steps % 60, 0) << "whole seconds";
            EXPECT_FALSE(cut.complete);
            longest = cut.steps;
        } catch (const Error& error) {
            EXPECT_EQ(error.exit(), Exit::usage);
            EXPECT_TRUE(holds(error.what(), "it ends before its first step"));
            EXPECT_EQ(longest, 0);
            ++in_first_second;
        }
    }
    EXPECT_GT(in_first_second, 0U);
    EXPECT_EQ(longest, ten_seconds - 60);
}

TEST(Recordings, AreRefusedIfAByteIsChanged) {
    const Folder folder;
    record(folder / "a", 7);
    const std::string text = text_of(folder / "a");
    for (std::size_t at = 0; at < text.size(); at += at < 1000 ? 1 : 7) {
        std::string changed = text;
        changed[at] ^= static_cast<char>(1U << at % 8);
        put(folder / "changed", changed);
        (void)line_of_error(Exit::usage, [&] { (void)read_recording(folder / "changed"); });
    }
    for (const std::string& wrong : {text + "x", text + text}) {
        put(folder / "changed", wrong);
        (void)line_of_error(Exit::usage, [&] { (void)read_recording(folder / "changed"); });
    }
}

TEST(Recordings, ReplaceAnOldFileAtTheirEndOnly) {
    const Folder folder;
    put(folder / "a", "OILERREC old");
    const RecordingHeader header = header_of("game", settings_of(), Game::controls);
    RecordingWriter old(folder / "a", header);
    RecordingWriter fresh(folder / "b", header);
    EXPECT_EQ(text_of(folder / "a"), "OILERREC old");
    EXPECT_FALSE(std::filesystem::exists(folder / "b"));
    AnyGameOf<Game> game(settings_of());
    for (int step = 0; step < 60; ++step) {
        EXPECT_EQ(text_of(folder / "a"), "OILERREC old");
        old.add(step, {});
        old.add_state(step, game);
    }
    EXPECT_EQ(text_of(folder / "a"), "OILERREC old");
    EXPECT_EQ(read_recording(part_of(folder / "a")).steps, 60);
    old.finish(60, game);
    EXPECT_TRUE(read_recording(folder / "a").complete);
    EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"a"});
    fresh.finish(0, game);
    EXPECT_FALSE(std::filesystem::exists(folder / "b")) << "nothing was played";
    fresh.add(0, {});
    fresh.add_state(0, game);
    fresh.finish(1, game);
    EXPECT_EQ(read_recording(folder / "b").steps, 1);
}

TEST(Recordings, ThatCannotBeWrittenLeaveTheOlderFile) {
    const Folder folder;
    put(folder / "a", "OILERREC old");
    AnyGameOf<Game> game{settings_of()};
    RecordingWriter writer(folder / "a", header_of("game", settings_of(), Game::controls));
    writer.add(0, {});
    writer.add_state(0, game);
    rlimit sizes{};
    getrlimit(RLIMIT_FSIZE, &sizes);
    const rlimit short_files{10, sizes.rlim_max};
    std::signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &short_files);
    const std::string line = line_of_error(Exit::io, [&] { writer.finish(1, game); });
    setrlimit(RLIMIT_FSIZE, &sizes);
    EXPECT_TRUE(holds(line, (folder / "a").string()));
    EXPECT_EQ(text_of(folder / "a"), "OILERREC old");
    EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"a"});
}

// The limit lets through the first seconds. A second try to finish must not succeed with a gap.
TEST(Recordings, StoppedByAFullDiskLeaveTheOlderFile) {
    for (const bool has_older : {true, false}) {
        const Folder folder;
        if (has_older) put(folder / "a", "OILERREC old");
        AnyGameOf<Game> game{settings_of()};
        std::optional<RecordingWriter> writer;
        writer.emplace(folder / "a", header_of("game", settings_of(), Game::controls));
        const auto write_second = [&](std::int64_t second) {
            for (std::int64_t step = 60 * second; step < 60 * second + 60; ++step) {
                writer->add(step, {});
                writer->add_state(step, game);
            }
        };
        write_second(0);
        ASSERT_TRUE(std::filesystem::exists(part_of(folder / "a")));
        rlimit sizes{};
        getrlimit(RLIMIT_FSIZE, &sizes);
        const rlimit short_files{std::filesystem::file_size(part_of(folder / "a")) + 10,
                                 sizes.rlim_max};
        std::signal(SIGXFSZ, SIG_IGN);
        setrlimit(RLIMIT_FSIZE, &short_files);
        line_of_error(Exit::io, [&] { write_second(1); });
        setrlimit(RLIMIT_FSIZE, &sizes);
        line_of_error(Exit::io, [&] { writer->finish(120, game); });
        writer.reset();
        if (has_older) {
            EXPECT_EQ(text_of(folder / "a"), "OILERREC old");
        }
        EXPECT_EQ(names_in(folder.path()).size(), has_older ? 1U : 0U);
    }
}

TEST(Recordings, ThatLostTheirFileAreAnError) {
    const Folder folder;
    put(folder / "a", "OILERREC old");
    AnyGameOf<Game> game{settings_of()};
    RecordingWriter writer(folder / "a", header_of("game", settings_of(), Game::controls));
    for (std::int64_t step = 0; step < 60; ++step) writer.add_state(step, game);
    std::filesystem::remove(part_of(folder / "a"));
    put(part_of(folder / "a"), "of another program");
    const std::string line = line_of_error(Exit::io, [&] { writer.finish(60, game); });
    EXPECT_TRUE(holds(line, "a.part was replaced or removed meanwhile; choose another path"));
    EXPECT_EQ(text_of(folder / "a"), "OILERREC old");
    EXPECT_EQ(text_of(part_of(folder / "a")), "of another program");
}

TEST(Recordings, KeepAPartThatIsNone) {
    const Folder folder;
    put(part_of(folder / "a"), "mine");
    const RecordingHeader header = header_of("game", settings_of(), Game::controls);
    line_of_error(Exit::usage, [&] { RecordingWriter(folder / "a", header); });
    EXPECT_EQ(text_of(part_of(folder / "a")), "mine");
}

TEST(Recordings, OfAnotherGameAreRefused) {
    const RecordingHeader now = header_of("game", settings_of(), Game::controls);
    ASSERT_EQ(now.controls.size(), 2U);
    RecordingHeader other = now;
    other.game = "chess";
    const auto line = [&] {
        return line_of_error(Exit::usage, [&] { require_same_game(other, now, false); });
    };
    EXPECT_TRUE(holds(line(), "is of chess, not of game"));
    other = now;
    other.controls.pop_back();
    EXPECT_TRUE(holds(line(), "other actions then: action fire"));
    other = now;
    other.version = "0.0";
    EXPECT_TRUE(holds(line(), "--replay-anyway"));
    require_same_game(other, now, true);
    require_same_game(now, now, false);
}

TEST(Recordings, AreMadeAndReplayedByPrograms) {
    const Folder folder;
    const auto path = [&](const char* name) { return "'" + (folder / name).string() + "' "; };
    put(folder / "kick.txt", "10 press Space\n40 press Space\n");
    const auto final_hash = [&](const std::string& options) {
        shell("hello --json " + path("report") + options, 0);
        const std::string report = text_of(folder / "report");
        const std::size_t at = report.find("\"state_hash\"");
        EXPECT_NE(at, std::string::npos) << report;
        return report.substr(at, 40);
    };
    const std::string hash = final_hash("--steps 120 --rate 50 --seed 3 --script " +
                                        path("kick.txt") + "--record " + path("a"));
    EXPECT_EQ(final_hash("--steps 120 --threads 2 --replay " + path("a")), hash);
    EXPECT_EQ(final_hash("--headless --fps 50 --frames 121 --png none --out " + path("frames") +
                         "--replay " + path("a")),
              hash);
    const Outcome equal = shell("hello --steps 120 --replay " + path("a"));
    EXPECT_TRUE(holds(equal.err, "the replay equals the recording: 120 of 120 steps"));
    const Outcome film = shell("hello --headless --fps 10 --size 64x36 --png none --out " +
                               path("film") + "--replay " + path("a"));
    EXPECT_TRUE(holds(film.err, "120 of 120 steps"));
    shell("hello --steps 9 --rate 60 --replay " + path("a"), 2);
    shell("jump --steps 9 --replay " + path("a"), 2);
    shell("hello --steps 9 --replay " + path("kick.txt"), 2);
    shell("hello --steps 9 --record " + path("new/a"), 0);
    shell("hello --steps 9 --replay " + path("new/a"), 0);
    EXPECT_EQ(shell("hello --steps 9 --record " + path("a/file")).exit, 4) << "a is no folder";
    EXPECT_EQ(shell("hello --steps 9 --record " + path("new")).exit, 2) << "new is a folder";
}

}  // namespace
}  // namespace oiler::test
