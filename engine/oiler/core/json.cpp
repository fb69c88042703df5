// SPDX-License-Identifier: MIT
#include "oiler/core/json.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "oiler/core/require.hpp"
#include "oiler/core/utf8.hpp"

namespace oiler {
namespace {

template <class Real>
std::string text_of(Real value) {
    if (!std::isfinite(value)) return "null";
    std::string digits = fmt::format("{}", value);
    if (digits.find_first_of(".e") == digits.npos) digits += ".0";
    return digits;
}

/// Appends one unit of UTF-16, or two beyond U+FFFF.
void append_escape(std::string& text, char32_t code) {
    if (code > 0xFFFF) {
        append_escape(text, 0xD7C0 + (code >> 10));
        append_escape(text, 0xDC00 + (code & 0x3FF));
    } else {
        text += fmt::format("\\u{:04x}", static_cast<unsigned>(code));
    }
}

/// Escapes all control characters, because a terminal obeys those beyond ASCII, too, and the second
/// of two #, because a CI takes "##" in a log for the start of a command.
void append_string(std::string& text, std::string_view value, Json::Characters characters) {
    constexpr std::u32string_view with_short_escapes = U"\"\\\b\f\n\r\t";
    constexpr std::string_view short_escapes = "\"\\bfnrt";
    text += '"';
    while (!value.empty()) {
        const char* const begin = value.data();
        const char32_t code = take_code(value);
        const std::size_t at = with_short_escapes.find(code);
        if (at != with_short_escapes.npos)
            (text += '\\') += short_escapes[at];
        else if (code < 0x20 || (code > 0x7E && code < 0xA0) ||
                 (code > 0x7E && characters == Json::Characters::ascii) ||
                 (code == '#' && text.ends_with('#')))
            append_escape(text, code);
        else if (code == 0xFFFD)
            text += "\xEF\xBF\xBD";
        else
            text.append(begin, value.data());
    }
    text += '"';
}

}  // namespace

Json::Json() : text_("null") {}
Json::Json(std::nullptr_t) : Json() {}
Json::Json(bool value) : text_(value ? "true" : "false") {}
Json::Json(double value) : text_(text_of(value)) {}
Json::Json(float value) : text_(text_of(value)) {}
Json::Json(std::string value) : kind_(Kind::string), text_(std::move(value)) {}
Json::Json(std::string_view value) : Json(std::string(value)) {}
Json::Json(const char* value) : Json(std::string(value)) {}

Json::Json(std::initializer_list<Member> members) : kind_(Kind::object) {
    for (const Member& member : members) (*this)[member.name] = member.value;
}

Json Json::array(std::initializer_list<Json> items) { return std::vector<Json>(items); }

void Json::push_back(Json item) {
    require(kind_ == Kind::array, "only a JSON array takes items");
    items_.push_back(std::move(item));
}

Json& Json::operator[](std::string_view name) {
    if (kind_ == Kind::literal) kind_ = Kind::object;
    require(kind_ == Kind::object, "only a JSON object has members");
    const auto found = std::ranges::find(names_, name);
    if (found != names_.end()) return items_[static_cast<std::size_t>(found - names_.begin())];
    names_.emplace_back(name);
    return items_.emplace_back();
}

std::string Json::dump(int indent, Characters characters) const {
    std::string text;
    append_to(text, indent, 0, characters);
    return text;
}

void Json::append_to(std::string& text, int indent, int level, Characters characters) const {
    if (kind_ == Kind::literal) {
        text += text_;
    } else if (kind_ == Kind::string) {
        append_string(text, text_, characters);
    } else {
        const auto new_line = [&](int depth) {
            if (indent >= 0)
                (text += '\n')
                    .append(static_cast<std::size_t>(indent) * static_cast<std::size_t>(depth),
                            ' ');
        };
        const bool object = kind_ == Kind::object;
        text += object ? '{' : '[';
        for (std::size_t i = 0; i < items_.size(); ++i) {
            if (i > 0) text += ',';
            new_line(level + 1);
            if (object) {
                append_string(text, names_[i], characters);
                text += indent >= 0 ? ": " : ":";
            }
            items_[i].append_to(text, indent, level + 1, characters);
        }
        if (!items_.empty()) new_line(level);
        text += object ? '}' : ']';
    }
}

}  // namespace oiler
