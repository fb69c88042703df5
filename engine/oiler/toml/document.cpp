// SPDX-License-Identifier: MIT
// The only file that includes toml++. It is compiled with NDEBUG, because the parser's assertions
// fail on texts that the parser would refuse.
#include "oiler/toml/document.hpp"

#include <toml++/toml.h>

#include <algorithm>

#include "oiler/core/error.hpp"
#include "oiler/core/utf8.hpp"

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

/// Counts nested brackets and dots of keys, outside of strings and comments. An unterminated string
/// ends the count, as it ends the parser.
class NestingGuard {
public:
    NestingGuard(std::string_view text, std::string_view file) : text_(text), file_(file) {}

    void run() {
        while (at_ < text_.size()) take_part();
    }
    /// The first character of the comment (#) or string (a quote) that contains this byte; any
    /// other one outside of both.
    [[nodiscard]] char part_with(std::size_t at) {
        char first = text_[at];
        while (at_ <= at) first = take_part();
        return first;
    }

private:
    char take_part() {
        const char c = text_[at_];
        if (c == '#')
            skip_comment();
        else if (c == '"' || c == '\'')
            skip_string(c);
        else
            count(c);
        return c;
    }
    static constexpr int most_depth = 64;
    static constexpr int most_dots = 32;

    void count(char c) {
        ++at_;
        if (c == '.' && ++dots_ > most_dots)
            refuse({file_, line_}, "a key of more than {} parts; use at most 2", most_dots);
        if (c == '[' || c == '{') ++depth_;
        if ((c == ']' || c == '}') && depth_ > 0) --depth_;
        if (depth_ > most_depth)
            refuse({file_, line_}, "brackets nested deeper than {}; close them", most_depth);
        if (c == '\n') ++line_;
        if (std::string_view("=,[]{}\n").find(c) != std::string_view::npos) dots_ = 0;
    }
    void skip_comment() {
        while (at_ < text_.size() && text_[at_] != '\n') ++at_;
    }
    void skip_string(char quote) {
        const bool lines = follows(std::string(3, quote));
        const std::string mark(lines ? 3 : 1, quote);
        for (at_ += mark.size(); at_ < text_.size() && !follows(mark); ++at_) {
            if (text_[at_] == '\n' && !lines) return;
            if (text_[at_] == '\\' && quote == '"' && at_ + 1 < text_.size()) ++at_;
            if (text_[at_] == '\n') ++line_;
        }
        at_ = std::min(at_ + mark.size(), text_.size());
        // The content of a multi-line string may end with two quotes.
        for (int more = 0; lines && more < 2 && follows(mark.substr(2)); ++more) ++at_;
    }
    [[nodiscard]] bool follows(std::string_view part) const {
        return text_.substr(at_).starts_with(part);
    }

    std::string_view text_;
    std::string_view file_;
    std::size_t at_ = 0;
    int line_ = 1;
    int depth_ = 0;
    int dots_ = 0;
};

/// Returns whether a byte is ASCII text. A carriage return must be followed by a line feed.
bool is_text(std::string_view text, std::size_t at) {
    const char c = text[at];
    if (c == '\r') return text.substr(at).starts_with("\r\n");
    return c == '\t' || c == '\n' || (c >= ' ' && c <= '~');
}

/// What to write in place of a byte that is not ASCII text.
std::string hint_at(std::string_view text, std::size_t at, std::string_view file) {
    std::string_view rest = text.substr(at);
    const char32_t code = take_code(rest);
    const bool is_character = code >= 0xA0 && code != 0xFFFD;
    const auto escape = [&] {
        return code > 0xFFFF ? fmt::format("\\U{:08x}", static_cast<std::uint32_t>(code))
                             : fmt::format("\\u{:04x}", static_cast<std::uint32_t>(code));
    };
    switch (NestingGuard(text, file).part_with(at)) {
        case '#':
            return ", also in a comment";
        case '"':
            return is_character ? ", in quotes " + escape() : "";
        case '\'':
            return is_character ? ", in double quotes " + escape() : "";
        default:
            return "";
    }
}

void guard_toml(std::string_view text, std::string_view file) {
    if (text.size() > most_toml_bytes)
        refuse({file}, "more than {} bytes; use a [[grid]] or a [[scatter]] for many bodies",
               most_toml_bytes);
    if (text.starts_with("\xef\xbb\xbf"))
        refuse({file, 1}, "it begins with a byte order mark; save it as UTF-8 without one");
    int line = 1;
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (!is_text(text, at))
            refuse({file, line}, "byte 0x{:02x}; expected ASCII text{}",
                   static_cast<unsigned char>(text[at]), hint_at(text, at, file));
        if (text[at] == '\n') ++line;
    }
    NestingGuard(text, file).run();
}

}  // namespace

void refuse_text(const Place& place, const std::string& text) {
    fail(Exit::usage, "{}:{}: {}", place.file, place.line, text);
}

std::string printable(std::string_view text, std::size_t most) {
    std::string line(text.substr(0, most));
    std::ranges::replace_if(
        line, [](char c) { return c < ' ' || c > '~'; }, '?');
    return text.size() > most ? line + "..." : line;
}

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
