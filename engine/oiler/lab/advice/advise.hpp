// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "oiler/lab/sweep/tradeoff.hpp"

namespace oiler::lab {

/// What is asked of a way to step a scene.
struct Wish {
    std::optional<double> position_error{};  ///< m, at most
    std::optional<double> energy_drift{};    ///< relative, at most
    std::optional<double> ns_per_second{};   ///< of computing for a second of the scene, at most
    std::int64_t min_rate = 1;               ///< 1/s
    std::int64_t max_rate = 1'000'000;       ///< 1/s
    std::vector<const Method*> methods{};
    double most_work = 1e9;  ///< see SweepPlan

    [[nodiscard]] bool has_tolerance() const { return position_error || energy_drift; }
};

/// A method that people would have thought of, and why it is not the advice.
struct Alternative {
    std::optional<TradeoffRow> row{};  ///< none where it cannot step the scene
    const Method* method = nullptr;
    std::string why{};
};

struct Advice {
    std::optional<TradeoffRow> best{};  ///< that meets the wish, or comes nearest
    bool meets = false;
    std::optional<TradeoffRow> runner_up{};  ///< of another method
    std::optional<TradeoffRow> today{};      ///< the scene's own choice
    std::vector<Alternative> alternatives{};
    std::vector<std::string> obstacles{};  ///< where nothing meets the wish
    std::int64_t runs = 0;                 ///< that it took
};

/// The cheapest way to step the scene within the tolerances, or without tolerances the most
/// accurate within the time. It tries ways in the order of what they cost, and leaves out those
/// that their order rules out. Throws Error{usage} for a wish that the reference cannot judge.
[[nodiscard]] Advice advise(const Scene& scene, const Reference& reference, const Wish& wish,
                            const SweepWatch& watch);

/// Throws Error{usage} for a wish that the reference cannot judge.
void require_judgeable(const Scene& scene, const Reference& reference, const Wish& wish);

/// Whether a judgement is within the tolerances; with a hundredth's part of `slack` to spare.
[[nodiscard]] bool meets(const Judgement& judgement, const Wish& wish, double slack = 0);

/// How good a reference has to be for the wish, m.
[[nodiscard]] double wanted_of(const Wish& wish);

/// The advice in sentences, the conclusion first.
[[nodiscard]] std::vector<std::string> words_of(const Advice& advice, const Scene& scene,
                                                const Reference& reference, const Wish& wish);

/// "rk4 at 60 Hz in double"
[[nodiscard]] std::string words_of(const Stepping& choice);

}  // namespace oiler::lab
