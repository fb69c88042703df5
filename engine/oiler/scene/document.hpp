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

/// What a scene file says, before anything is made of it.
struct Value {
    std::string key{};  ///< of a table's members
    Extent key_at{};    ///< its last part, where it has dots
    Extent at{};        ///< what stands behind the key; of a table its header, or its braces
    int line = 1;       ///< of the key, where there is one
    ValueKind kind = ValueKind::table;
    std::string text{};
    std::int64_t whole = 0;
    double number = 0;  ///< of a whole one, too
    bool flag = false;
    std::vector<Value> items{};  ///< of a list in its order, of a table by line

    /// Null where the table has no such member.
    [[nodiscard]] const Value* find(std::string_view name) const;
    /// "15.0", "the text "abc"", "a list": for a message.
    [[nodiscard]] std::string shown() const;
};

/// The table that the text is. Throws Error{usage} with the line where it is not TOML.
[[nodiscard]] Value parse_document(std::string_view text, std::string_view file);

}  // namespace oiler
