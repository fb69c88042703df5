// SPDX-License-Identifier: MIT
#include "house/statement.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <set>

namespace oiler::house {
namespace {

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

}  // namespace

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

}  // namespace oiler::house
