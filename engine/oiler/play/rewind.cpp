// SPDX-License-Identifier: MIT
#include "oiler/play/rewind.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>

namespace oiler {
namespace {

using Clock = std::chrono::steady_clock;

/// The least number of steps between two copies.
constexpr std::int64_t least_steps = 16;

}  // namespace

/// The inputs of past steps.
class Rewind::Past final : public InputSource {
public:
    explicit Past(const std::deque<Span>& spans) : spans_(spans) {}

    [[nodiscard]] Input next(std::int64_t step) override {
        while (at_ + 1 < spans_.size() && spans_[at_ + 1].first <= step) ++at_;
        return spans_[at_].input;
    }

private:
    const std::deque<Span>& spans_;
    std::size_t at_ = 0;
};

Rewind::Rewind(AnyGame& game, InputSource& inputs, const Limits& limits)
    : game_(game), inputs_(inputs), limits_(limits) {
    keep(0);
}

Input Rewind::next(std::int64_t step) {
    if (step < last_) forget_after(step);
    at_ = last_ = step;
    Input input = inputs_.next(step);
    if (!has_past() || (!spans_.empty() && spans_.back().input == input)) return input;
    if (spans_.size() >= limits_.inputs) forget_oldest(step);
    spans_.push_back({step, input});
    return input;
}

void Rewind::forget_after(std::int64_t step) {
    while (has_past() && copies_.back().step > step) copies_.pop_back();
    while (!spans_.empty() && spans_.back().first >= step) spans_.pop_back();
    last_ = step;
}

void Rewind::forget_oldest(std::int64_t step) {
    if (copies_.size() < 2) add_copy(step);
    copies_.erase(copies_.begin());
    // The last step before the first copy keeps its input.
    while (spans_.size() > 1 && spans_[1].first < first()) spans_.pop_front();
}

void Rewind::keep(std::int64_t step) {
    if (step > at_ && at_ < last_) forget_after(at_);  // a game without input never calls next()
    at_ = step;
    last_ = std::max(last_, step);
    if (game_.world().body_count() > limits_.bodies) {
        copies_.clear();
        spans_.clear();
    } else if (!has_past() ||
               (step - copies_.back().step >= least_steps && Clock::now() >= next_copy_)) {
        add_copy(step);
    }
}

void Rewind::add_copy(std::int64_t step) {
    const Clock::time_point start = Clock::now();
    const std::size_t bodies = std::max<std::size_t>(1, game_.world().body_count());
    const std::size_t most = std::clamp<std::size_t>(limits_.copied / bodies, 2, limits_.copies);
    while (copies_.size() >= most) thin_out();
    copies_.insert(first_after(step), {step, game_.clone()});
    const Clock::time_point end = Clock::now();
    next_copy_ = end + limits_.time_per_copy * (end - start);
}

/// Removes the copy whose neighbours are closest to each other, relative to its age; never the
/// first.
void Rewind::thin_out() {
    const auto crowding = [&](std::size_t i) {
        const std::int64_t after = i + 1 < copies_.size() ? copies_[i + 1].step : last_;
        return static_cast<double>(last_ - copies_[i].step) /
               static_cast<double>(after - copies_[i - 1].step);
    };
    std::size_t most_crowded = 1;
    for (std::size_t i = 2; i < copies_.size(); ++i)
        if (crowding(i) > crowding(most_crowded)) most_crowded = i;
    copies_.erase(copies_.begin() + static_cast<std::ptrdiff_t>(most_crowded));
}

std::vector<Rewind::Copy>::iterator Rewind::first_after(std::int64_t step) {
    return std::ranges::upper_bound(copies_, step, {}, &Copy::step);
}

Input Rewind::go_to(std::int64_t step) {
    assert(step >= first() && step <= last());
    const Copy& start = *std::prev(first_after(step));
    std::int64_t at = start.step;
    game_.assign(*start.game);
    Past past(spans_);
    while (at < step) {
        // Copies at half the distance: later steps back start close to their target.
        const std::int64_t left = step - at;
        const std::int64_t count = left > least_steps ? left / 2 : left;
        game_.step(at, count, past);
        at += count;
        if (at < step) add_copy(at);
    }
    at_ = step;
    const auto later = std::ranges::lower_bound(spans_, step, {}, &Span::first);
    return later == spans_.begin() ? Input{} : std::prev(later)->input;
}

void Rewind::forget(std::int64_t step) {
    copies_.clear();
    spans_.clear();
    at_ = last_ = step;
    keep(step);
}

}  // namespace oiler
