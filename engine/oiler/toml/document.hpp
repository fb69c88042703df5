// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/core.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace oiler {

/// A place in a TOML file.
struct Place {
    std::string_view file;
    int line = 1;
};

/// Throws Error{usage} with the message "FILE:LINE: …".
[[noreturn]] void refuse_text(const Place& place, const std::string& text);

template <class... Args>
[[noreturn]] void refuse(const Place& place, fmt::format_string<Args...> text, Args&&... args) {
    refuse_text(place, fmt::format(text, std::forward<Args>(args)...));
}

/// Makes text from a file safe for one line on a terminal: printable ASCII, at most `most` bytes
/// and "...".
[[nodiscard]] std::string printable(std::string_view text, std::size_t most = 60);

/// Largest size of a TOML file, in bytes.
inline constexpr std::size_t most_toml_bytes = std::size_t{64} * 1024;

enum class ValueKind { text, whole, number, flag, date, list, table };

/// The bytes of a text from `begin` up to, not including, `end`.
struct Extent {
    std::size_t begin = 0;
    std::size_t end = 0;

    [[nodiscard]] std::size_t size() const { return end - begin; }
};

/// A value of a parsed TOML document, with its place in the text.
struct Value {
    std::string key{};  ///< empty unless the value is a member of a table
    Extent key_at{};    ///< the last part of a dotted key
    Extent at{};        ///< the value; for a table its header or its braces
    int line = 1;       ///< line of the key, or of the value if it has no key
    ValueKind kind = ValueKind::table;
    std::string text{};
    std::int64_t whole = 0;
    double number = 0;  ///< also set for whole numbers
    bool flag = false;
    std::vector<Value> items{};  ///< elements of a list in order, members of a table by line

    /// Returns null if the table has no such member.
    [[nodiscard]] const Value* find(std::string_view name) const;
    /// Text for a message: "15.0", "the text "abc"", "a list of 2".
    [[nodiscard]] std::string shown() const;
};

/// Parses TOML. Throws Error{usage} with the line of the first mistake, and for texts that may
/// crash the parser: more than `most_toml_bytes` bytes, bytes other than ASCII text, keys of more
/// than 32 parts, brackets nested deeper than 64.
[[nodiscard]] Value parse_document(std::string_view text, std::string_view file);

}  // namespace oiler
