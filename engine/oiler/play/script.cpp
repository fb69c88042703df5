// SPDX-License-Identifier: MIT
#include "oiler/play/script.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <sstream>
#include <utility>

#include "oiler/core/error.hpp"
#include "oiler/core/nearest.hpp"
#include "oiler/core/read_number.hpp"
#include "oiler/core/utf8.hpp"

namespace oiler {
namespace {

using What = InputEvent::What;

constexpr float farthest = 1e9F;

/// The words of one line, taken from the left.
class LineWords {
public:
    LineWords(std::string_view line, std::string place) : place_(std::move(place)) {
        rest_ = line.substr(0, end_of_code(line));
        skip_blanks();
        while (!rest_.empty() && is_blank(rest_.back())) rest_.remove_suffix(1);
    }

    [[nodiscard]] bool empty() const { return rest_.empty(); }
    [[nodiscard]] std::string_view take() {
        std::size_t end = 0;
        while (end < rest_.size() && !is_blank(rest_[end])) ++end;
        const std::string_view word = rest_.substr(0, end);
        rest_.remove_prefix(end);
        skip_blanks();
        return word;
    }
    [[nodiscard]] std::string take_rest() {
        return std::string(std::exchange(rest_, std::string_view{}));
    }

    template <class Number>
    [[nodiscard]] Number take_number(std::string_view what) {
        const std::string_view word = take();
        Number number{};
        const auto [last, error] = read_number(word.data(), word.data() + word.size(), number);
        if (error != std::errc() || last != word.data() + word.size())
            refuse(fmt::format("'{}' is no {}", word, what));
        if constexpr (std::is_floating_point_v<Number>)
            if (!std::isfinite(number)) refuse(fmt::format("'{}' is no {}", word, what));
        return number;
    }
    /// The number before an s; empty if the next word does not end with one.
    [[nodiscard]] std::optional<double> take_seconds() {
        const std::size_t end = rest_.find_first_of(" \t\r");
        const std::string_view word = rest_.substr(0, end);
        double seconds = 0;
        const char* const last = word.data() + word.size();
        const auto [stop, error] = read_number(word.data(), last, seconds);
        if (error != std::errc() || stop + 1 != last || *stop != 's' || !std::isfinite(seconds))
            return std::nullopt;
        (void)take();
        return seconds;
    }
    [[nodiscard]] float take_metres() {
        const auto number = take_number<float>("place: give x and y in m");
        if (std::abs(number) > farthest)
            refuse(fmt::format("{} m is farther than {:g} m", number, farthest));
        return number;
    }
    [[nodiscard]] std::string take_quoted() {
        if (rest_.size() < 2 || rest_.front() != '"') refuse("give the text in quotes: \"hello\"");
        std::string text;
        std::size_t at = 1;
        for (; at < rest_.size() && rest_[at] != '"'; ++at) {
            if (rest_[at] == '\\') {
                ++at;
                if (at >= rest_.size() || (rest_[at] != '"' && rest_[at] != '\\'))
                    refuse("a \\ stands before \" or \\ only; write \\\\ for one \\");
            }
            text.push_back(rest_[at]);
        }
        if (at >= rest_.size()) refuse("the text has no quote at its end");
        rest_.remove_prefix(at + 1);
        skip_blanks();
        return text;
    }
    [[noreturn]] void refuse(const std::string& why) const {
        fail(Exit::usage, "{}: {}", place_, why);
    }

private:
    /// Where a comment begins, outside of a text in quotes.
    static std::size_t end_of_code(std::string_view line) {
        bool quoted = false;
        for (std::size_t at = 0; at < line.size(); ++at) {
            if (quoted && line[at] == '\\')
                ++at;
            else if (line[at] == '"')
                quoted = !quoted;
            else if (line[at] == '#' && !quoted)
                return at;
        }
        return line.size();
    }
    static bool is_blank(char one) { return one == ' ' || one == '\t' || one == '\r'; }
    void skip_blanks() {
        while (!rest_.empty() && is_blank(rest_.front())) rest_.remove_prefix(1);
    }

