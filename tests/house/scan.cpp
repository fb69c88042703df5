// SPDX-License-Identifier: MIT
#include "house/scan.hpp"

#include <algorithm>
#include <cstddef>
#include <regex>

#include "house/blank.hpp"
#include "house/statement.hpp"

namespace oiler::house {
namespace {

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
