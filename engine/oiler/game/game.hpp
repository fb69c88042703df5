// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "oiler/core/state_hash.hpp"
#include "oiler/game/look.hpp"
#include "oiler/game/loop.hpp"
#include "oiler/picture/picture.hpp"
#include "oiler/world/world.hpp"

namespace oiler {

/// Name and default settings of a game. The command line overrides the settings.
struct About {
    std::string_view name;   ///< name of the program, "spring_damper"
    std::string_view title;  ///< title of the window
    int rate = 100;          ///< steps per second
    std::string_view method = "semi_implicit_euler";
    Precision precision = Precision::double_;
    double duration = 4;                  ///< s, length of a headless film
    std::string_view damping = "";        ///< "kick" or "drift"; empty: the method's default
    std::string_view scene_text = "";     ///< the scene file; empty for a game
    std::span<const Control> controls{};  ///< the actions and axes of the game
    /// Whether the setting of the game's world may change while it is played. A game with several
    /// worlds, or with members that depend on the setting, says false and is made anew.
    bool changes_in_play = true;
    /// Why a player cannot change the setting; empty: it can be changed.
    std::string_view fixed_setting = "";
    /// Whether a window says above the picture what the timestep costs. A game that is shown to
    /// players says false; F1 still opens the inspector.
    bool has_line = true;
};

template <class G>
concept UpdatesLoop = requires(G game, const Input& input, Loop& loop) {
    game.update(input, loop);
};
template <class G>
concept Updates = UpdatesLoop<G> || requires(G game, const Input& input) {
    game.update(input);
};

template <class G>
concept Draws = requires(const G& game) {
    { game.picture() } -> std::same_as<Picture>;
};
template <class G>
concept HasCamera = requires(const G& game) {
    { (game.camera) } -> std::same_as<const Camera&>;
};

namespace detail {

struct NamesOfMembers {
    void update();
    void picture();
    void camera();
    void readings();
    void hash();
};
/// If G has any member of such a name, even a private one, the name is ambiguous here.
template <class G>
struct WithMembers : G, NamesOfMembers {};
template <class G>
concept MentionsUpdate = !requires {
    &WithMembers<G>::update;
};
template <class G>
concept MentionsPicture = !requires {
    &WithMembers<G>::picture;
};
template <class G>
concept MentionsCamera = !requires {
    &WithMembers<G>::camera;
};

template <class G>
concept MentionsReadings = !requires {
    &WithMembers<G>::readings;
};
template <class G>
concept MentionsHash = !requires {
    &WithMembers<G>::hash;
};

}  // namespace detail

template <class G>
concept HasReadings = requires(const G& game) {
    { game.readings() } -> std::same_as<std::vector<Reading>>;
};

/// Checks that G is a game: a value with a constructor from settings and a world, see the asserts.
/// The loop calls `update`, if there is one, before each step. A game without `update` takes many
/// steps per call if no frame is drawn between them. A game without `picture` is drawn by
/// draw_looks, through its `camera`, if it has one.
template <class G>
consteval bool check_game() {
    static_assert(
        requires { About(G::about); }, "a game has: static constexpr About about{…}");
    static_assert(std::constructible_from<G, const Settings&>,
                  "a game has a constructor: explicit Game(const Settings& settings)");
    static_assert(std::copyable<G>, "a game is a value: all its members can be copied");
    static_assert(
        requires(G & game) {
            { (game.world) } -> std::same_as<World&>;
        },
        "a game has a public member: World world");
    static_assert(Draws<G> || !detail::MentionsPicture<G>,
                  "a game's picture is public: Picture picture() const");
    static_assert(Draws<G> || HasCamera<G> || !detail::MentionsCamera<G>,
                  "the camera of a game without picture() is public: Camera camera");
    static_assert(
        Updates<G> || !detail::MentionsUpdate<G>,
        "a game's update is public: void update(const Input&), or with a second argument, Loop&");
    static_assert(HasReadings<G> || !detail::MentionsReadings<G>,
                  "a game's readings are public: std::vector<Reading> readings() const");
    static_assert(HashesItself<G> || !detail::MentionsHash<G>,
                  "a game's hash is public: void hash(StateHash& hash) const");
    return true;
}

/// Throws the exception that is handled as an Error of the game, see guarded.
[[noreturn]] void throw_error_of_game(const std::string& place, bool in_setup);
/// Throws the Error of an update that made a world with another rate.
[[noreturn]] void throw_other_rate(const std::string& place);

/// Calls f(). An exception of a game becomes an Error that starts with place(), mostly
/// Error{diverged}. Error{usage} does so, too, unless `in_setup`, where options can be the reason.
template <class Place, class F>
auto guarded(Place place, F f, bool in_setup = false) {
    try {
        return f();
    } catch (...) {
        throw_error_of_game(place(), in_setup);
    }
}

/// A game without its type, for the loop. It is called a few times per frame; the bodies are
/// stepped behind these calls.
class AnyGame {
public:
    virtual ~AnyGame() = default;
    AnyGame() = default;

