// SPDX-License-Identifier: MIT
#include "oiler/whatif/what_if.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <sstream>

#include "oiler/core/error.hpp"
#include "oiler/core/length_text.hpp"
#include "oiler/core/step_clock.hpp"
#include "oiler/process/console.hpp"
#include "oiler/process/interrupt.hpp"
#include "oiler/whatif/what_if_runs.hpp"

namespace oiler {
namespace {

constexpr std::int64_t pictures_timed = 15;

std::vector<std::string> split(const std::string& words, char separator) {
    std::vector<std::string> parts;
    // getline returns an empty last word only before a separator.
    std::istringstream stream(words + separator);
    for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
    return parts;
}

/// The kinds of words that a setting has had so far.
struct Named {
    bool rate = false;
    bool method = false;
    bool precision = false;
    bool damping = false;
};

void require_first(bool& named, const std::string& word) {
    if (named) fail(Exit::usage, "'{}' is the second of its kind", word);
    named = true;
}

void apply_word(const std::string& word, Stepping& stepping, Named& named) {
    const char* const end = word.data() + word.size();
    if (word.empty()) fail(Exit::usage, "a word is missing beside a comma or an @");
    std::int64_t rate = 0;
    const auto [last, error] = std::from_chars(word.data(), end, rate);
    if (error == std::errc() && last == end) {
        require_first(named.rate, word);
        if (rate < 1 || rate > StepClock::largest_rate)
            fail(Exit::usage, "a rate is from 1 to {} Hz", StepClock::largest_rate);
        stepping.rate = {rate};
    } else if (const auto precision = find_precision(word)) {
        require_first(named.precision, word);
        stepping.precision = *precision;
    } else if (const auto damping = find_damping(word)) {
        require_first(named.damping, word);
        stepping.damping = damping;
    } else if (std::isdigit(static_cast<unsigned char>(word.front())) != 0) {
        fail(Exit::usage, "'{}': expected a whole rate in Hz, for example 60", word);
    } else {
        require_first(named.method, word);
        stepping.method = &find_method(word);
    }
}

Stepping parse_setting(const std::string& setting, const Stepping& recorded) {
    Stepping stepping = recorded;
    Named named;
    try {
        for (const std::string& word : split(setting, '@')) apply_word(word, stepping, named);
    } catch (const Error& error) {
        fail(Exit::usage,
             "--what-if {}: {}; give settings such as 30,rk4,velocity_verlet@120,float", setting,
             error.what());
    }
    return stepping;
}

bool is_applicable(const Settings& settings, const MakeGame& make) {
    try {
        make(settings)->world().require_applicable();
        return true;
    } catch (const Error& error) {
        if (error.exit() != Exit::usage) throw;
        return false;
    }
}

constexpr const char* legend = R"(
distance: largest distance of a body, as it is drawn, from the same body of the reference.
at steps: the same where a step of the setting and a recorded one begin.
readings: at the end, or at the last recorded step that a setting has, too, and what they are off there.
1 px: the time from which it certainly exceeds a pixel of the game's camera, at 720 lines, to a
   sixteenth of a recorded step.
other play: the time from which bodies, restarts or counts differ; nothing later is counted.
ns per frame: at 60 frames per second, means without the fastest and the slowest quarter.
<: below 10 times the difference between the reference and the run that checks it. What a game does
   in its own updates is late by up to a step of the reference in both, and may be missing there.
)";

/// Formats a time in s; "-" if there is none.
std::string time_cell(const std::optional<double>& time) {
    return time ? fmt::format("{:.3f}", *time) : "-";
}
std::string cost_cell(double cost) { return std::isnan(cost) ? "-" : fmt::format("{:.0f}", cost); }
/// Formats the size of an error, or its limit if it is too small to be certain.
std::string error_cell(const KnownError& error, std::string_view unit) {
    if (error.state() == KnownError::State::unknown) return "-";
    if (!error.is_certain()) return "< " + amount_text(error.limit(), unit);
    return amount_text(std::abs(error.value()), unit);
}

const Reading* find_reading(const std::vector<Reading>& readings, const std::string& name) {
    const auto found = std::ranges::find(readings, name, &Reading::name);
    return found == readings.end() ? nullptr : &*found;
}

/// "2.025 m", "300"
std::string value_text(const Reading& reading) {
    return fmt::format("{:.6g}{}{}", reading.value, reading.unit.empty() ? "" : " ", reading.unit);
}

bool is_count(const Reading& reading) {
    return reading.unit.empty() && reading.value == std::round(reading.value);
}

/// The error of a reading, NaN if the reference lacks it.
double error_of(const Reading& reading, const WhatIfRun& run) {
    const Reading* const truth = find_reading(run.true_readings, reading.name);
    return reading.value - (truth ? truth->value : std::numeric_limits<double>::quiet_NaN());
}
/// The uncertainty of a reading of the reference; infinite if the check run lacks the reading.
double uncertainty_of(const std::string& reading, const WhatIf& result) {
    const Reading* const check = find_reading(result.check.readings, reading);
    return check ? std::abs(error_of(*check, result.check))
                 : std::numeric_limits<double>::infinity();
}

std::string setting_cell(const WhatIfRun& run, const WhatIf& result) {
    return table_text(run.stepping) + (&run == result.runs.data() ? " *" : "");
}

std::string table_of_runs(const WhatIf& result) {
    std::string text = fmt::format("  {:<38} {:>10} {:>10} {:>8} {:>11} {:>36}\n", "", "distance",
                                   "at steps", "1 px", "other play", "ns per frame");
    text += fmt::format("  {:<38} {:>10} {:>10} {:>8} {:>11} {:>8} {:>8} {:>8} {:>9}\n",
                        "* as recorded", "", "", "from, s", "from, s", "update", "step", "picture",
                        "draw");
    for (const WhatIfRun& run : result.runs)
        text += fmt::format("  {:<38} {:>10} {:>10} {:>8} {:>11} {:>8} {:>8} {:>8} {:>9}\n",
                            setting_cell(run, result), error_cell(result.error_of(run), "m"),
                            error_cell({run.distance_at_steps, result.uncertainty}, "m"),
                            time_cell(run.visible_from), time_cell(run.other_play_from),
                            cost_cell(run.costs.update), cost_cell(run.costs.step),
                            cost_cell(run.costs.picture), cost_cell(run.costs.draw));
    for (const WhatIfRun& run : result.runs)
        if (!run.failure.empty())
            text += fmt::format("  {} failed: {}\n", table_text(run.stepping), run.failure);
    for (const WhatIfRun& run : result.runs)
        if (run.other_play_from)
            text +=
                fmt::format("  other play of {}: {}\n", table_text(run.stepping), run.other_play);
    return text;
}

std::string reading_error_cell(const Reading& own, const WhatIfRun& run, const WhatIf& result) {
    const KnownError error(error_of(own, run), uncertainty_of(own.name, result));
    if (!error.is_certain()) return is_count(own) ? "unknown" : error_cell(error, own.unit);
    const char* const sign = error.value() < 0 ? "-" : error.value() > 0 ? "+" : "";
    return sign + error_cell(error, own.unit);
}

/// Whether all runs end with the reading of the reference, which is certain.
bool is_the_same_everywhere(const Reading& reading, const WhatIf& result) {
    return uncertainty_of(reading.name, result) == 0 &&
           std::ranges::all_of(result.runs, [&](const WhatIfRun& run) {
               const Reading* const own = find_reading(run.readings, reading.name);
               return own && own->value == reading.value;
           });
}

std::string table_of_reading(const Reading& reading, const WhatIf& result) {
    if (is_the_same_everywhere(reading, result))
        return fmt::format("\n{} at the end: {} at each setting\n", reading.name,
                           value_text(reading));
    std::string text = fmt::format(
        "\n{} at the end{}: {}\n", reading.name,
        result.certain_until < result.duration ? ", later than the reference is certain" : "",
        value_text(reading));
    for (const WhatIfRun& run : result.runs) {
        const Reading* const own = find_reading(run.readings, reading.name);
        const std::string error = own ? reading_error_cell(*own, run, result) : "-";
        text += fmt::format(
            "  {:<38} {:>12} {:>10}{}\n", setting_cell(run, result), own ? value_text(*own) : "-",
            error,
            own && run.read_at < result.duration ? fmt::format("  at {:.3f} s", run.read_at) : "");
    }
    return text;
}

Json readings_to_json(const WhatIfRun& run, const WhatIf& result) {
    Json all = Json::array();
    for (const Reading& reading : run.readings)
        all.push_back({{"name", reading.name},
                       {"unit", reading.unit},
                       {"time", run.read_at},
                       {"value", reading.value},
                       {"difference", error_of(reading, run)},
                       {"uncertainty", uncertainty_of(reading.name, result)}});
    return all;
}

Json to_json(const WhatIfRun& run, const WhatIf& result) {
    const auto time = [](const std::optional<double>& at) { return at ? Json(*at) : Json(); };
    Json json = to_json(run.stepping);
    json["damping"] = run.stepping.damping ? Json(damping_name(run.stepping)) : Json();
    json["distance"] = run.distance;
    json["distance_at_steps"] = run.distance_at_steps;
    json["visible_from"] = time(run.visible_from);
    json["other_play_from"] = time(run.other_play_from);
    json["other_play"] = run.other_play_from ? Json(run.other_play) : Json();
    json["failure"] = run.failure.empty() ? Json() : Json(run.failure);
    json["readings"] = readings_to_json(run, result);
    json["ns_per_frame"] = {{"update", run.costs.update},
                            {"step", run.costs.step},
                            {"picture", run.costs.picture},
                            {"draw", run.costs.draw}};
    return json;
}

}  // namespace

