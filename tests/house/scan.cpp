// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cctype>
#include <cstddef>
#include <regex>
#include <set>

#include "house/scan.hpp"

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

using Words = std::set<std::string>;

bool is_group(const std::string& token, char open) { return token.size() > 1 && token[0] == open; }

std::string at_or_empty(const Statement& tokens, std::size_t at) {
    return at < tokens.size() ? tokens[at] : std::string();
}

/// The index after the template arguments whose "<" is at `at`; at + 1 without a match.
std::size_t after_angles(const Statement& tokens, std::size_t at) {
    int depth = 0;
    for (std::size_t i = at; i < tokens.size(); ++i) {
        if (tokens[i] == "<") ++depth;
        if (tokens[i] == ">" && --depth == 0) return i + 1;
    }
    return at + 1;
}

std::string join(const Statement& tokens, std::size_t begin, std::size_t end) {
    std::string text;
    for (std::size_t i = begin; i < end; ++i) {
        if (!text.empty() && is_word(tokens[i]) && is_word(text.substr(text.size() - 1)))
            text += ' ';
        text += tokens[i];
    }
    return text;
}

/// The index after `template <…>`, attributes and specifiers.
std::size_t after_specifiers(const Statement& tokens) {
    static const Words specifiers{"inline",    "static", "constexpr", "consteval",
                                  "constinit", "extern", "const"};
    std::size_t at = 0;
    while (at < tokens.size()) {
        if (tokens[at] == "template" && at_or_empty(tokens, at + 1) == "<")
            at = after_angles(tokens, at + 1);
        else if (is_group(tokens[at], '[') || specifiers.count(tokens[at]) == 1)
            ++at;
        else
            break;
    }
    return at;
}

/// The name of a type definition whose key (struct, enum …) is at `at`.
std::string type_name(const Statement& tokens, std::size_t at) {
    static const Words skipped{"class", "struct", "alignas"};
    for (++at; at < tokens.size(); ++at)
        if (skipped.count(tokens[at]) == 0 && is_word(tokens[at])) break;
    const std::string next = at_or_empty(tokens, at + 1);
    return next == "{}" || next == ":" || next == "final" ? tokens[at] : std::string();
}

/// A parameter's type: the parameter without default value and name.
std::string parameter_type(Statement tokens) {
    tokens.erase(std::find(tokens.begin(), tokens.end(), "="), tokens.end());
    static const Words qualifiers{"const", "typename", "::"};
    const std::size_t count = tokens.size();
    if (count > 1 && is_word(tokens[count - 1]) && tokens[count - 1] != "const" &&
        qualifiers.count(tokens[count - 2]) == 0)
        tokens.pop_back();
    return join(tokens, 0, tokens.size());
}

/// The parameter types of a group such as "( int a , Map < A , B > b )".
std::string parameter_types(const std::string& group) {
    static const std::string opening = "<([{";
    static const std::string closing = ">)]}";
    std::string types;
    Statement parameter;
    int depth = 0;
    for (const std::string& token : tokenize(group.substr(1, group.size() - 2))) {
        if (opening.find(token) != std::string::npos) ++depth;
        if (closing.find(token) != std::string::npos) --depth;
        if (token == "," && depth == 0) {
            types += parameter_type(parameter) + ",";
            parameter.clear();
        } else {
            parameter.push_back(token);
        }
    }
    return types + parameter_type(parameter);
}

/// The signature of a function definition whose parameters are at `at`; with the template's
/// parameters, because those alone may tell overloads apart.
std::string signature(const Statement& tokens, std::size_t at) {
    const auto begin = tokens.begin();
    const auto word = std::find(begin, begin + static_cast<std::ptrdiff_t>(at), "operator");
    std::size_t name = static_cast<std::size_t>(word - begin);
    if (name == at) name = at - 1;
    if (!is_word(tokens[name])) return {};
    while (name >= 2 && tokens[name - 1] == "::" && is_word(tokens[name - 2])) name -= 2;
    if (name == 0 || tokens[name - 1] == "::") return {};
    const bool generic = tokens[0] == "template";
    const std::string parameters = generic ? join(tokens, 0, after_angles(tokens, 1)) + " " : "";
    const std::string constant = at_or_empty(tokens, at + 1) == "const" ? " const" : "";
    return parameters + join(tokens, name, at) + "(" + parameter_types(tokens[at]) + ")" + constant;
}

std::string variable_name(const Statement& tokens, std::size_t begin, std::size_t at) {
    while (at > begin && is_group(tokens[at - 1], '[')) --at;
    const bool named = at >= begin + 2 && is_word(tokens[at - 1]) && tokens[at - 2] != "::";
    return named ? tokens[at - 1] : std::string();
}

std::string function_or_variable(const Statement& tokens, std::size_t begin) {
    const bool has_body = tokens.back() == "{}";
    const bool is_declared_only = tokens[0] == "extern";
    bool is_operator = false;
    for (std::size_t at = begin; at < tokens.size(); ++at) {
        is_operator = is_operator || tokens[at] == "operator";
        if (is_group(tokens[at], '(') && at > begin && tokens[at - 1] != "requires" &&
            tokens[at - 1] != "decltype" && !is_group(at_or_empty(tokens, at + 1), '('))
            return has_body ? signature(tokens, at) : std::string();
        if (is_operator) continue;
        if (tokens[at] == "=" || tokens[at] == "{}") return variable_name(tokens, begin, at);
        if (tokens[at] == "<") at = after_angles(tokens, at) - 1;
    }
    return is_declared_only ? std::string() : variable_name(tokens, begin, tokens.size());
}

