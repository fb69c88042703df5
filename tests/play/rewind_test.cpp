// SPDX-License-Identifier: MIT
// A game that goes back is where it was, and plays on as if it had never been ahead. The oracle is
// a game that plays the same inputs from the start.
#include "oiler/play/rewind.hpp"

#include <random>

#include "oiler/app/playback.hpp"
#include "support/oscillator.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

struct Score {
    int hits = 0;
};

/// A game whose state depends on input, timers, random numbers and restarts.
struct Game {
    static constexpr About about{.name = "game", .title = "Game", .rate = 60};
    World world;
    Entity player;

    explicit Game(const Settings& settings) : world(2, settings) {
        world.set_gravity({0, -9.81});
        world.add_plane({.normal = {0, 1}, .restitution = 0.7});
        player = world.spawn({.position = {0, 2}, .contact = Contact{0.2}});
        world.add(player, Score{});
    }
    void update(const Input& input, Loop& loop) {
        for (int i = 0; i < input.presses(Key::space); ++i) world.schedule(0.1, Score{1});
        world.due<Score>([&](const Score& hit) {
            world.get<Score>(player).hits += hit.hits;
            world.apply_impulse(player, {world.random().uniform(-1, 1), 2});
        });
        if (input.held(Key::left)) world.apply_force(player, {-3});
        if (const auto at = input.pointer())
            world.apply_force(player, {static_cast<double>(at->x)});
        world.get<Score>(player).hits += input.wheel() + static_cast<int>(input.text().size());
        if (input.pressed(Key::tab)) loop.hold();
        if (input.pressed(Key::q)) loop.restart();
        if (input.pressed(Key::r)) *this = Game(world.settings());
    }
    [[nodiscard]] Picture picture() const {
        const Point at = to_point(world.position(player));
        return {.discs = {{.key = key_of(world, player), .centre = at}}};
    }
};

const Settings settings{.stepping = {.rate = {60}}, .seed = 7};

/// Somebody who plays at random, with long breaks.
class RandomPlayer {
public:
    explicit RandomPlayer(unsigned seed) : random_(seed) {}
    Input next() {
        constexpr Button buttons[] = {Key::space, Key::left, Key::tab};
        if (random_() % 200 == 0) plays_ = !plays_;
        if (plays_) {
            if (random_() % 8 == 0) queue_.set(buttons[random_() % 3], random_() % 2 == 0);
            if (random_() % 8 == 0) queue_.point_at(Point{float(random_() % 640), 100});
            if (random_() % 16 == 0) queue_.turn_wheel(1);
            if (random_() % 64 == 0) queue_.enter("ü");
            if (random_() % 300 == 0) queue_.restart();
            if (random_() % 100 == 0) queue_.set(Key::r, random_() % 2 == 0);
            if (random_() % 100 == 0) queue_.set(Key::q, random_() % 2 == 0);
        }
        return queue_.take({.centre = {float(random_() % 2), 1}, .height = 9});
    }

private:
    std::mt19937 random_;
    InputQueue queue_;
    bool plays_ = true;
};

struct List final : InputSource {
    std::vector<Input> inputs;
    Input next(std::int64_t step) override { return inputs.at(static_cast<std::size_t>(step)); }
};

/// The hash after each number of steps, of a game that plays from the start.
std::vector<std::uint64_t> hashes_of(List& list) {
    AnyGameOf<Game> game(settings);
    std::vector<std::uint64_t> hashes{game.world().state_hash()};
    for (std::int64_t step = 0; step < std::ssize(list.inputs); ++step) {
        game.step(step, 1, list);
        hashes.push_back(game.world().state_hash());
    }
    return hashes;
}

/// A game that plays a list of inputs, and can go back.
struct Played {
    List list;
    AnyGameOf<Game> game{settings};
    TraceWriter none{{}, {}, game.world()};
    Playback playback{game, none, Keep::nothing};
    Rewind rewind;