    /// Steps `count` times, or until the game quits; the next step is number `step` of the loop. A
    /// game may replace its world meanwhile. Returns the number of steps taken.
    virtual std::int64_t step(std::int64_t step, std::int64_t count, InputSource& inputs) = 0;
    /// Makes the game anew, with the settings of its world.
    virtual void restart() = 0;
    /// Continues from here with another setting, see World::set_stepping.
    virtual void set_stepping(const Stepping& stepping) = 0;
    /// See World::set_threads.
    virtual void set_threads(int threads) = 0;
    /// Whether it has come to its end, so that a window makes it anew.
    [[nodiscard]] virtual bool is_over() const { return false; }
    /// A copy, which plays on as the game does.
    [[nodiscard]] virtual std::unique_ptr<AnyGame> clone() const = 0;
    /// Becomes a copy of a game of the same type, as a clone is.
    virtual void assign(const AnyGame& other) = 0;
    /// Whether its steps see input.
    [[nodiscard]] virtual bool takes_input() const { return false; }
    /// The number of times that the world was replaced: no picture between two worlds is drawn.
    [[nodiscard]] std::int64_t cuts() const { return cuts_; }
    [[nodiscard]] const Loop& loop() const { return loop_; }
    /// See Loop.
    [[nodiscard]] std::optional<std::int64_t> take_wanted_rate() {
        return loop_.take_wanted_rate();
    }
    /// Makes it a rehearsal, see Loop.
    void rehearse() { loop_.rehearse(); }
    /// See World. A world that the game makes anew is not numbered.
    virtual void number_entities() {}
    [[nodiscard]] virtual const World& world() const = 0;
    [[nodiscard]] virtual Picture picture() const = 0;
    /// The game's results so far; empty if it offers none.
    [[nodiscard]] virtual std::vector<Reading> readings() const { return {}; }
    /// The hash of the world and, if the game says how it is hashed, of its other members.
    [[nodiscard]] virtual std::uint64_t state_hash() const { return world().state_hash(); }
    /// Adds the times of all further steps to `times`, which must outlive them.
    void measure(StepTimes& times) { times_ = &times; }
    /// Name of a body in comparisons.
    [[nodiscard]] virtual std::string name_of(Entity entity) const {
        return name_in(world(), entity);
    }
    /// Name of an obstacle in comparisons.
    [[nodiscard]] virtual std::string name_of(ObstacleHandle obstacle) const {
        return "obstacle " + std::to_string(obstacle.slot);
    }

protected:
    AnyGame(const AnyGame&) = default;
    AnyGame& operator=(const AnyGame&) = default;

    Loop loop_;
    std::int64_t cuts_ = 0;
    StepTimes* times_ = nullptr;
};

template <class G>
class AnyGameOf final : public AnyGame {
    static_assert(check_game<G>());

public:
    explicit AnyGameOf(const Settings& settings)
        : game_(guarded([] { return "the game's constructor"; }, [&] { return G(settings); },
                        true)) {}

