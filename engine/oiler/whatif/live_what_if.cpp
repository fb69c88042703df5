// SPDX-License-Identifier: MIT
#include "oiler/whatif/live_what_if.hpp"

#include <chrono>
#include <utility>

namespace oiler {
namespace {

constexpr std::chrono::microseconds time_of_frame{200};  // a timer is late by some 0.1 ms

}  // namespace

LiveWhatIf::LiveWhatIf(RecordedPlay play, const MakeGame& make, Pace pace)
    : make_(make), play_(std::move(play)) {
    play_.settings.threads = 1;
    if (pace != Pace::own) aside_ = std::make_unique<Aside>(pace == Pace::aside);
}

AlongFrom LiveWhatIf::start_of_game() const {
    return {.play = play_, .make = make_, .is_start = true};
}

void LiveWhatIf::start(std::int64_t first) { measure(first, start_of_game()); }

void LiveWhatIf::repeat(std::int64_t first) {
    AlongFrom from = start_of_game();
    from.may_repeat = true;
    measure(first, std::move(from));
}

void LiveWhatIf::start_from(const AnyGame& game, std::int64_t first) {
    set_stepping(game.world().settings().stepping);
    measure(
        first,
        {.play = play_,
         .make = [now = std::shared_ptr<const AnyGame>(game.clone())](const Settings& settings) {
             std::unique_ptr<AnyGame> run = now->clone();
             run->set_stepping(settings.stepping);
             return run;
         }});
}

void LiveWhatIf::measure(std::int64_t first, AlongFrom from) {
    first_ = first;
    before_ = {};
    is_measuring_ = true;
    if (aside_) {
        aside_->begin(std::move(from));
        figures_ = aside_->play_until(0, time_of_frame);
    } else {
        own_ = std::make_unique<PlayAlong>(std::move(from), own_.get());
        figures_ = own_->figures();
    }
}

void LiveWhatIf::add(std::int64_t step, const Input& input) {
    if (!is_measuring_) return;
    for (const InputEvent& event : events_between(before_, input)) {
        if (aside_)
            aside_->add({step - first_, event});
        else
            own_->add({step - first_, event});
    }
    before_ = input;
}

void LiveWhatIf::play_until(std::int64_t step) {
    if (!is_measuring_) return;
    if (aside_) {
        figures_ = aside_->play_until(step - first_, time_of_frame);
        return;
    }
    own_->has_come_to(step - first_);
    while (own_->is_behind()) own_->go_on();
    own_->judge();
    figures_ = own_->figures();
}

std::vector<Ghost> LiveWhatIf::ghosts(std::int64_t step, double alpha) const {
    if (!figures_.last || behind(step) > 0) return {};
    const DrawnStep::Places places = figures_.last->at(alpha);
    return ghosts_of(places.run, places.truth);
}

void LiveWhatIf::stop(std::string reason) {
    is_measuring_ = false;
    figures_ = {
        .begin = figures_.begin, .verdict = {.text = std::move(reason)}, .has_stopped = true};
}

}  // namespace oiler