/// Reads a text statement by statement and enters namespaces, never classes or functions.
class Scanner {
public:
    explicit Scanner(const std::string& text) : tokens_(tokenize(code_of(text))) {}

    Definitions scan() {
        while (at_ < tokens_.size()) read_token();
        found_.balanced = found_.balanced && scopes_.empty() && head_.empty();
        return found_;
    }

private:
    void read_token() {
        const std::string& token = tokens_[at_];
        if (token == ";") {
            ++at_;
            finish();
        } else if (token == "}") {
            ++at_;
            leave_scope();
        } else if (token == "{" && opens_scope()) {
            ++at_;
            head_.clear();
        } else if (token == "{") {
            read_group("{", "}");
            head_.emplace_back("{}");
            if (begins_statement()) finish();
        } else if (token == "(") {
            head_.push_back(read_group("(", ")"));
        } else if (token == "[") {
            head_.push_back(read_group("[", "]"));
        } else {
            head_.push_back(tokens_[at_++]);
        }
    }

    /// Skips a group with the groups inside it and returns its text.
    std::string read_group(const std::string& open, const std::string& close) {
        std::string text;
        int depth = 0;
        for (; at_ < tokens_.size(); ++at_) {
            if (tokens_[at_] == open) ++depth;
            if (tokens_[at_] == close) --depth;
            text += tokens_[at_] + (is_word(tokens_[at_]) ? " " : "");
            if (depth == 0) {
                ++at_;
                return text;
            }
        }
        found_.balanced = false;
        return text;
    }

    /// Whether the tokens after a closing brace begin a new statement: after a function's body they
    /// do, after an initialiser they do not.
    [[nodiscard]] bool begins_statement() const {
        if (at_ == tokens_.size()) return true;
        const std::string& next = tokens_[at_];
        const bool attribute = next == "[" && at_ + 1 < tokens_.size() && tokens_[at_ + 1] == "[";
        return is_word(next) || next == "}" || next == "::" || attribute;
    }

    /// Enters the scope that `head_` opens: a namespace or extern "C".
    bool opens_scope() {
        if (head_ == Statement{"extern"}) {
            scopes_.emplace_back();
            return true;
        }
        const auto word = std::find(head_.begin(), head_.end(), "namespace");
        if (word == head_.end()) return false;
        std::string name;
        for (auto token = word + 1; token != head_.end(); ++token)
            if (is_word(*token) || *token == "::") name += *token;
        scopes_.push_back(name.empty() ? anonymous : name + "::");
        return true;
    }

    void leave_scope() {
        finish();
        if (scopes_.empty())
            found_.balanced = false;
        else
            scopes_.pop_back();
    }

    void finish() {
        const std::string name = head_.empty() ? std::string() : defined_name(head_);
        head_.clear();
        const bool hidden = std::find(scopes_.begin(), scopes_.end(), anonymous) != scopes_.end();
        if (name.empty() || hidden) return;
        std::string scope;
        for (const std::string& part : scopes_) scope += part;
        found_.names.push_back(scope + name);
    }

    static constexpr const char* anonymous = "(anonymous)";

    std::vector<std::string> tokens_;
    std::size_t at_ = 0;
    Statement head_;
    std::vector<std::string> scopes_;
    Definitions found_;
};

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

bool is_word(const std::string& token) {
    return !token.empty() &&
           (std::isalnum(static_cast<unsigned char>(token[0])) != 0 || token[0] == '_');
}

std::vector<std::string> tokenize(const std::string& code) {
    std::vector<std::string> tokens;
    for (std::size_t at = 0; at < code.size();) {
        std::size_t end = at;
        while (end < code.size() && is_word(code.substr(end, 1))) ++end;
        const std::string two = code.substr(at, 2);
        if (end == at) end += two == "::" || two == "->" ? 2 : 1;
        if (std::isspace(static_cast<unsigned char>(code[at])) == 0)
            tokens.push_back(code.substr(at, end - at));
        at = end;
    }
    return tokens;
}

std::string defined_name(const Statement& tokens) {
    static const Words types{"struct", "class", "union", "enum"};
    static const Words ignored{"static_assert", "namespace", "template", "typedef", "friend"};
    const std::size_t at = after_specifiers(tokens);
    const std::string first = at_or_empty(tokens, at);
    const bool has_braces = std::find(tokens.begin(), tokens.end(), "{}") != tokens.end();
    if (first.empty() || ignored.count(first) == 1) return {};
    if (first == "concept") return at_or_empty(tokens, at + 1);
    if (first == "using") {
        const bool is_alias = std::find(tokens.begin(), tokens.end(), "=") != tokens.end();
        return is_alias ? at_or_empty(tokens, at + 1) : std::string();
    }
    if (types.count(first) == 1) return has_braces ? type_name(tokens, at) : std::string();
    return function_or_variable(tokens, at);
}

Definitions find_definitions(const std::string& text) { return Scanner(text).scan(); }

std::vector<std::string> find_includes(const std::string& text) {
    static const std::regex line(R"re((?:^|\n)[ \t]*#[ \t]*include[ \t]*["<]([^">\n]+)[">])re");
    const std::string code = without_comments(text);
    std::vector<std::string> found;
    for (std::sregex_iterator at(code.begin(), code.end(), line), end; at != end; ++at)
        found.push_back((*at)[1]);
    return found;
}

}  // namespace oiler::house
