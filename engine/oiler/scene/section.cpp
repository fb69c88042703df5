// SPDX-License-Identifier: MIT
#include "oiler/scene/section.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "oiler/core/nearest.hpp"
#include "oiler/core/require.hpp"

namespace oiler {

Section::Section(std::string_view file, std::string_view name, const Value& value)
    : file_(file), name_(name), value_(value) {
    if (value.kind != ValueKind::table)
        refuse({file, value.line}, "{}: expected a table, got {}; write {}", name, value.shown(),
               scene_table(name).is_repeated() ? fmt::format("[[{}]]", name)
                                               : fmt::format("[{}]", name));
    for (const Value& member : value.items)
        if (!find_scene_key(name, member.key)) refuse_unknown(member);
}

void Section::refuse_unknown(const Value& member) const {
    std::vector<std::string_view> names;
    std::string tables;
    for (const SceneKey& key : scene_keys()) {
        if (key.table == name_) names.push_back(key.name);
        if (key.name == member.key) tables += fmt::format(" [{}]", key.table);
    }
    std::string remedy = did_you_mean(member.key, names);
    if (remedy.empty() && !tables.empty()) remedy = "; it is a key of" + tables;
    if (remedy.empty()) remedy = fmt::format("; it has {}", fmt::join(names, ", "));
    refuse({file_, member.line}, "{}.{}: [{}] has no such key{}", name_, printable(member.key),
           name_, remedy);
}

std::string Section::example(const SceneKey& key) const {
    constexpr std::array<std::string_view, 3> vectors{"[1.0]", "[1.0, 2.0]", "[1.0, 2.0, 3.0]"};
    const bool is_vector = key.kind == KeyKind::vector;
    return fmt::format("{} = {}", key.name,
                       is_vector ? vectors[static_cast<std::size_t>(axes_ - 1)] : key.value);
}

void Section::refuse_value(const SceneKey& key, const Value& value, std::string_view hint) const {
    refuse({file_, value.line}, "{}.{}: expected {}, got {}{}; for example {}", key.table, key.name,
           expectation(key, axes_), value.shown(), hint, example(key));
}

const SceneKey& Section::entry(std::string_view key) const {
    const SceneKey* const found = find_scene_key(name_, key);
    require(found, "scene_keys() lacks a key that is read");
    return *found;
}

bool Section::has(std::string_view key) const { return value_.find(key) != nullptr; }

Place Section::place(std::string_view key) const {
    const Value* const found = value_.find(key);
    return {file_, found ? found->line : value_.line};
}

const Value* Section::find(const SceneKey& key) const {
    const Value* const found = value_.find(key.name);
    if (!found && key.required())
        refuse(place(), "{}.{}: missing; [{}] needs {}, for example {}", key.table, key.name,
               key.table, expectation(key, axes_), example(key));
    return found;
}

double Section::number(const SceneKey& key, const Value& value) const {
    const bool is_number = value.kind == ValueKind::number || value.kind == ValueKind::whole;
    if (!is_number || !std::isfinite(value.number) || !key.range.holds(value.number))
        refuse_value(key, value);
    return value.number;
}

std::int64_t Section::whole(const SceneKey& key, const Value& value) const {
    if (value.kind != ValueKind::whole || !key.range.holds(value.number)) refuse_value(key, value);
    return value.whole;
}

const std::string& Section::text(const SceneKey& key, const Value& value) const {
    if (value.kind != ValueKind::text) refuse_value(key, value);
    return value.text;
}

void Section::read(std::string_view key, std::string& target) const {
    constexpr std::size_t longest = 200;
    const Value* const value = find(entry(key));
    if (!value) return;
    target = text(entry(key), *value);
    if (target.size() > longest)
        refuse({file_, value->line}, "{}.{}: expected a text of at most {} bytes, got {}", name_,
               key, longest, target.size());
    for (const char c : target)
        if (static_cast<unsigned char>(c) < ' ' || c == '\x7f')
            refuse({file_, value->line}, "{}.{}: control character 0x{:02x}; leave it out", name_,
                   key, static_cast<unsigned char>(c));
}

void Section::read(std::string_view key, std::int64_t& target) const {
    if (const Value* const value = find(entry(key))) target = whole(entry(key), *value);
}

void Section::read(std::string_view key, double& target) const {
    if (const Value* const value = find(entry(key))) target = number(entry(key), *value);
}

void Section::read(std::string_view key, bool& target) const {
    const Value* const value = find(entry(key));
    if (!value) return;
    if (value->kind != ValueKind::flag) refuse_value(entry(key), *value);
    target = value->flag;
}

void Section::read(std::string_view key, Vec3& target) const {
    const Value* const value = find(entry(key));
    if (!value) return;
    if (value->kind != ValueKind::list || value->items.size() != static_cast<std::size_t>(axes_))
        refuse_value(entry(key), *value);
    for (std::size_t i = 0; i < value->items.size(); ++i)
        target.axis[i] = number(entry(key), value->items[i]);
}

void Section::read(std::string_view key, std::array<std::int64_t, 2>& target) const {
    const Value* const value = find(entry(key));
    if (!value) return;
    if (value->kind != ValueKind::list || value->items.empty() || value->items.size() > 2)
        refuse_value(entry(key), *value);
    for (std::size_t i = 0; i < value->items.size(); ++i)
        target[i] = whole(entry(key), value->items[i]);
}

void Section::read(std::string_view key, Colour& target) const {
    const Value* const value = find(entry(key));
    if (!value) return;
    const std::optional<Colour> colour = find_colour(text(entry(key), *value));
    if (!colour) refuse_value(entry(key), *value, did_you_mean(value->text, colour_names()));
    target = *colour;
}

std::string Section::word(std::string_view key) const {
    const SceneKey& known = entry(key);
    const Value* const value = find(known);
    if (!value) return {};
    const std::vector<std::string_view> words = known.words();
    if (std::ranges::find(words, text(known, *value)) == words.end())
        refuse_value(known, *value, did_you_mean(value->text, words));
    return value->text;
}

}  // namespace oiler
