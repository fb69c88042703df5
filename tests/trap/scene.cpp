// SPDX-License-Identifier: MIT
#include "trap/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "oiler/scene/read.hpp"
#include "trap/traps.hpp"

namespace oiler::trap {
namespace {

constexpr double smallest_tolerance = 1e-6;  ///< of the extent

/// The scene file. The default rate does not suit short scenes; few keep it.
std::string file_of(const Draft& draft, double duration, bool keeps_rate) {
    const double rate = std::clamp(std::ceil(4 / duration), 100.0, 1e6);
    return fmt::format("[scene]\naxes = {}\nduration = {}\n{}{}", draft.axes, duration,
                       keeps_rate ? "" : fmt::format("rate = {}\n", rate), draft.text);
}

/// The truth, if it is much better than any tolerance will be.
bool find_truth(Trap& trap) {
    try {
        trap.truth = std::make_unique<Truth>(trap.scene);
    } catch (const std::domain_error&) {
        return false;
    }
    trap.extent = static_cast<double>(trap.truth->extent(trap.scene.duration));
    return trap.truth->uncertainty() <= 1e-3 * smallest_tolerance * trap.extent;
}

Question question_of(Dice& dice, double extent, bool plain) {
    Question question;
    // Round-off is no motion.
    const double size = extent > 1e-15 ? extent : 1;
    question.tolerance =
        std::stod(fmt::format("{:.3g}", size * dice.log_uniform(smallest_tolerance, 0.3)));
    const int choice = dice.whole(0, 5);
    if (choice == 1 && !plain) question.meaning = Meaning::at_steps;
    if (choice == 2 && !plain) question.meaning = Meaning::display;
    if (choice == 3) question.gives_min_rate = true;
    if (choice == 4)
        for (int i = dice.whole(2, 4); i > 0; --i)
            question.methods.emplace_back(methods()[static_cast<std::size_t>(dice.whole(
                                                        0, static_cast<int>(methods().size()) - 1))]
                                              .name);
    return question;
}

}  // namespace

Trap make_trap(std::uint64_t seed, bool plain) {
    const Kind& kind = kinds()[seed % kinds().size()];
    Dice dice(seed);
    Draft draft;
    kind.make(dice, draft);
    // Longer runs than the truth can follow become as long as it can.
    double duration = dice.log_uniform(1e-3, 100);
    if (duration > draft.longest) duration = draft.longest * dice.uniform(0.3, 1);
    const bool keeps_rate = dice.chance(0.15);
    Trap trap{.kind = kind.name};
    // A motion that is not steady enough is cut short.
    do {
        trap.text = file_of(draft, std::stod(fmt::format("{:.3g}", duration)), keeps_rate);
        trap.scene = parse_scene(trap.text, "scene.toml");
        duration /= 4;
    } while (!find_truth(trap));
    trap.question = question_of(dice, trap.extent, plain);
    return trap;
}

}  // namespace oiler::trap
