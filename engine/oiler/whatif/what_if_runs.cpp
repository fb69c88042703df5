// SPDX-License-Identifier: MIT
#include "oiler/whatif/what_if_runs.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

#include "oiler/core/error.hpp"
#include "oiler/sim/bodies.hpp"

namespace oiler {
namespace {

using Times = std::vector<std::chrono::nanoseconds>;

constexpr double small = 1e-3;  // of a pixel
constexpr double frames_per_second = 60;

Rate rate_of_instants(Rate recorded) {
    recorded.steps *= instants_per_step;
    return recorded;
}

std::int64_t steps_of_frame(Rate rate) {
    return std::max<std::int64_t>(1, std::llround(1 / (rate.dt() * frames_per_second)));
}

/// Whether a game changed bodies or counts between two moments, apart from a restart.
bool has_event(const Moment& before, const Moment& after) {
    return before.cuts == after.cuts && !is_same_play(before, after);
}

/// Keeps the last 4096 times.
void keep(Times& times, std::chrono::nanoseconds time, std::int64_t step) {
    constexpr std::size_t most = 4096;
    if (times.size() < most)
        times.push_back(time);
    else
        times[static_cast<std::size_t>(step) % most] = time;
}

/// The mean without the fastest and the slowest quarter, ns; 0 of none. Clocks count in steps of
/// some 10 ns, so a median of short times would be 0 or a step.
double middle_mean(Times times) {
    if (times.empty()) return 0;
    std::ranges::sort(times);
    const auto quarter = static_cast<std::ptrdiff_t>(times.size() / 4);
    const auto sum = std::accumulate(times.begin() + quarter, times.end() - quarter,
                                     std::chrono::nanoseconds{0});
    return static_cast<double>(sum.count()) / static_cast<double>(std::ssize(times) - 2 * quarter);
}

/// The time that an empty Stopwatch measures, ns.
double time_of_stopwatch() {
    Times times(101);
    for (std::chrono::nanoseconds& time : times) {
        StepTimes sums;
        { const Stopwatch empty(&sums, &StepTimes::step); }
        time = std::chrono::nanoseconds(sums.step);
    }
    return middle_mean(times);
}

constexpr double pixels_of_height = 720;
constexpr std::size_t few_bodies = 64;
constexpr std::size_t many_bodies = 2000;

/// The number of instants from one comparison to the next. With many bodies, 960 comparisons a
/// second are enough, if one is in the middle of each step, where its line is farthest from the
/// motion.
std::int64_t stride_of(const SettingRun& recorded) {
    constexpr std::int64_t most = instants_per_step / 2;
    const std::size_t bodies = recorded.game().world().body_count();
    if (bodies <= few_bodies) return 1;
    std::int64_t stride = bodies > many_bodies ? most : 1;
    const double instants = instants_per_step / recorded.result().stepping.rate.dt();  // a second
    while (stride < most && instants >= 2 * 960 * static_cast<double>(stride)) stride *= 2;
    return stride;
}

/// The least rate of the reference, Hz: what a game does in its updates comes late by its step.
std::int64_t least_rate(const AnyGame& recorded) {
    return recorded.world().body_count() <= few_bodies ? 7680 : 960;
}
/// The number of steps of the reference in a recorded step: the least multiple of the compared
/// instants at which its rate is high enough.
std::int64_t reference_factor(const SettingRun& recorded) {
    const std::int64_t rate = recorded.result().stepping.rate.steps;
    const std::int64_t factor = (least_rate(recorded.game()) + rate - 1) / rate;
    return (factor + instants_per_step - 1) / instants_per_step * instants_per_step;
}
Stepping reference_stepping(const SettingRun& recorded) {
    Rate rate = recorded.result().stepping.rate;
    rate.steps *= reference_factor(recorded);
    return {.method = &find_method("rk4"), .rate = rate};
}
/// Slightly less than half the rate of the reference: both begin a step at the same time only where
/// a recorded step begins. So events in a game's updates, such as bounces, are late by different
/// times.
Stepping check_stepping(const SettingRun& recorded) {
    Stepping stepping = reference_stepping(recorded);
    stepping.rate = recorded.result().stepping.rate;
    stepping.rate.steps *= reference_factor(recorded) / 2 - 1;
    return stepping;
}

std::vector<std::unique_ptr<SettingRun>> runs_of(const RecordedPlay& play,
                                                 const std::vector<Stepping>& steppings,
                                                 const MakeGame& make) {
    std::vector<std::unique_ptr<SettingRun>> runs;
    runs.push_back(std::make_unique<SettingRun>(play.recording.header.stepping, play, make));
    for (const Stepping& stepping : steppings)
        runs.push_back(std::make_unique<SettingRun>(stepping, play, make));
    return runs;
}

}  // namespace

SettingRun::SettingRun(const Stepping& stepping, const RecordedPlay& play, const MakeGame& make)
    : result_{.stepping = stepping},
      inputs_(play.recording, stepping.rate, play.controls),
      recorded_rate_(play.recording.header.stepping.rate),
      ratio_(recorded_rate_, stepping.rate),
      instants_(rate_of_instants(recorded_rate_), stepping.rate) {
    Settings settings = play.settings;
    settings.stepping = stepping;
    game_ = make(settings);
    game_->world().require_applicable();
    game_->rehearse();
    game_->number_entities();
    game_->measure(times_);
}

void SettingRun::play_until(std::int64_t recorded) {
    play_until_instant(recorded * instants_per_step);
}

void SettingRun::play_until_instant(std::int64_t index, std::deque<TrueImpact>* impacts) {
    while (steps_ < instants_.last_until(index) && goes_on()) {
        const std::int64_t before = steps_;
        take_step();
        if (impacts && steps_ > before) add_impacts(*impacts);
    }
}

/// Adds the impacts of the last step.
void SettingRun::add_impacts(std::deque<TrueImpact>& impacts) const {
    const World& world = game_->world();
    const double rate = 1 / world.dt();
    for (const Impact& impact : world.impacts()) {
        const std::size_t row = world.row(impact.entity);
        const double radius = world.bodies().contact(row)->radius;
        const double step = static_cast<double>(steps_) + rate * (impact.time - world.time());
        impacts.push_back({instants_.other_step(step),
                           game_->cuts(),
                           {impact.entity, world.jumps(impact.entity),
                            impact.point + impact.normal * radius, world.number(impact.entity)}});
    }
}

void SettingRun::play_until(std::int64_t recorded, const TrueMotion& truth, double visible) {
    result_.distance_now = 0;
    const Rate rate = rate_of_instants(recorded_rate_);
    const std::deque<TrueMoment>& moments = truth.moments;
    auto next = std::ranges::partition_point(
        moments, [&](const TrueMoment& at) { return instants_.since(steps_, at.index) <= 0; });
    while (steps_ < ratio_.last_until(recorded) && goes_on()) {
        const bool is_compared = next != moments.end() && !result_.other_play_from &&
                                 instants_.since(steps_, next->index) <= 1;
        if (!is_compared) {
            take_step();
            continue;
        }
        const Moment before = moment();
        const std::int64_t step = steps_;
        take_step();
        if (steps_ == step) return;
        compare_impacts(before, truth.impacts, visible);
        for (; next != moments.end(); ++next) {
            const double alpha = instants_.since(step, next->index);
            if (alpha > 1) break;
            if (const auto apart = largest_distance(next->moment, before, moment(), alpha))
                note({rate.time(next->index), *apart, visible});
        }
    }
}

/// Compares the line of the last step with the corners of the true motion.
void SettingRun::compare_impacts(const Moment& before, const std::deque<TrueImpact>& impacts,
                                 double visible) {
    const std::int64_t step = steps_ - 1;
    auto next = std::ranges::partition_point(
        impacts, [&](const TrueImpact& at) { return instants_.since(step, at.index) < 0; });
    for (; next != impacts.end(); ++next) {
        const double alpha = instants_.since(step, next->index);
        if (alpha > 1) return;
        const auto apart = distance_of(next->body, before, moment(), alpha);
        if (apart && before.cuts == next->cuts && moment().cuts == next->cuts)
            note({next->index * rate_of_instants(recorded_rate_).dt(), *apart, visible});
    }
}

const Moment& SettingRun::moment() {
    if (!moment_) moment_ = moment_of(*game_);
    return *moment_;
}

void SettingRun::take_step() {
    times_ = {};
    moment_.reset();
    const std::int64_t before = game_->world().bodies().evaluations();
    try {
        steps_ += game_->step(steps_, 1, inputs_);
        game_->number_entities();  // a restart may have made the world anew
        // A world that a game makes anew counts from 0.
        const std::int64_t after = game_->world().bodies().evaluations();
        evaluations_ += after - (after < before ? 0 : before);
    } catch (const Error& error) {
        fail_with(error);
    }
    keep(updates_, std::chrono::nanoseconds(times_.update), steps_);
    if (times_.step > 0) keep(world_steps_, std::chrono::nanoseconds(times_.step), steps_);
}

void SettingRun::fail_with(const Error& error) {
    if (error.exit() != Exit::diverged && error.exit() != Exit::usage) throw error;
    result_.failure = error.what();
}

void SettingRun::compare(std::int64_t recorded, double time, const Moment& reference,
                         const AnyGame& true_game, double visible) {
    if (result_.other_play_from) return;
    if (failed()) return settle();
    const bool is_at_step = ratio_.has(recorded);
    const auto found =
        other_play_.compare(moment(), reference, time, is_at_step ? 0 : result_.stepping.rate.dt(),
                            [&](Entity body, bool is_of_truth) {
                                return (is_of_truth ? true_game : *game_).name_of(body);
                            });
    const auto apart =
        is_at_step && recorded > 0 && !found ? largest_distance(reference, moment()) : std::nullopt;
    if (apart) note({time, *apart, visible, true});
    settle_until(found ? found->from : other_play_.since());
    if (!found) return;
    notes_.clear();
    result_.other_play_from = found->from;
    result_.other_play = found->text;
}

void SettingRun::note(const Note& note) {
    result_.distance_now = std::max(result_.distance_now, note.apart.distance);
    notes_.push_back(note);
}

void SettingRun::settle_until(double time) {
    // A difference begins up to a recorded step before it is seen.
    const double certain = time - recorded_rate_.dt();
    const auto is_settled = [&](const Note& note) {
        return note.time < (note.apart.is_same_play ? time : certain);
    };
    for (const Note& note : notes_)
        if (is_settled(note)) count(note);
    std::erase_if(notes_, is_settled);
}

void SettingRun::count(const Note& note) {
    const double distance = note.apart.distance;
    if (note.is_at_step && !(distance <= result_.distance_at_steps))
        result_.distance_at_steps = distance;
    if (!(distance <= result_.distance)) {
        result_.distance = distance;
        result_.furthest = note.apart.body;
    }
    // The impacts of a step are compared before its instants.
    if (distance > note.visible)
        result_.visible_from = std::min(note.time, result_.visible_from.value_or(note.time));
}

void SettingRun::read(std::int64_t recorded, const std::vector<Reading>& truth) {
    if (failed() || !ratio_.has(recorded)) return;
    result_.readings = game_->readings();
    result_.true_readings = truth;
    result_.read_at = recorded_rate_.time(recorded);
}

void SettingRun::time_picture() {
    if (failed()) return;
    const auto start = std::chrono::steady_clock::now();
    try {
        const Picture picture = game_->picture();
        pictures_.push_back(std::chrono::steady_clock::now() - start);
    } catch (const Error& error) {
        fail_with(error);
    }
}

void SettingRun::time_drawing(DrawTimer& draw) {
    if (!failed()) drawings_.push_back(draw.time(game_->picture()));
}

WhatIfRun SettingRun::finish() const {
    const double stopwatch = time_of_stopwatch();
    const auto typical = [&](const Times& times) {
        return std::max(0.0, middle_mean(times) - stopwatch);
    };
    WhatIfRun result = result_;
    const double steps_per_frame = 1 / (result.stepping.rate.dt() * frames_per_second);
    result.costs = {
        .update = steps_per_frame * typical(updates_),
        .step = steps_per_frame * typical(world_steps_),
        .picture = typical(pictures_),
        .draw = drawings_.empty() ? std::numeric_limits<double>::quiet_NaN() : typical(drawings_)};
    if (steps_ > 0)
        result.evaluations = static_cast<double>(evaluations_) /
                             (result.stepping.rate.dt() * static_cast<double>(steps_));
    return result;
}

WhatIfRuns::WhatIfRuns(const RecordedPlay& play, const std::vector<Stepping>& steppings,
                       const MakeGame& make)
    : recording_(play.recording),
      replay_(recording_, play.name, {}, play.plays_on),
      runs_(runs_of(play, steppings, make)),
      reference_(reference_stepping(*runs_.front()), play, make),
      check_(check_stepping(*runs_.front()), play, make) {
    const double dt = recording_.header.stepping.rate.dt();
    for (const Stepping& stepping : steppings)
        longest_ =
            std::max<std::int64_t>(longest_, std::llround(std::ceil(stepping.rate.dt() / dt)));
}

bool WhatIfRuns::play_part(std::int64_t step) {
    if (instant_ < step * instants_per_step) {
        play_instant();
        return false;
    }
    if (run_ == 0) {
        is_known_ = play_check(step);
        before_ = runs_.front()->moment();
    }
    runs_[run_]->play_until(step, truth_, visible());
    if (++run_ < runs_.size()) return false;
    compare(step);
    run_ = 0;
    return true;
}

void WhatIfRuns::play_instant() {
    instant_ = instant_ < 0 ? 0 : instant_ + stride_of(*runs_.front());
    reference_.play_until_instant(instant_, &impacts_);
    if (certain_) moments_.push_back({instant_, moment_of(reference_.game())});
}

void WhatIfRuns::compare(std::int64_t step) {
    step_ = step;
    if (!has_events_at_steps_) has_events_at_steps_ = has_event(before_, runs_.front()->moment());
    const std::vector<Reading> truth = reference_.game().readings();
    for (SettingRun* const run : {&reference_, &check_}) run->read(step, truth);
    for (const auto& run : runs_) run->read(step, truth);
    if (const AnyGame& game = runs_.front()->game(); game.loop().quits())
        replay_.compare_end(runs_.front()->steps(), true);
    if (step > 0 && !runs_.front()->failed()) replay_.after(step - 1, runs_.front()->game());
    if (!is_known_) {
        for (const auto& run : runs_) run->settle();
        return;
    }
    const double time = recording_.header.stepping.rate.time(step);
    for (const auto& run : runs_)
        run->compare(step, time, truth_.moments.back().moment, reference_.game(), visible());
    if (KnownError(recorded().distance, uncertainty_).most() <= pixel_) pixel_until_ = time;
}

void WhatIfRuns::compare_end() {
    SettingRun& recorded = *runs_.front();
    if (!recording_.quits || recorded.failed()) return;
    // A game quits in the update of a step that it does not take.
    recorded.play_until(recording_.steps + 1);
    replay_.compare_end(recorded.steps(), recorded.game().loop().quits());
}

bool WhatIfRuns::play_check(std::int64_t step) {
    check_.play_until(step);
    for (SettingRun* const run : {&reference_, &check_})
        if (run->failed())
            fail(Exit::diverged, "the reference ({}) failed: {}",
                 table_text(run->result().stepping), run->result().failure);
    std::vector<TrueMoment> moments = std::exchange(moments_, {});
    std::deque<TrueImpact> impacts = std::exchange(impacts_, {});
    const std::int64_t oldest = (step - longest_ - 1) * instants_per_step;
    const auto forget = [oldest](auto& past) {
        while (!past.empty() && past.front().index < oldest) past.pop_front();
    };
    forget(truth_.moments);
    forget(truth_.impacts);
    if (!certain_ || !check(step, moments.back().moment)) return false;
    std::ranges::move(moments, std::back_inserter(truth_.moments));
    std::ranges::sort(impacts, {}, &TrueImpact::index);
    std::ranges::move(impacts, std::back_inserter(truth_.impacts));
    return true;
}

bool WhatIfRuns::check(std::int64_t step, const Moment& moment) {
    const Rate rate = recording_.header.stepping.rate;
    const double time = rate.time(step);
    if (step % steps_of_frame(rate) == 0)
        pixel_ = static_cast<double>(reference_.game().picture().camera.height) / pixels_of_height;
    check_.compare(step, time, moment, reference_.game(), pixel_);
    certain_ = !check_.result().other_play_from && !check_.result().visible_from;
    if (check_.result().visible_from && small_until_)
        tenfold_ = (*check_.result().visible_from - *small_until_) / std::log10(1 / small);
    if (!certain_ || check_.differs()) return false;
    certain_until_ = time;
    if (const double distance = check_.result().distance; !std::isnan(distance))
        uncertainty_ = distance;
    if (uncertainty_ <= small * pixel_) small_until_ = time;
    return true;
}

std::shared_ptr<const DrawnStep> WhatIfRuns::drawn() const {
    const Moment& after = runs_.front()->moment();
    const std::int64_t last = step_ * instants_per_step;
    const std::deque<TrueMoment>& known = truth_.moments;
    const auto first = std::ranges::find(known, last - instants_per_step, &TrueMoment::index);
    if (first == known.end() || known.back().index != last || before_.cuts != after.cuts)
        return nullptr;
    auto drawn = std::make_shared<DrawnStep>(DrawnStep{before_, after});
    std::transform(first, known.end(), std::back_inserter(drawn->truth),
                   [](const TrueMoment& one) { return one.moment; });
    return drawn;
}

DrawnStep::Places DrawnStep::at(double alpha) const {
    const double place = alpha * static_cast<double>(truth.size() - 1);
    const auto instant = std::min(static_cast<std::size_t>(place), truth.size() - 2);
    return {between(before, after, alpha),
            between(truth[instant], truth[instant + 1], place - static_cast<double>(instant))};
}

void WhatIfRuns::time_pictures(DrawTimer* draw) {
    for (const auto& run : runs_) run->time_picture();
    if (draw)  // afterwards, because it empties the caches of the processor
        for (const auto& run : runs_) run->time_drawing(*draw);
}

WhatIf WhatIfRuns::result() const {
    WhatIf result{.duration = recording_.header.stepping.rate.time(recording_.steps),
                  .measured_until = recording_.header.stepping.rate.time(step_),
                  .certain_until = certain_until_,
                  .pixel_until = pixel_until_,
                  .tenfold = tenfold_,
                  .has_events_at_steps = has_events_at_steps_,
                  .uncertainty = uncertainty_,
                  .pixel = pixel_,
                  .reference = reference_.finish(),
                  .check = check_.finish()};
    for (const auto& run : runs_) result.runs.push_back(run->finish());
    return result;
}

}  // namespace oiler