std::vector<Stepping> parse_what_if(const std::string& words, const Stepping& recorded) {
    std::vector<Stepping> steppings;
    for (const std::string& setting : split(words, ',')) {
        steppings.push_back(parse_setting(setting, recorded));
        if (std::ranges::count(steppings, steppings.back()) > 1)
            fail(Exit::usage, "--what-if {}: it comes twice; name it once", setting);
    }
    return steppings;
}

std::vector<Stepping> usual_what_if(const Settings& recorded, const MakeGame& make) {
    const Stepping& now = recorded.stepping;
    std::vector<Stepping> steppings;
    const auto add = [&](auto change) {
        Settings settings = recorded;
        change(settings.stepping);
        if (is_applicable(settings, make)) steppings.push_back(settings.stepping);
    };
    if (now.rate.steps % 2 == 0) add([](Stepping& s) { s.rate.steps /= 2; });
    add([](Stepping& s) { s.rate.steps *= 2; });
    for (const char* name : {"semi_implicit_euler", "velocity_verlet", "rk4"})
        if (now.method->name != name) add([&](Stepping& s) { s.method = &find_method(name); });
    add([](Stepping& s) {
        s.precision = s.precision == Precision::single ? Precision::double_ : Precision::single;
    });
    return steppings;
}

std::optional<WhatIf> measure_what_if(const RecordedPlay& play,
                                      const std::vector<Stepping>& steppings, const MakeGame& make,
                                      DrawTimer* draw, bool quiet) {
    WhatIfRuns runs(play, steppings, make);
    const std::int64_t steps = play.recording.steps;
    const std::int64_t stride = std::max<std::int64_t>(1, steps / pictures_timed);
    Progress progress(quiet, "steps", steps);
    for (std::int64_t step = 0; step <= steps; ++step) {
        if (Interrupt::requested()) return std::nullopt;
        runs.play_until(step);
        if (step % stride == 0) runs.time_pictures(draw);
        progress.show(step);
    }
    WhatIf result = runs.result();
    runs.compare_end();
    return result;
}

std::string text_of(const WhatIf& result, std::string_view game) {
    std::string text =
        fmt::format("{}: {:g} s of play\nreference: {}; at {} Hz it differs by {}\n", game,
                    result.duration, table_text(result.reference.stepping),
                    result.check.stepping.rate.steps, length_text(result.uncertainty));
    if (result.certain_until < result.duration)
        text += fmt::format("Distances are counted until {:.3f} s: there, these two part.\n",
                            result.certain_until);
    text += '\n';
    text += table_of_runs(result);
    for (const Reading& reading : result.reference.readings)
        text += table_of_reading(reading, result);
    return text + legend;
}

Json to_json(const WhatIf& result, std::string_view game) {
    Json reference = to_json(result.reference.stepping);
    reference["uncertainty"] = result.uncertainty;
    reference["certain_until"] = result.certain_until;
    reference["readings"] = readings_to_json(result.reference, result);
    Json json{{"scene", game}, {"time", result.duration}, {"reference", reference}};
    json["settings"] = Json::array();
    for (const WhatIfRun& run : result.runs) json["settings"].push_back(to_json(run, result));
    return json;
}

}  // namespace oiler
