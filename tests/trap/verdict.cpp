// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "oiler/core/error.hpp"
#include "support/shell.hpp"
#include "trap/traps.hpp"

namespace oiler::trap {
namespace {

using Json = nlohmann::json;

std::optional<Damping> damping_of(const Json& row) {
    const std::string name = row.value("damping", Json()).is_string() ? row["damping"] : "";
    if (name == "kick") return Damping::in_kick;
    if (name == "drift") return Damping::in_drift;
    return {};
}

Told told_by(const Json& json, bool plain) {
    const Json& row = json.at("advice");
    const Real floor = json.at("reference").at("position_floor").get<double>();
    const auto error = [&](const char* name) {
        const Json& number = row.at(name);
        return number.is_null() ? floor : static_cast<Real>(number.get<double>());
    };
    Told told{.drawn = error("position_error")};
    if (!plain || row.contains("step_error")) told.at_steps = error("step_error");
    if (!plain) (void)row.at("damping");
    told.stepping.method = &find_method(row.at("method").get<std::string>());
    told.stepping.rate = Rate{row.at("rate").get<std::int64_t>()};
    told.stepping.precision =
        row.at("precision") == "float" ? Precision::single : Precision::double_;
    told.stepping.damping = damping_of(row);
    return told;
}

std::string last_line(std::string text) {
    while (text.ends_with('\n')) text.pop_back();
    return text.substr(text.rfind('\n') + 1);
}

/// Reads the advice; says in the message why it cannot.
void read(const std::string& text, bool plain, Answer& answer) {
    try {
        const Json json = Json::parse(text);
        if (json.at("meets").get<bool>() != (answer.exit == 0))
            throw std::runtime_error("the exit code and the advice differ");
        if (answer.exit == 0)
            answer.told = told_by(json, plain);
        else
            answer.ended_early = json.at("ended_early").get<bool>();
    } catch (const std::exception& error) {
        answer.exit = -1;
        answer.message = error.what();
    }
}

constexpr Real least_told = 0.95L;      ///< of the truth
constexpr Real clearly_met = 0.9L;      ///< of the tolerance
constexpr Real most_body_steps = 1e8L;  ///< of a setting that refutes an exit of 1
constexpr std::int64_t most_rate = 1'000'000;

Real largest_coordinate(Truth& truth) {
    truth.prepare(1, 0);
    Real largest = 0;
    for (const Point& point : truth.sample(0))
        for (const Real number : point) largest = std::max(largest, std::abs(number));
    return largest;
}

/// Below this, a distance from the truth is round-off, m.
Real round_off(const Trap& trap) {
    return 1e-13L * static_cast<Real>(trap.extent) +
           1e-17L * (1 + largest_coordinate(*trap.truth)) + 2 * trap.truth->uncertainty();
}

bool lies(Real told, Real truth) { return told < least_told * truth; }

Judgement judge_advice(const Trap& trap, const Told& told) {
    const Question& question = trap.question;
    const Errors truth = measure(trap.scene, told.stepping, *trap.truth);
    std::string words =
        fmt::format("{}: drawn {:.3g} (told {:.3g}) m, at the steps {:.3g} (told {}) m",
                    describe(told.stepping), truth.drawn, told.drawn, truth.at_steps,
                    told.at_steps ? fmt::format("{:.3g}", *told.at_steps) : "-");
    // Under --display the drawn error is that of its frames and of the steps.
    Real drawn = truth.drawn;
    Real meant = question.meaning == Meaning::at_steps ? truth.at_steps : drawn;
    if (question.meaning == Meaning::display) {
        meant = display_error(trap.scene, told.stepping, *trap.truth);
        drawn = std::max(meant, truth.at_steps);
        words += fmt::format(", displayed {:.3g} m", meant);
    }
    if (meant > question.tolerance)
        return {Verdict::over,
                fmt::format("{}; {:.3g} × the tolerance", words, meant / question.tolerance)};
    const Real small = round_off(trap);
    if (lies(told.drawn, drawn - small) ||
        (told.at_steps && lies(*told.at_steps, truth.at_steps - small)))
        return {Verdict::lie, words};
    return {Verdict::honest, words};
}

std::vector<const Method*> candidates(const Question& question) {
    std::vector<std::string> names = question.methods;
    if (names.empty())
        names = {"exact", "velocity_verlet", "rk4", "blanes_moan_srkn11b", "implicit_midpoint"};
    std::vector<const Method*> list;
    for (const std::string& name : names) list.push_back(&find_method(name));
    return list;
}

/// Whether a setting clearly meets the tolerance. Methods that cannot step the scene do not.
bool meets(const Trap& trap, const Stepping& stepping, Real samples) {
    const Real enough = clearly_met * static_cast<Real>(trap.question.tolerance);
    try {
        return error_of(trap.scene, stepping, *trap.truth, trap.question.meaning,
                        {.samples = samples, .enough = enough}) <= enough;
    } catch (const Error&) {
        return false;
    }
}

/// A setting that meets the tolerance, from the lowest rates to the highest. Few samples may miss
/// the steps with impacts.
std::optional<Stepping> find_setting(const Trap& trap) {
    const Real most = most_body_steps / static_cast<Real>(trap.scene.duration) /
                      static_cast<Real>(trap.truth->size());
    const auto highest = static_cast<std::int64_t>(std::clamp(most, Real(1), Real(most_rate)));
    std::vector<std::int64_t> rates;
    for (std::int64_t rate = 1; rate < highest; rate *= 4) rates.push_back(rate);
    rates.push_back(highest);
    for (const std::int64_t rate : rates)
        for (const Method* method : candidates(trap.question))
            if (const Stepping stepping{.method = method, .rate = Rate{rate}};
                meets(trap, stepping, 3e6L) && meets(trap, stepping, 1e9L))
                return stepping;
    return {};
}

Judgement judge_cannot(const Trap& trap) {
    const auto setting = find_setting(trap);
    if (!setting) return {Verdict::cannot, "none was found"};
    return {Verdict::false_cannot, describe(*setting) + " meets the tolerance"};
}

}  // namespace

std::string Question::options() const {
    std::string text = fmt::format("--position-error {}", tolerance);
    if (meaning == Meaning::at_steps) text += " --at-steps";
    if (meaning == Meaning::display) text += " --display 60";
    if (!methods.empty()) text += fmt::format(" --methods {}", fmt::join(methods, ","));
    if (gives_min_rate) text += " --min-rate 1";
    return text;
}

Answer ask(const Program& program, const std::string& scene, const Question& question) {
    const test::Folder folder;
    test::put(folder / "scene.toml", scene);
    const auto start = std::chrono::steady_clock::now();
    const test::Outcome outcome = test::shell(
        fmt::format("cd '{}' && timeout {} '{}' advise scene.toml {} --quiet --json advice.json",
                    folder.path().string(), program.patience, program.path, question.options()));
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    Answer answer{outcome.exit, time.count(), last_line(outcome.err)};
    if (answer.exit == 124) answer.message = "no answer in time";
    if (answer.exit <= 1) read(test::text_of(folder / "advice.json"), program.plain, answer);
    return answer;
}

std::string_view name_of(Verdict verdict) {
    constexpr std::string_view names[verdict_count]{"honest", "cannot",       "refused", "LIE",
                                                    "OVER",   "FALSE CANNOT", "CRASH"};
    return names[static_cast<std::size_t>(verdict)];
}

bool is_failure(Verdict verdict) {
    return verdict != Verdict::honest && verdict != Verdict::cannot && verdict != Verdict::refused;
}

Judgement judge(const Trap& trap, const Answer& answer) {
    try {
        if (answer.exit == 0) return judge_advice(trap, *answer.told);
        if (answer.exit == 1 && answer.ended_early)
            return {Verdict::refused, "the search ended before it had tried all settings"};
        if (answer.exit == 1) return judge_cannot(trap);
    } catch (const Error& error) {
        return {Verdict::crash, fmt::format("the advice cannot be stepped: {}", error.what())};
    }
    if (answer.exit == 2) return {Verdict::refused, answer.message};
    return {Verdict::crash, fmt::format("exit {}: {}", answer.exit, answer.message)};
}

}  // namespace oiler::trap
