// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "oiler/core/input.hpp"
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
    double duration = 4;               ///< s, length of a headless film
    std::string_view damping = "";     ///< "kick" or "drift"; empty: the method's default
    std::string_view scene_text = "";  ///< the scene file; empty for a game
};

/// The key of an entity's element in a picture. `part` distinguishes several elements of one
/// entity. Motion by `world.teleport` is not interpolated.
[[nodiscard]] inline ElementKey key_of(const World& world, Entity entity, std::uint32_t part = 0) {
    return {.object = entity.id(), .part = part, .jump = world.jumps(entity)};
}

/// x and y of a vector, for a picture.
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
/// If G has any member `update`, even a private one, the name is ambiguous here.
template <class G>
struct WithUpdate : G, NameOfUpdate {};
template <class G>
concept MentionsUpdate = !requires {
    &WithUpdate<G>::update;
};

}  // namespace detail

/// Checks that G is a game: a value with a constructor from settings, a world and a picture, see
/// the asserts. The loop calls `update`, if there is one, before each step. A game without `update`
/// takes many steps per call if no frame is drawn between them.
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

/// A game without its type, for the loop; one virtual call per frame.
class AnyGame {
public:
    virtual ~AnyGame() = default;
    AnyGame() = default;
    AnyGame(const AnyGame&) = delete;
    AnyGame& operator=(const AnyGame&) = delete;

    /// Steps `count` times. Only the first step sees key presses.
    virtual void step(std::int64_t count, Input& input) = 0;
    [[nodiscard]] virtual const World& world() const = 0;
    [[nodiscard]] virtual Picture picture() const = 0;
    /// Name of a body in comparisons.
    [[nodiscard]] virtual std::string name_of(Entity entity) const {
        return "body " + std::to_string(entity.index);
    }
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
