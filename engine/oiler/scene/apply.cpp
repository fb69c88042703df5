// SPDX-License-Identifier: MIT
#include "oiler/scene/apply.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <vector>

#include "oiler/core/error.hpp"
#include "oiler/core/require.hpp"
#include "oiler/scene/read.hpp"
#include "oiler/toml/document.hpp"

namespace oiler {
namespace {

Value word_value(std::string_view key, std::string_view text) {
    return {.key = std::string(key), .kind = ValueKind::text, .text = std::string(text)};
}

std::vector<Value> values_of(const Stepping& stepping) {
    std::vector<Value> values{
        {.key = "rate", .kind = ValueKind::whole, .whole = stepping.rate.steps},
        word_value("method", stepping.method->name),
        word_value("precision", name_of(stepping.precision))};
    if (stepping.damping) values.push_back(word_value("damping", damping_name(stepping)));
    return values;
}

std::string written(const Value& value, char quote = '"') {
    if (value.kind == ValueKind::whole) return fmt::format("{}", value.whole);
    return fmt::format("{0}{1}{0}", quote, value.text);
}

std::string replaced(std::string text, const Value& old, const Value& value) {
    if (old.whole == value.whole && old.text == value.text) return text;
    return text.replace(old.at.begin, old.at.size(), written(value, text[old.at.begin]));
}

/// Line end of the line that holds `at`: "\r\n" or "\n". If the last line has none, the line end of
/// the text.
std::string_view line_end(std::string_view text, std::size_t at) {
    const std::size_t end = text.find('\n', at);
    if (end == std::string_view::npos) return text.find("\r\n") < at ? "\r\n" : "\n";
    return end > 0 && text[end - 1] == '\r' ? "\r\n" : "\n";
}

/// Adds a line below that of `last`. It repeats the indentation of that line and the "scene." of a
/// dotted key.
std::string with_line(std::string text, const Value& last, const Value& value) {
    const std::string_view whole = text;
    const std::size_t begin = whole.substr(0, last.key_at.begin).rfind('\n') + 1;
    const std::string_view end = line_end(whole, last.at.end);
    const std::string line = fmt::format(
        "{}{} = {}", whole.substr(begin, last.key_at.begin - begin), value.key, written(value));
    const std::size_t below = whole.find('\n', last.at.end);
    if (below == std::string_view::npos) return fmt::format("{}{}{}", text, end, line);
    return text.insert(below + 1, fmt::format("{}{}", line, end));
}

std::string with(std::string text, std::string_view file, const Value& value) {
    const Value document = parse_document(text, file);
    const Value& scene = *document.find("scene");
    if (const Value* const old = scene.find(value.key))
        return replaced(std::move(text), *old, value);
    // Never empty, because `axes` is required.
    const Value& last =
        *std::ranges::max_element(scene.items, {}, [](const Value& item) { return item.at.end; });
    if (text[scene.at.begin] == '{')
        return text.insert(last.at.end, fmt::format(", {} = {}", value.key, written(value)));
    return with_line(std::move(text), last, value);
}

}  // namespace

std::string apply(std::string_view text, std::string_view file, const Stepping& stepping) {
    require(stepping.method, "stepping needs a method");
    Scene scene = parse_scene(text, file);
    Stepping chosen = stepping;
    if (scene.stepping.damping && !chosen.damping) chosen.damping = chosen.method->damping;
    scene.stepping = chosen;
    std::string applied(text);
    for (const Value& value : values_of(chosen)) applied = with(std::move(applied), file, value);
    if (parse_scene(applied, file) != scene)
        fail(Exit::usage,
             "{}: an edit would change other keys; write rate = {}, method = \"{}\" and "
             "precision = \"{}\" into its [scene] by hand",
             file, chosen.rate.steps, chosen.method->name, name_of(chosen.precision));
    return applied;
}

}  // namespace oiler