    explicit Played(const Rewind::Limits& limits = {.time_per_copy = 0})
        : rewind(game, list, limits) {}
    void play(RandomPlayer& player, std::int64_t steps) {
        for (std::int64_t i = 0; i < steps; ++i) list.inputs.push_back(player.next());
        while (playback.steps() < std::ssize(list.inputs)) {
            playback.step_to(playback.steps() + 1, rewind);
            rewind.keep(playback.steps());
        }
    }
    void go_back(std::int64_t step) {
        const Input last = rewind.go_to(step);
        playback.go_to(step);
        list.inputs.resize(static_cast<std::size_t>(step));
        EXPECT_EQ(last, step > 0 ? list.inputs.back() : Input{}) << "what the last step saw";
    }
};

TEST(Rewind, IsWhereTheGameWasAndPlaysOnFromThere) {
    std::mt19937 random(1);
    RandomPlayer player(2);
    Played played;
    for (int round = 0; round < 60; ++round) {
        played.play(player, 1 + random() % 700);
        const std::vector<std::uint64_t> hashes = hashes_of(played.list);
        EXPECT_EQ(played.game.world().state_hash(), hashes.back()) << "played on from the past";
        const std::int64_t end = played.playback.steps();
        const std::int64_t most = round % 4 == 0 ? end : std::min<std::int64_t>(end, 100);
        played.go_back(end - random() % (most + 1));
        ASSERT_EQ(played.game.world().state_hash(),
                  hashes.at(static_cast<std::size_t>(played.playback.steps())))
            << "back from " << end << " to " << played.playback.steps();
    }
}

TEST(Rewind, GoesBackToTheStartStepByStep) {
    RandomPlayer player(3);
    Played played;
    played.play(player, 900);
    const std::vector<std::uint64_t> hashes = hashes_of(played.list);
    for (std::int64_t step = 899; step >= 0; --step) {
        played.go_back(step);
        ASSERT_EQ(played.game.world().state_hash(), hashes.at(static_cast<std::size_t>(step)));
    }
}

// As with a time line that is dragged.
TEST(Rewind, GoesForwardAgainToStepsThatWereTaken) {
    std::mt19937 random(5);
    RandomPlayer player(6);
    Played played;
    for (const std::int64_t more : {900, 300, 40}) {
        played.play(player, more);
        const std::vector<std::uint64_t> hashes = hashes_of(played.list);
        const std::int64_t end = played.playback.steps();
        for (int i = 0; i < 200; ++i) {
            const auto step = static_cast<std::int64_t>(random()) % (end + 1);
            const Input last = played.rewind.go_to(step);
            played.playback.go_to(step);
            played.rewind.keep(step);
            ASSERT_EQ(played.game.world().state_hash(), hashes.at(static_cast<std::size_t>(step)));
            EXPECT_EQ(played.rewind.last(), end);
            EXPECT_EQ(last, step == 0 ? Input{}
                                      : played.list.inputs.at(static_cast<std::size_t>(step - 1)));
        }
        // The end again, and from there on as if nothing had been.
        (void)played.rewind.go_to(end);
        played.playback.go_to(end);
    }
}

TEST(Rewind, ForgetsWhatCameAfterTheStepFromWhichItPlaysOn) {
    RandomPlayer player(7);
    Played played;
    played.play(player, 500);
    played.go_back(200);
    EXPECT_EQ(played.rewind.last(), 500);
    played.play(player, 1);
    EXPECT_EQ(played.rewind.last(), 201);
    played.play(player, 299);
    const std::vector<std::uint64_t> hashes = hashes_of(played.list);
    for (const std::int64_t step : {500, 300, 201, 200, 499}) {
        (void)played.rewind.go_to(step);
        EXPECT_EQ(played.game.world().state_hash(), hashes.at(static_cast<std::size_t>(step)));
    }
}

TEST(Rewind, ForgetsTheOldestInputs) {
    for (std::size_t kept = 90; kept < 110; ++kept) {
        RandomPlayer player(4);
        Played played({.inputs = kept, .time_per_copy = 0});
        played.play(player, 2000);
        const std::vector<std::uint64_t> hashes = hashes_of(played.list);
        const std::int64_t first = played.rewind.first();
        EXPECT_GT(first, 1000) << "about every fourth input differs from the one before";
        for (const std::int64_t step : {std::int64_t{1999}, first + 40, first + 1, first}) {
            played.go_back(step);
            EXPECT_EQ(played.game.world().state_hash(), hashes.at(static_cast<std::size_t>(step)));
        }
    }
}

