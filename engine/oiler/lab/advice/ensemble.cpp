// SPDX-License-Identifier: MIT
#include "oiler/lab/advice/search.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "oiler/core/error.hpp"

namespace oiler::lab {
namespace {

constexpr double perturbation = 1e-3;
/// The fraction of an advised rate at which the pre-flight must not warn, either.
constexpr double reserve = 0.95;

double size_of(const Reference& reference) {
    if (!rests(reference)) return reference.extent;
    return reference.coordinate > 0 ? reference.coordinate : 1;
}

}  // namespace

std::string Ensemble::objection(const Stepping& choice) {
    for (const Known& known : known_)
        if (known.choice == choice) return known.objection;
    std::string text = warning(choice);
    if (text.empty()) text = judge_members(choice);
    if (!stopped_()) known_.push_back({choice, text});
    return text;
}

/// A warning before the run at this rate or slightly below it; empty if there is none.
std::string Ensemble::warning(Stepping choice) const {
    const auto warning_at = [&](std::int64_t rate) -> std::string {
        choice.rate.steps = rate;
        const auto steps = static_cast<std::int64_t>(scene_.duration * static_cast<double>(rate));
        const auto warnings = make_world(scene_, Settings{choice}).instabilities(steps, 1);
        return warnings.empty() ? "" : warnings.front();
    };
    const std::int64_t rate = choice.rate.steps;
    if (std::string at_rate = warning_at(rate); !at_rate.empty()) return at_rate;
    const auto lower = static_cast<std::int64_t>(reserve * static_cast<double>(rate));
    const std::string below = lower > 0 ? warning_at(lower) : "";
    return below.empty() ? "" : fmt::format("already at {} Hz, {}", lower, below);
}

void Ensemble::make_members() {
    is_made_ = true;
    // Many independent bodies are many starts already. A reference of fine steps takes as much work
    // as all else.
    constexpr std::size_t many = 1000;
    const bool shows_many = reference_.closed_form && reference_.motion->bodies() >= many;
    const std::uint64_t count = shows_many ? 0 : reference_.closed_form ? 3 : 1;
    const double size = size_of(reference_);
    ReferenceEffort effort{.wanted = required_reference_error(requirements_) / 2};
    effort.stopped = stopped_;
    for (std::uint64_t seed = 1; seed <= count && !stopped_(); ++seed) {
        Member member{.reference = {}, .requirements = requirements_};
        try {
            member.reference = make_reference(
                scene_, effort, {seed, perturbation * size, perturbation * reference_.speed});
            if (member.requirements.position_error && rests(reference_))
                member.requirements.position_error =
                    std::max(*member.requirements.position_error, 2 * perturbation * size);
            if (stopped_()) return;
            require_judgeable(scene_, member.reference, member.requirements);
            members_.push_back(std::move(member));
        } catch (const Error& error) {
            // A perturbed motion without a reference cannot be judged.
            if (error.exit() != Exit::usage && error.exit() != Exit::diverged) throw;
        }
    }
}

std::string Ensemble::judge_members(const Stepping& choice) {
    if (!is_made_) make_members();
    for (const Member& member : members_) {
        const Judgement judgement =
            judge(scene_, Settings{choice}, member.reference,
                  {.display = requirements_.display, .stopped = meter_.counting(*choice.method)});
        if (!judgement.stable) return "a start perturbed by 0.1 % is unstable";
        const double times = excess(judgement, member.requirements);
        if (times > 1)
            return fmt::format("a start perturbed by 0.1 % has {:.3g} times the error allowed",
                               times);
    }
    return "";
}

}  // namespace oiler::lab
