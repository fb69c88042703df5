// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace oiler {

/// A JSON value (RFC 8259) for writing; there is no reader. Objects keep the order in which members
/// were added.
class Json {
public:
    struct Member;

    /// null
    Json();
    Json(std::nullptr_t);
    Json(bool value);
    /// Writes the shortest digits that read back to the same bits. Infinities and NaN, which JSON
    /// lacks, become null.
    Json(double value);
    Json(float value);
    template <std::integral Integer>
    Json(Integer value) : text_(std::to_string(value)) {}
    Json(std::string value);
    Json(std::string_view value);
    Json(const char* value);
    template <class Item>
    Json(const std::vector<Item>& items) : kind_(Kind::array), items_(items.begin(), items.end()) {}
    /// Null if the optional is empty.
    template <class Value>
    Json(const std::optional<Value>& value) : Json(value ? Json(*value) : Json()) {}
    /// An object.
    Json(std::initializer_list<Member> members);

    [[nodiscard]] static Json array(std::initializer_list<Json> items = {});
    /// An array of to_item(item) for each of the items.
    template <class Items, class ToItem>
    [[nodiscard]] static Json list(const Items& items, ToItem to_item) {
        Json json = array();
        for (const auto& item : items) json.push_back(to_item(item));
        return json;
    }

    void push_back(Json item);
    /// The member of that name; a new member is null.
    Json& operator[](std::string_view name);

    /// The number of items or members.
    [[nodiscard]] std::size_t size() const { return items_.size(); }
    [[nodiscard]] bool empty() const { return items_.empty(); }

    enum class Characters {
        utf8,
        ascii,  ///< other characters as \uXXXX
    };
    /// The text, indented by `indent` spaces per level, or on one line if `indent` is negative.
    /// Bytes that are not UTF-8 become U+FFFD.
    [[nodiscard]] std::string dump(int indent, Characters characters = Characters::utf8) const;

private:
    enum class Kind { literal, string, array, object };

    void append_to(std::string& text, int indent, int level, Characters characters) const;

    Kind kind_ = Kind::literal;
    std::string text_;                ///< a literal, or a string without its quotes
    std::vector<std::string> names_;  ///< names of an object's members
    std::vector<Json> items_;         ///< items of an array, or values of the members
};

struct Json::Member {
    std::string_view name;
    Json value;
};

}  // namespace oiler
