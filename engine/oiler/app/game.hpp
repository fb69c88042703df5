// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstdint>
#include <string_view>
#include <utility>

#include "oiler/core/input.hpp"
#include "oiler/picture/picture.hpp"
#include "oiler/world/world.hpp"

namespace oiler {

/// What a game is called and how it steps unless the command line says otherwise.
struct About {
    std::string_view name;   ///< of the program, "spring_damper"
    std::string_view title;  ///< of the window
    int rate = 100;          ///< steps per second
    std::string_view method = "semi_implicit_euler";
    Precision precision = Precision::double_;
    double duration = 4;            ///< s that are filmed without a window
    std::string_view damping = "";  ///< "kick" or "drift"; empty: the method's own
};

/// The key of what is to be seen of an entity: parts of it are told apart by `part`, and what
/// `world.teleport` moved is not drawn in between.
[[nodiscard]] inline ElementKey key_of(const World& world, Entity entity, std::uint32_t part = 0) {
    return {.object = entity.id(), .part = part, .jump = world.jumps(entity)};
}

/// The first two axes, for a picture.
[[nodiscard]] inline Point to_point(const Vec3& v) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1])};
}

template <class G>
concept Updates = requires(G game, const Input& input) {
    game.update(input);
};

namespace detail {

struct NameOfUpdate {
    void update();
};
/// Where G has an `update` of any kind, private ones too, the name is ambiguous here.
template <class G>
struct WithUpdate : G, NameOfUpdate {};
template <class G>
concept MentionsUpdate = !requires {
    &WithUpdate<G>::update;
};

}  // namespace detail

/// A game is a value that is made from its settings, has a world that steps, and can say what is to
/// be seen of it: see the asserts. A game with rules of its own has them in `update`, which is
/// called before each step; without it, many steps are taken at once where nobody looks in between.
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
    static_assert(
        requires(const G& game) {
            { game.picture() } -> std::same_as<Picture>;
        },
        "a game has: Picture picture() const");
    static_assert(Updates<G> || !detail::MentionsUpdate<G>,
                  "a game's update is public and takes one argument: void update(const Input&)");
    return true;
}

/// A game whose type the loop does not know; one virtual call per frame.
class AnyGame {
public:
    virtual ~AnyGame() = default;
    AnyGame() = default;
    AnyGame(const AnyGame&) = delete;
    AnyGame& operator=(const AnyGame&) = delete;

    /// Steps `count` times; presses are seen by the first step alone.
    virtual void step(std::int64_t count, Input& input) = 0;
    [[nodiscard]] virtual const World& world() const = 0;
    [[nodiscard]] virtual Picture picture() const = 0;
};

template <class G>
class AnyGameOf final : public AnyGame {
    static_assert(check_game<G>());

public:
    explicit AnyGameOf(const Settings& settings) : game_(settings) {}

    void step(std::int64_t count, Input& input) override {
        if constexpr (Updates<G>) {
            for (; count > 0; --count) {
                game_.update(std::as_const(input));
                input.forget_presses();
                game_.world.step();
            }
        } else {
            input.forget_presses();
            game_.world.step(count);
        }
    }
    [[nodiscard]] const World& world() const override { return game_.world; }
    [[nodiscard]] Picture picture() const override { return game_.picture(); }

private:
    G game_;
};

}  // namespace oiler
