// SPDX-License-Identifier: MIT
#include "trap/advice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "support/shell.hpp"

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
        if (!json.at("meets").get<bool>()) throw std::runtime_error("exit 0 without an advice");
        answer.told = told_by(json, plain);
    } catch (const std::exception& error) {
        answer.exit = -1;
        answer.message = error.what();
    }
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
    Answer answer{outcome.exit, time.count(), last_line(outcome.err), {}};
    if (answer.exit == 124) answer.message = "no answer in time";
    if (answer.exit == 0) read(test::text_of(folder / "advice.json"), program.plain, answer);
    return answer;
}

}  // namespace oiler::trap
