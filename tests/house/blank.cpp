// SPDX-License-Identifier: MIT
#include "house/blank.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <regex>

namespace oiler::house {
namespace {

/// The position after the next `close` at or after `at`; the end of the text without one.
std::size_t after(const std::string& text, const std::string& close, std::size_t at) {
    const std::size_t found = text.find(close, at);
    return found == std::string::npos ? text.size() : found + close.size();
}

/// The end of the comment that begins at `at`; `at` if none begins there.
std::size_t end_of_comment(const std::string& text, std::size_t at) {
    if (text.compare(at, 2, "//") == 0) return std::min(text.find('\n', at), text.size());
    if (text.compare(at, 2, "/*") == 0) return after(text, "*/", at + 2);
    return at;
}

/// The end of the raw string whose quote is at `at`.
std::size_t end_of_raw(const std::string& text, std::size_t at) {
    const std::size_t open = std::min(text.find('(', at), text.size());
    return after(text, ")" + text.substr(at + 1, open - at - 1) + "\"", open);
}

/// The end of the literal that begins at `at`; `at` if none begins there. A quote inside a number
/// separates digits.
std::size_t end_of_literal(const std::string& text, std::size_t at) {
    const char quote = text[at];
    const char before = at > 0 ? text[at - 1] : ' ';
    if (quote == '"' && before == 'R') return end_of_raw(text, at);
    if (quote != '"' && (quote != '\'' || std::isalnum(static_cast<unsigned char>(before)) != 0))
        return at;
    std::size_t end = at + 1;
    while (end < text.size() && text[end] != quote && text[end] != '\n')
        end += text[end] == '\\' ? 2 : 1;
    return std::min(end + 1, text.size());
}

void blank(std::string& text, std::size_t begin, std::size_t end) {
    for (std::size_t at = begin; at < end; ++at)
        if (text[at] != '\n') text[at] = ' ';
}

/// Blanks comments, and literals if `literals`.
void blank_comments(std::string& text, bool literals) {
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t comment = end_of_comment(text, at);
        const std::size_t end = comment > at ? comment : end_of_literal(text, at);
        if (comment > at || literals) blank(text, at, end);
        at = std::max(end, at + 1);
    }
}

void blank_preprocessor_lines(std::string& text) {
    for (std::size_t line = 0; line < text.size();) {
        std::size_t end = std::min(text.find('\n', line), text.size());
        const std::size_t first = text.find_first_not_of(" \t", line);
        if (first < end && text[first] == '#') {
            while (end < text.size() && text[end - 1] == '\\')
                end = std::min(text.find('\n', end + 1), text.size());
            blank(text, line, end);
        }
        line = end + 1;
    }
}

}  // namespace

std::string without_comments(std::string text) {
    blank_comments(text, false);
    return text;
}

std::string code_of(std::string text) {
    blank_comments(text, true);
    blank_preprocessor_lines(text);
    return text;
}

std::string without_cmake_comments(const std::string& text) {
    static const std::regex comment(R"re(#\[(=*)\[[\s\S]*?\]\1\]|#[^\n]*)re");
    return std::regex_replace(text, comment, "");
}

}  // namespace oiler::house
