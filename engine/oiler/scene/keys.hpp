// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "oiler/picture/picture.hpp"

namespace oiler {

/// The type of a key's value.
enum class KeyKind {
    text,
    whole,   ///< a whole number
    number,  ///< with or without a fraction
    flag,
    vector,  ///< a number for each axis
    points,  ///< a list of vectors
    lines,   ///< a list of texts
    counts,  ///< one whole number or two
    word,    ///< one of a few texts
    colour,  ///< one of a few words, or "#rrggbb"
};

struct ValueRange {
    double low = -std::numeric_limits<double>::max();
    double high = std::numeric_limits<double>::max();
    bool without_low = false;  ///< excludes `low` itself
    [[nodiscard]] bool holds(double number) const {
        return number <= high && (without_low ? number > low : number >= low);
    }
};

/// One key of a scene file, and all checks of its value that need no other key.
struct SceneKey {
    std::string_view table;  ///< "spring"
    std::string_view name;   ///< "stiffness"
    KeyKind kind;
    std::string_view unit;  ///< "N/m"
    ValueRange range{};
    std::string_view value;   ///< in TOML, with two axes: the default if `absent` is empty, else an
                              ///< example
    std::string_view absent;  ///< "required", the default in words, or empty: `value`
    std::string_view what;    ///< description, in the README's table
    std::vector<std::string_view> (*words)() = nullptr;  ///< allowed words

    [[nodiscard]] bool required() const { return absent == "required"; }
};

/// All keys that the reader accepts. The table in assets/scenes/README.md is this list.
[[nodiscard]] std::span<const SceneKey> scene_keys();

/// Returns null if the table has no such key.
[[nodiscard]] const SceneKey* find_scene_key(std::string_view table, std::string_view name);

/// A table of a scene file.
struct SceneTable {
    enum class Kind {
        once,      ///< [gravity]
        repeated,  ///< [[spring]]
        force,     ///< repeated: a force of that name on one body. It has the key `body`, and those
                   ///< of the force's fields.
    };
    std::string_view name;  ///< "spring"
    Kind kind;

    [[nodiscard]] bool is_repeated() const { return kind != Kind::once; }
    [[nodiscard]] bool is_force() const { return kind == Kind::force; }
};

/// All tables, in the order of scene_keys().
[[nodiscard]] std::span<const SceneTable> scene_tables();

/// The table must be one of scene_tables().
[[nodiscard]] const SceneTable& scene_table(std::string_view name);

/// Reads "blue" or "#0072b2"; empty for any other text.
[[nodiscard]] std::optional<Colour> find_colour(std::string_view text);

/// The names of the palette.
[[nodiscard]] std::vector<std::string_view> colour_names();

/// Expected value for a message: "a number above 0, in kg".
[[nodiscard]] std::string expectation(const SceneKey& key, int axes);

}  // namespace oiler
