// SPDX-License-Identifier: MIT
#include "oiler/play/keys.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "oiler/core/error.hpp"
#include "oiler/core/nearest.hpp"
#include "oiler/toml/document.hpp"

namespace oiler {
namespace {

constexpr std::string_view no_stick = "none";

bool has(const Buttons& buttons, Button button) {
    return std::find(buttons.begin(), buttons.end(), button) != buttons.end();
}

/// Changes controls as the values of a document say.
class KeysReader {
public:
    KeysReader(std::string_view file, std::vector<Control>& controls)
        : file_(file), controls_(controls) {}

    void read(const Value& document) const {
        for (const Value& item : document.items) {
            const auto found = std::ranges::find(controls_, item.key, &Control::name);
            if (found == controls_.end()) refuse_name(item);
            found->is_axis ? read_axis(item, *found) : read_action(item, *found);
        }
    }

private:
    [[nodiscard]] Place at(const Value& value) const { return {file_, value.line}; }

    [[noreturn]] void refuse_name(const Value& item) const {
        std::vector<std::string_view> names;
        for (const Control& control : controls_) names.push_back(control.name);
        refuse(at(item), "{}: the game has no such action or axis, but {}{}", printable(item.key),
               fmt::join(names, ", "), did_you_mean(item.key, names));
    }
    void read_action(const Value& item, Control& action) const {
        if (item.kind != ValueKind::list)
            refuse(at(item),
                   "{0}: an action: expected a list of buttons, got {1}; for example "
                   "{0} = [\"Space\"]",
                   item.key, item.shown());
        action.positive = read_buttons(item);
    }
    void read_axis(const Value& item, Control& axis) const {
        if (item.kind != ValueKind::table)
            refuse(at(item),
                   "{0}: an axis: expected a table, got {1}; for example "
                   "{0} = {{negative = [\"A\"], positive = [\"D\"]}}",
                   item.key, item.shown());
        constexpr std::array<std::string_view, 3> parts{"negative", "positive", "stick"};
        for (const Value& part : item.items) {
            if (part.key == "stick")
                axis.stick = read_stick(part);
            else if (part.key == "negative" || part.key == "positive")
                (part.key == "negative" ? axis.negative : axis.positive) = read_buttons(part);
            else
                refuse(at(part), "{}: an axis has negative, positive and stick{}",
                       printable(part.key), did_you_mean(part.key, parts));
        }
        for (const Button button : axis.negative)
            if (has(axis.positive, button))
                refuse(at(item), "{}: {} is negative and positive; name it once", item.key,
                       name_of(button));
    }
    [[nodiscard]] Buttons read_buttons(const Value& list) const {
        if (list.kind != ValueKind::list)
            refuse(at(list), "{0}: expected a list of buttons, got {1}; for example {0} = [\"A\"]",
                   list.key, list.shown());
        if (list.items.size() > Buttons::most)
            refuse(at(list), "{}: {} buttons; give at most {}", list.key, list.items.size(),
                   Buttons::most);
        Buttons buttons;
        for (const Value& item : list.items) {
            const Button button = read_button(item);
            if (has(buttons, button))
                refuse(at(item), "{}: {} comes twice; name it once", list.key, name_of(button));
            buttons.add(button);
        }
        return buttons;
    }
    [[nodiscard]] Button read_button(const Value& item) const {
        const auto button =
            item.kind == ValueKind::text ? find_button(item.text) : std::optional<Button>{};
        if (!button)
            refuse(at(item),
                   "expected a button such as \"Space\", \"A\" or \"Pad south\", got {}{}",
                   item.shown(), did_you_mean(item.text, button_names()));
        if (is_of_loop(*button))
            refuse(at(item), "{} belongs to the loop, and no game sees it; give another key",
                   name_of(*button));
        return *button;
    }
    [[nodiscard]] std::optional<Stick> read_stick(const Value& item) const {
        if (item.kind == ValueKind::text && item.text == no_stick) return std::nullopt;
        const auto stick =
            item.kind == ValueKind::text ? find_stick(item.text) : std::optional<Stick>{};
        if (!stick)
            refuse(at(item), "stick: expected {} or {}, got {}", fmt::join(stick_names(), ", "),
                   no_stick, item.shown());
        return stick;
    }

    std::string_view file_;
    std::vector<Control>& controls_;
};

}  // namespace

void check_controls(std::span<const Control> controls) {
    for (std::size_t i = 0; i < controls.size(); ++i) {
        const std::string_view name = controls[i].name;
        if (name.empty())
            fail(Exit::usage, "About::controls: number {} has no name; give it one", i + 1);
        const auto before = controls.first(i);
        if (std::any_of(before.begin(), before.end(),
                        [&](const Control& other) { return other.name == name; }))
            fail(Exit::usage, "About::controls: two are named {}; rename one", name);
        for (const Buttons& buttons : {controls[i].negative, controls[i].positive})
            for (const Button button : buttons)
                if (is_of_loop(button))
                    fail(Exit::usage,
                         "About::controls: {} has {}, which belongs to the loop; give another key",
                         name, name_of(button));
    }
}

std::vector<Control> parse_keys(std::string_view text, std::string_view file,
                                std::span<const Control> controls) {
    if (text.size() > most_toml_bytes)
        refuse({file}, "more than {} bytes; name each action once", most_toml_bytes);
    std::vector<Control> chosen(controls.begin(), controls.end());
    KeysReader(file, chosen).read(parse_document(text, file));
    return chosen;
}

}  // namespace oiler
