// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace oiler {

/// What is written behind a key.
enum class KeyKind {
    text,
    whole,   ///< a whole number
    number,  ///< with or without a fraction
    flag,
    vector,  ///< a number for each axis
    counts,  ///< one whole number or two
    word,    ///< one of a few texts
    colour,  ///< one of a few words, or "#rrggbb"
};

struct ValueRange {
    double low = -std::numeric_limits<double>::max();
    double high = std::numeric_limits<double>::max();
    bool without_low = false;  ///< `low` itself is outside
    [[nodiscard]] bool holds(double number) const {
        return number <= high && (without_low ? number > low : number >= low);
    }
};

/// One key of a scene file, and all that the reader checks of it by itself.
struct SceneKey {
    std::string_view table;  ///< "spring"
    std::string_view name;   ///< "stiffness"
    KeyKind kind;
    std::string_view unit;  ///< "N/m"
    ValueRange range{};
    std::string_view value;   ///< as TOML, with two axes: the default, or an example where
                              ///< `absent` is not empty
    std::string_view absent;  ///< "required", or in words what holds without it; empty: `value`
    std::string_view what;
    std::vector<std::string_view> (*words)() = nullptr;  ///< that are allowed

    [[nodiscard]] bool required() const { return absent == "required"; }
};

/// The one list: the reader knows no other key, and the README's table is this.
[[nodiscard]] std::span<const SceneKey> scene_keys();

/// Null where the table has no such key.
[[nodiscard]] const SceneKey* find_scene_key(std::string_view table, std::string_view name);

[[nodiscard]] std::vector<std::string_view> scene_tables();
/// Whether a scene may have several of the table, written [[table]].
[[nodiscard]] bool is_repeated(std::string_view table);

/// "a number above 0, in kg": what the reader expects.
[[nodiscard]] std::string expectation(const SceneKey& key, int axes);

}  // namespace oiler