/// Counts its copies.
struct Counted {
    static inline int alive = 0;
    Counted() { ++alive; }
    Counted(const Counted&) { ++alive; }
    Counted& operator=(const Counted&) = default;
    ~Counted() { --alive; }
};
struct Tiny {
    static constexpr About about{.name = "tiny", .title = "Tiny"};
    World world;
    Counted counted;
    std::int64_t updates = 0;
    std::int64_t presses = 0;
    explicit Tiny(const Settings& its) : world(1, its) {}
    void update(const Input& input) {
        ++updates;
        presses += input.presses(Key::space);
    }
    [[nodiscard]] Picture picture() const {
        return {.labels = {{.text = std::to_string(updates) + " " + std::to_string(presses)}}};
    }
};

/// Space is pressed at each step whose number is a multiple of 1000.
struct Clicks final : InputSource {
    InputQueue queue;
    Input next(std::int64_t step) override {
        queue.set(Key::space, step % 1000 == 0);
        return queue.take({});
    }
};

TEST(Rewind, KeepsABoundedNumberOfCopiesOfALongGame) {
    AnyGameOf<Tiny> game{Settings{}};
    Clicks clicks;
    Rewind rewind(game, clicks, {.time_per_copy = 0});
    int most = 0;
    for (std::int64_t step = 0; step < long_run; ++step) {
        game.step(step, 1, rewind);
        rewind.keep(step + 1);
        most = std::max(most, Counted::alive);
    }
    EXPECT_LE(most, 129) << "the game and 128 copies";
    EXPECT_EQ(rewind.first(), 0);
    for (const std::int64_t step : {long_run - 1, long_run - 500, long_run / 2 + 1, 1}) {
        rewind.go_to(step);
        EXPECT_EQ(game.picture().labels[0].text, fmt::format("{} {}", step, (step + 999) / 1000));
        EXPECT_LE(Counted::alive, 129);
    }
}

TEST(Rewind, KeepsFewCopiesOfManyBodies) {
    struct Crowd : Tiny {
        explicit Crowd(const Settings& its) : Tiny(its) {
            for (int i = 0; i < 100; ++i) (void)world.spawn({});
        }
    };
    AnyGameOf<Crowd> game{Settings{}};
    Clicks clicks;
    Rewind rewind(game, clicks, {.copied = 1000, .time_per_copy = 0});
    for (std::int64_t step = 0; step < 5000; ++step) {
        game.step(step, 1, rewind);
        rewind.keep(step + 1);
        EXPECT_LE(Counted::alive, 11) << "the game and 1000/100 copies";
    }
    rewind.go_to(2001);
    EXPECT_EQ(game.picture().labels[0].text, "2001 3");
    EXPECT_LE(Counted::alive, 11);
}

struct Growing : Tiny {
    std::vector<Entity> bodies{};
    explicit Growing(const Settings& its) : Tiny(its) {}
    void update(const Input& input) {
        Tiny::update(input);
        if (updates == 20) bodies = {world.spawn({}), world.spawn({}), world.spawn({})};
        if (updates == 40) world.destroy(bodies[1]);
    }
};

TEST(Rewind, HasNoPastWhileThereAreTooManyBodies) {
    AnyGameOf<Growing> game{Settings{}};
    Clicks clicks;
    Rewind rewind(game, clicks, {.bodies = 2});
    std::string past;
    for (std::int64_t step = 0; step < 60; ++step) {
        past += rewind.has_past() ? 'y' : 'n';
        game.step(step, 1, rewind);
        rewind.keep(step + 1);
    }
    EXPECT_EQ(past, std::string(20, 'y') + std::string(20, 'n') + std::string(20, 'y'));
    EXPECT_EQ(rewind.first(), 40);
    rewind.go_to(50);
    EXPECT_EQ(game.picture().labels[0].text, "50 1");
}

