// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "oiler/whatif/energy_scale.hpp"
#include "oiler/whatif/verdict.hpp"
#include "oiler/whatif/what_if_runs.hpp"

namespace oiler {

/// What is known of a game that is played.
struct LiveFigures {
    /// The game when measuring began.
    struct Begin {
        double time = 0;    ///< s
        double energy = 0;  ///< J
    };

    std::optional<Begin> begin{};  ///< empty if no game could be made
    std::int64_t played = 0;       ///< the steps that were played along; the first has no length
    Verdict verdict{};
    std::optional<WhatIf> measured{};  ///< the result that the verdict judges
    /// Whether that is still the result of the last round, which this one repeats.
    bool repeats = false;
    /// J; in a repeated round, also of the last one; 0 after measuring has stopped.
    EnergyScale energy_scale{};
    std::vector<float> errors{};  ///< the largest of a body as drawn, in each of the last steps, m
    std::shared_ptr<const DrawnStep> last{};  ///< null if the true motion of that step is unknown
    bool has_stopped = false;                 ///< no more will be known

    /// Makes them those of the last round, before the first step of one that repeats it.
    void begin_repeat();
};

/// No game of more bodies is measured: it would be copied some nine times.
inline constexpr std::size_t most_measured_bodies = 100'000;

/// Whether a player did more than move the mouse, after the restart that began the round.
[[nodiscard]] bool has_player_input(const std::vector<Recording::Event>& events);

/// Where runs begin that play along with a game.
struct AlongFrom {
    RecordedPlay play;      ///< without events and steps
    MakeGame make;          ///< makes the game as it is there
    bool is_start = false;  ///< whether each round of the game begins there
    /// Whether the round before may be repeated: the rate that it advises plays along, too, and
    /// unless it had input, its result stays until as much is measured again.
    bool may_repeat = false;
};

/// The runs that play along with a game, as far as it has come: its own setting, the usual others
/// and the reference. The game never sees them.
class PlayAlong {
public:
    /// `before` is what played along until now, or null.
    PlayAlong(AlongFrom from, PlayAlong* before);
    PlayAlong(const PlayAlong&) = delete;
    PlayAlong& operator=(const PlayAlong&) = delete;

    void add(const Recording::Event& event) { play_.recording.events.push_back(event); }
    /// The game has taken that many steps.
    void has_come_to(std::int64_t steps) { play_.recording.steps = steps; }
    /// Whether there is a step to play along with a game that has taken that many.
    [[nodiscard]] bool is_behind(std::int64_t steps) const {
        return runs_ && figures_.played <= steps;
    }
    [[nodiscard]] bool is_behind() const { return is_behind(play_.recording.steps); }
    /// Whether this is a whole round without input, which a next one may repeat.
    [[nodiscard]] bool can_repeat() const;
    /// Plays a part of a step along. Returns whether that was its last. Measuring stops if the runs
    /// cannot go on.
    bool go_on();
    [[nodiscard]] bool is_judged() const { return !runs_ || figures_.played == judged_; }
    /// Judges what was measured, if that is new.
    void judge();
    [[nodiscard]] const LiveFigures& figures() const { return figures_; }

private:
    void begin(const AnyGame& game);
    void stop(std::string reason);
    /// The name of a body of the played run, also when it is gone.
    [[nodiscard]] std::string name_of(Entity body);
    /// The usual other settings, and the rates that the last round advises, if there was one.
    [[nodiscard]] std::vector<Stepping> other_settings(const MakeGame& make,
                                                       const std::optional<WhatIf>& last) const;

    RecordedPlay play_;  ///< its recording grows
    bool is_start_;
    std::optional<WhatIfRuns> runs_;  ///< empty: measuring has stopped
    bool is_too_large_ = false;       ///< the game, to be measured
    std::int64_t judged_ = 0;         ///< the steps that the verdict judges
    std::vector<Reading> readings_;   ///< at the last verdict
    /// The last body that a verdict named while it was there.
    std::pair<Entity, std::string> named_{};
    LiveFigures figures_;
};

}  // namespace oiler
