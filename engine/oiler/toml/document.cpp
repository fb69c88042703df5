// SPDX-License-Identifier: MIT
// The only file that includes toml++. It is compiled with NDEBUG, because the parser's assertions
// fail on texts that the parser would refuse.
#include "oiler/toml/document.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <type_traits>

#include "oiler/toml/guard.hpp"
#include "oiler/toml/refuse.hpp"

namespace oiler {
namespace {

int line_of(const toml::source_region& region) { return static_cast<int>(region.begin.line); }

/// Converts toml++ nodes to values.
class Converter {
public:
    explicit Converter(std::string_view text) {
        for (std::size_t at = 0; at < text.size(); ++at)
            if (text[at] == '\n') lines_.push_back(at + 1);
    }

    [[nodiscard]] Value convert(const toml::node& node) const {
        Value value{.at = extent(node.source()), .line = line_of(node.source())};
        node.visit([&]<class Node>(const Node& one) {
            if constexpr (toml::is_table<Node>) {
                value.items = members(one);
            } else if constexpr (toml::is_array<Node>) {
                value.kind = ValueKind::list;
                value.items = elements(one);
            } else if constexpr (toml::is_string<Node>) {
                value.kind = ValueKind::text;
                value.text = one.get();
            } else if constexpr (toml::is_integer<Node>) {
                value.kind = ValueKind::whole;
                value.whole = one.get();
                value.number = static_cast<double>(one.get());
            } else if constexpr (toml::is_floating_point<Node>) {
                value.kind = ValueKind::number;
                value.number = one.get();
            } else if constexpr (toml::is_boolean<Node>) {
                value.kind = ValueKind::flag;
                value.flag = one.get();
            } else {
                value.kind = ValueKind::date;
            }
        });
        return value;
    }

private:
    [[nodiscard]] std::vector<Value> members(const toml::table& table) const {
        std::vector<Value> items;
        for (const auto& [key, node] : table) {
            Value& item = items.emplace_back(convert(node));
            item.key = key.str();
            item.key_at = extent(key.source());
            item.line = line_of(key.source());
        }
        std::ranges::stable_sort(items, {}, &Value::line);
        return items;
    }

    [[nodiscard]] std::vector<Value> elements(const toml::array& array) const {
        std::vector<Value> items;
        for (const toml::node& node : array) items.push_back(convert(node));
        return items;
    }

    /// toml++ counts lines and columns from 1. Columns count characters; in ASCII these are bytes.
    [[nodiscard]] std::size_t offset(toml::source_position position) const {
        return position ? lines_.at(position.line - 1) + position.column - 1 : 0;
    }
    [[nodiscard]] Extent extent(const toml::source_region& region) const {
        return {offset(region.begin), offset(region.end)};
    }

    std::vector<std::size_t> lines_{0};  ///< offset of the start of each line
};

}  // namespace

const Value* Value::find(std::string_view name) const {
    const auto found = std::ranges::find(items, name, &Value::key);
    return found == items.end() ? nullptr : &*found;
}

std::string Value::shown() const {
    switch (kind) {
        case ValueKind::text:
            return fmt::format("the text \"{}\"", printable(text));
        case ValueKind::whole:
            return fmt::format("{}", whole);
        case ValueKind::number:
            return fmt::format("{}", number);
        case ValueKind::flag:
            return flag ? "true" : "false";
        case ValueKind::date:
            return "a date or a time";
        case ValueKind::list:
            return fmt::format("a list of {}", items.size());
        case ValueKind::table:
            break;
    }
    return "a table";
}

Value parse_document(std::string_view text, std::string_view file) {
    guard_toml(text, file);
    try {
        return Converter(text).convert(toml::parse(text));
    } catch (const toml::parse_error& error) {
        refuse({file, line_of(error.source())}, "not TOML: {}; correct this line or the one above",
               printable(error.description(), 200));
    }
}

}  // namespace oiler