    std::string_view rest_;
    std::string place_;
};

std::optional<Button> first_button(std::string_view action, std::span<const Control> controls) {
    for (const Control& control : controls)
        if (!control.is_axis && control.name == action && !control.positive.empty())
            return *control.positive.begin();
    return std::nullopt;
}

Button take_button(LineWords& words, const std::string& prefix, std::span<const Control> controls) {
    const std::string name = words.take_rest();
    auto button = prefix.empty() ? first_button(name, controls) : std::nullopt;
    if (!button) button = find_button(prefix + name);
    if (!button)
        words.refuse(fmt::format(
            "'{}' is no button; give one such as {}{}", name,
            prefix.empty() ? "Space, Left, A, Mouse left or Pad south" : "left, middle or right",
            prefix.empty() ? did_you_mean(name, button_names()) : ""));
    if (is_of_loop(*button)) words.refuse(name + " belongs to the loop, and no game sees it");
    return *button;
}

void take_stick(LineWords& words, ScriptLine& line) {
    const std::string_view name = words.take();
    const auto stick = find_stick(name);
    if (!stick)
        words.refuse(
            fmt::format("'{}' is no stick; give {}", name, fmt::join(stick_names(), ", ")));
    const bool is_trigger = *stick == Stick::left_trigger || *stick == Stick::right_trigger;
    const auto position = words.take_number<float>("position of a stick");
    if (position < (is_trigger ? 0 : -1) || position > 1)
        words.refuse(fmt::format("{} goes from {} to 1", name, is_trigger ? 0 : -1));
    line.events.push_back({.what = What::stick,
                           .stick = static_cast<std::uint8_t>(*stick),
                           .deflection = static_cast<Deflection>(std::lround(position * 127))});
}

InputEvent edge(Button button, bool down) {
    return {.what = What::edge, .button = button.id(), .down = down};
}

using Controls = std::span<const Control>;

/// A kind of input, by its word in a script.
struct Deed {
    std::string_view word;
    void (*take)(LineWords& words, Controls controls, ScriptLine& line);
};
constexpr Deed deeds[]{
    {"press",
     [](LineWords& words, Controls controls, ScriptLine& line) {
         const Button button = take_button(words, "", controls);
         line.events = {edge(button, true), edge(button, false)};
     }},
    {"hold",
     [](LineWords& words, Controls controls, ScriptLine& line) {
         line.events = {edge(take_button(words, "", controls), true)};
     }},
    {"release",
     [](LineWords& words, Controls controls, ScriptLine& line) {
         line.events = {edge(take_button(words, "", controls), false)};
     }},
    {"click",
     [](LineWords& words, Controls, ScriptLine& line) {
         const Button button = take_button(words, "Mouse ", {});
         line.events = {edge(button, true), edge(button, false)};
     }},
    {"mouse",
     [](LineWords& words, Controls, ScriptLine& line) {
         const float x = words.take_metres();
         line.mouse = Point{x, words.take_metres()};
     }},
    {"wheel",
     [](LineWords& words, Controls, ScriptLine& line) {
         line.events.push_back(
             {.what = What::wheel, .notches = words.take_number<int>("number of notches")});
     }},
    {"stick", [](LineWords& words, Controls, ScriptLine& line) { take_stick(words, line); }},
    {"text",
     [](LineWords& words, Controls, ScriptLine& line) {
         line.events.push_back({.what = What::text, .text = words.take_quoted()});
     }},
};

/// A step, or a time such as 1.5s.
std::int64_t take_step(LineWords& words, Rate rate) {
    const auto seconds = words.take_seconds();
    if (!seconds)
        return words.take_number<std::int64_t>(
            "step: give its number, such as 30, or a time, such as 1.5s");
    // 0.14 s at 50 Hz are 7 steps, though the product is a little more.
    const double steps = std::ceil(*seconds / rate.dt() * (1 - 0x1p-50));
    if (std::abs(steps) > 0x1p53) words.refuse("that is too late");
    return static_cast<std::int64_t>(steps);
}

ScriptLine parse_line(LineWords& words, Rate rate, Controls controls) {
    ScriptLine line{.step = take_step(words, rate)};
    if (line.step < 0) words.refuse("the first step is 0: give a number of 0 or more");
    const std::string_view word = words.take();
    const auto deed = std::ranges::find(deeds, word, &Deed::word);
    if (deed == std::end(deeds)) {
        std::vector<std::string_view> known;
        for (const Deed& one : deeds) known.push_back(one.word);
        const std::string_view last = known.back();
        known.pop_back();
        words.refuse(fmt::format("'{}': give {} or {}", word, fmt::join(known, ", "), last));
    }
    deed->take(words, controls, line);
    if (!words.empty()) words.refuse(fmt::format("'{}' is too much", words.take_rest()));
    return line;
}

/// Refuses a button that goes down twice, or up without being down.
void follow(const ScriptLine& line, HeldButtons& held, const LineWords& words) {
    for (const InputEvent& event : line.events) {
        if (event.what != What::edge) continue;
        if (held[event.button] == event.down)
            words.refuse(fmt::format("{} is {} then", name_of(*Button::of_id(event.button)),
                                     event.down ? "down already" : "not down"));
        held[event.button] = event.down;
    }
}

}  // namespace

std::vector<ScriptLine> parse_script(const std::string& text, const std::string& name, Rate rate,
                                     std::span<const Control> controls) {
    std::vector<ScriptLine> lines;
    if (text.starts_with("\xEF\xBB\xBF"))
        fail(Exit::usage,
             "{}, line 1: it begins with a byte order mark; save it as UTF-8 without one", name);
    std::istringstream input(text);
    std::string line;
    HeldButtons held;
    for (int number = 1; std::getline(input, line); ++number) {
        LineWords words(line, fmt::format("{}, line {}", name, number));
        if (!is_utf8(line)) words.refuse("it is not UTF-8; save the file as UTF-8");
        if (words.empty()) continue;
        lines.push_back(parse_line(words, rate, controls));
        if (lines.size() > 1 && lines.back().step < lines[lines.size() - 2].step)
            words.refuse(fmt::format("step {} comes after step {}; give them in their order",
                                     lines.back().step, lines[lines.size() - 2].step));
        follow(lines.back(), held, words);
    }
    return lines;
}

Input ScriptInput::next(std::int64_t step) {
    for (; played_ < lines_.size() && lines_[played_].step <= step; ++played_) {
        const ScriptLine& line = lines_[played_];
        for (const InputEvent& event : line.events) player_.play(event);
        if (line.mouse) mouse_ = line.mouse;
    }
    if (mouse_) {
        const Camera camera = game_.picture().camera;
        player_.play({.what = What::camera, .camera = camera});
        player_.play({.what = What::pointer, .canvas = camera.to_canvas(*mouse_)});
    }
    return player_.take();
}

}  // namespace oiler
