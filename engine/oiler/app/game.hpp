// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstdint>
#include <string_view>

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
};

/// A game is a value that is made from its settings, has a world that steps, and can say what is to
/// be seen of it. A game with rules of its own has them in `void update(const Input&)`, which is
/// called before each step; without it, many steps are taken at once where nobody looks in between.
template <class G>
concept Game = std::copyable<G> && std::constructible_from<G, const Settings&> &&
    requires(G game, const G still) {
    { G::about } -> std::convertible_to<About>;
    { game.world } -> std::same_as<World&>;
    { still.picture() } -> std::same_as<Picture>;
};

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

template <Game G>
class AnyGameOf final : public AnyGame {
public:
    explicit AnyGameOf(const Settings& settings) : game_(settings) {}

    void step(std::int64_t count, Input& input) override {
        if constexpr (requires { game_.update(input); }) {
            for (; count > 0; --count) {
                game_.update(input);
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