    std::int64_t step(std::int64_t step, std::int64_t count, InputSource& inputs) override {
        if constexpr (!Updates<G>) {
            take_world_step(count);
            return count;
        } else {
            for (std::int64_t taken = 0; taken < count; ++taken) {
                const Input input = inputs.next(step + taken);
                if (input.restarts()) restart();
                update(input, step + taken);
                if (loop_.quits()) return taken;
                if (loop_.restarts())
                    restart();
                else if (loop_.holds())
                    game_.world.forget_forces();
                else
                    take_world_step(1);
                find_cut();
            }
            return count;
        }
    }
    void restart() override {
        game_ = guarded([] { return "the game's constructor"; },
                        [&] { return G(Settings(game_.world.settings())); });
        age_ = -1;
        ++cuts_;
    }
    void set_stepping(const Stepping& stepping) override { game_.world.set_stepping(stepping); }
    void set_threads(int threads) override { game_.world.set_threads(threads); }
    void number_entities() override { game_.world.number_entities(); }
    [[nodiscard]] std::unique_ptr<AnyGame> clone() const override {
        return guarded(copying, [&] { return std::make_unique<AnyGameOf>(*this); });
    }
    void assign(const AnyGame& other) override {
        const auto& source = dynamic_cast<const AnyGameOf&>(other);
        guarded(copying, [&] { game_ = source.game_; });
        loop_ = source.loop_;
        age_ = game_.world.age();
        ++cuts_;
    }
    [[nodiscard]] bool takes_input() const override { return Updates<G>; }
    [[nodiscard]] const World& world() const override { return game_.world; }
    [[nodiscard]] Picture picture() const override {
        game_.world.require_drawable();
        return guarded(place("picture"), [&] {
            Picture picture = drawn();
            require_drawable(picture);
            return picture;
        });
    }
    [[nodiscard]] std::vector<Reading> readings() const override {
        if constexpr (HasReadings<G>)
            return guarded(place("readings"), [&] {
                std::vector<Reading> readings = game_.readings();
                require_distinct_names(readings);
                return readings;
            });
        else
            return {};
    }
    [[nodiscard]] std::uint64_t state_hash() const override {
        if constexpr (HashesItself<G>) {
            StateHash hash;
            hash.add(game_.world.state_hash());
            guarded(place("hash"), [&] { game_.hash(hash); });
            return hash.value();
        } else {
            return AnyGame::state_hash();
        }
    }

private:
    static const char* copying() { return "a copy of the game"; }

    /// "picture at tick 7".
    [[nodiscard]] auto place(const char* call) const {
        return [this, call] { return call + (" at tick " + std::to_string(game_.world.tick())); };
    }
    [[nodiscard]] Picture drawn() const {
        if constexpr (Draws<G>)
            return game_.picture();
        else if constexpr (HasCamera<G>)
            return draw_looks(game_.world, game_.camera);
        else
            return draw_looks(game_.world, {});
    }
    void take_world_step(std::int64_t count) {
        const Stopwatch stopwatch(times_, &StepTimes::step);
        game_.world.step(count);
    }
    void update(const Input& input, std::int64_t step) {
        const Stopwatch stopwatch(times_, &StepTimes::update);
        loop_.begin_step();
        const Rate rate = game_.world.settings().stepping.rate;
        const std::int64_t tick = game_.world.tick();
        const auto place = [&] {
            const std::string of_run =
                tick == step ? "" : " (step " + std::to_string(step) + " of the run)";
            return "update at tick " + std::to_string(tick) + of_run;
        };
        guarded(place, [&] {
            if constexpr (UpdatesLoop<G>)
                game_.update(input, loop_);
            else
                game_.update(input);
        });
        if (game_.world.settings().stepping.rate != rate) throw_other_rate(place());
    }
    /// A new world is younger than the old one would have become.
    void find_cut() {
        const std::int64_t age = game_.world.age();
        if (age < age_ || (age == age_ && !loop_.holds())) ++cuts_;
        age_ = age;
    }

    G game_;
    std::int64_t age_ = 0;  ///< of the world
};

using MakeGame = std::function<std::unique_ptr<AnyGame>(const Settings&)>;

}  // namespace oiler