// The first copy would be forgotten with the oldest of more than four inputs.
TEST(Rewind, ForgetsTheInputOfAStepThatIsTakenAgain) {
    AnyGameOf<Tiny> game{Settings{}};
    LiveInput live;
    Rewind rewind(game, live, {.inputs = 4, .time_per_copy = 0});
    const auto step = [&](std::int64_t number) {
        game.step(number, 1, rewind);
        rewind.keep(number + 1);
    };
    for (std::int64_t number = 0; number < 40; ++number) step(number);
    for (int notches = 1; notches < 9; ++notches) {
        live.queue.turn_wheel(notches);
        rewind.go_to(33);
        step(33);
    }
    EXPECT_EQ(rewind.first(), 0);
}

/// A body on a spring, without `update`.
struct Drifter {
    static constexpr About about{.name = "drifter", .title = "Drifter"};
    World world;
    explicit Drifter(const Settings& its) : world(1, its) {
        (void)world.spawn(Body{.position = {1}}, Spring{.stiffness = 9});
    }
    [[nodiscard]] Picture picture() const { return {}; }
};

TEST(Rewind, GoesBackInAGameWithoutInput) {
    AnyGameOf<Drifter> game{settings};
    AnyGameOf<Drifter> fresh{settings};
    LiveInput nobody;
    Rewind rewind(game, nobody);
    for (std::int64_t step = 0; step < 500; step += 5) {
        game.step(step, 5, rewind);
        rewind.keep(step + 5);
    }
    rewind.go_to(123);
    fresh.step(0, 123, nobody);
    EXPECT_EQ(game.world().state_hash(), fresh.world().state_hash());
    game.restart();
    rewind.forget(123);
    EXPECT_EQ(rewind.first(), 123);
    game.step(123, 50, rewind);
    rewind.keep(173);
    rewind.go_to(133);
    EXPECT_EQ(game.world().tick(), 10);
}

/// What a step saw of Space.
struct Edges {
    static constexpr About about{.name = "edges", .title = "Edges"};
    World world;
    std::string text;
    explicit Edges(const Settings& its) : world(1, its) {}
    void update(const Input& input) {
        text += input.pressed(Key::space)    ? 'd'
                : input.released(Key::space) ? 'u'
                : input.held(Key::space)     ? 'h'
                                             : '-';
    }
    [[nodiscard]] Picture picture() const { return {.labels = {{.text = text}}}; }
};

// The player held Space in the past, has let it go since, and pressed it while the game went back.
TEST(Rewind, ChangesTheHeldKeysFromThePastToThePresentByEdges) {
    for (const bool down_now : {false, true}) {
        AnyGameOf<Edges> game{Settings{}};
        LiveInput live;
        Rewind rewind(game, live);
        const auto steps = [&](std::int64_t first, std::int64_t count) {
            game.step(first, count, rewind);
        };
        steps(0, 2);
        live.queue.set(Key::space, true);
        steps(2, 3);
        live.queue.set(Key::space, false);
        steps(5, 3);
        live.queue.set_paused(true);
        live.queue.set(Key::space, true);
        live.queue.set(Key::space, down_now);
        live.queue.turn_wheel(1);
        live.queue.continue_after(rewind.go_to(4));
        live.queue.set_paused(false);
        steps(4, 2);
        EXPECT_EQ(game.picture().labels[0].text, down_now ? "--dhhh" : "--dhu-");
    }
}

TEST(Rewind, ShowsWholeStepsAndNothingStreaks) {
    RandomPlayer player(5);
    Played played;
    for (int i = 0; i < 100; ++i) played.list.inputs.push_back(Input{});
    std::vector<float> heights;
    for (std::int64_t step = 0; step < 50; ++step)
        heights.push_back(played.playback.show(step, 0, played.rewind).discs[0].centre.y);
    (void)played.playback.show(49, 0.5, played.rewind);
    for (const std::int64_t step : {40, 20, 19, 0}) {
        played.rewind.go_to(step);
        played.playback.go_to(step);
        const float* const height = &heights[static_cast<std::size_t>(step)];
        const auto shown = [&](double alpha) {
            return played.playback.show(step, alpha, played.rewind).discs[0].centre.y;
        };
        EXPECT_EQ(shown(0), height[0]);
        EXPECT_EQ(shown(0.5), height[0] + (height[1] - height[0]) * 0.5F);
    }
}

}  // namespace
}  // namespace oiler::test
