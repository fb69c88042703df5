// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace oiler {

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

/// Parses TOML. Throws Error{usage} with the line of the first mistake.
[[nodiscard]] Value parse_document(std::string_view text, std::string_view file);

}  // namespace oiler
