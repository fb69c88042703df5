// SPDX-License-Identifier: MIT
#include "oiler/toml/guard.hpp"

#include <algorithm>
#include <cerrno>

#include "oiler/core/error.hpp"
#include "oiler/toml/refuse.hpp"

namespace oiler {
namespace {

/// Counts nested brackets and dots of keys, outside of strings and comments. An unterminated string
/// ends the count, as it ends the parser.
class NestingGuard {
public:
    NestingGuard(std::string_view text, std::string_view file) : text_(text), file_(file) {}

    void run() {
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == '#')
                skip_comment();
            else if (c == '"' || c == '\'')
                skip_string(c);
            else
                count(c);
        }
    }

private:
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

}  // namespace

void guard_toml(std::string_view text, std::string_view file) {
    if (text.size() > most_toml_bytes)
        refuse({file}, "more than {} bytes; use a [[grid]] or a [[scatter]] for many bodies",
               most_toml_bytes);
    if (text.starts_with("\xef\xbb\xbf"))
        refuse({file, 1}, "it begins with a byte order mark; save it as UTF-8 without one");
    int line = 1;
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (!is_text(text, at))
            refuse({file, line}, "byte 0x{:02x}; expected ASCII text, in quotes \\u00e9 for é",
                   static_cast<unsigned char>(text[at]));
        if (text[at] == '\n') ++line;
    }
    NestingGuard(text, file).run();
}

}  // namespace oiler
