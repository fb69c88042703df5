// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "oiler/game/game.hpp"

namespace oiler {

/// Goes back in a game that is played, and forward again until the game takes another step. It
/// keeps the inputs, and copies of the game: a past step is the copy before it, stepped with the
/// inputs since.
///
/// Its memory is bounded. Copies are dense in the last steps and sparse in the far past; a full
/// list loses the copy whose neighbours are closest for its age. Inputs that do not change are kept
/// once. If there are too many, the oldest part of the past is forgotten. A game of very many
/// bodies has no past, because a copy would delay a frame.
class Rewind final : public InputSource {
public:
    struct Limits {
        std::size_t copies = 128;
        std::size_t bodies = 200'000;    ///< of a game
        std::size_t inputs = 250'000;    ///< about 50 MB
        std::size_t copied = 4'000'000;  ///< bodies in all copies, at least two, together
        int time_per_copy = 400;         ///< the time between copies over the time of a copy
    };

    /// The game has taken no step. It and the inputs must outlive this.
    Rewind(AnyGame& game, InputSource& inputs, const Limits& limits);
    Rewind(AnyGame& game, InputSource& inputs) : Rewind(game, inputs, Limits{}) {}

    /// Hands out the input of the player, and keeps it.
    [[nodiscard]] Input next(std::int64_t step) override;
    /// Copies the game, which has taken `step` steps, if it is time for that. Copies take only a
    /// small share of the time.
    void keep(std::int64_t step);
    /// Whether the game can go back.
    [[nodiscard]] bool has_past() const { return !copies_.empty(); }
    /// The first step to go to.
    [[nodiscard]] std::int64_t first() const { return copies_.front().step; }
    /// The last step that the game is known to have taken.
    [[nodiscard]] std::int64_t last() const { return last_; }
    /// Restores the game after `step` steps, from `first` to `last`. Later steps are forgotten once
    /// the game takes another step. Returns the input that its last step saw.
    Input go_to(std::int64_t step);
    /// Forgets all steps before `step`, after which the game was replaced.
    void forget(std::int64_t step);

private:
    struct Copy {
        std::int64_t step;
        std::unique_ptr<AnyGame> game;
    };
    /// An input that steps see from `first` on.
    struct Span {
        std::int64_t first;
        Input input;
    };
    class Past;

    void add_copy(std::int64_t step);
    [[nodiscard]] std::vector<Copy>::iterator first_after(std::int64_t step);
    void forget_after(std::int64_t step);
    void thin_out();
    void forget_oldest(std::int64_t step);

    AnyGame& game_;
    InputSource& inputs_;
    Limits limits_;
    std::int64_t at_ = 0;    ///< the steps that the game had taken when last seen
    std::int64_t last_ = 0;  ///< the last step that it is known to have taken
    std::vector<Copy> copies_;
    std::deque<Span> spans_;
    std::chrono::steady_clock::time_point next_copy_{};
};

}  // namespace oiler
