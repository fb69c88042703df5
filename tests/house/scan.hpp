// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace oiler::house {

/// The definitions of a C++ text at the scope of named namespaces.
struct Definitions {
    /// Qualified names of types, concepts, aliases and variables ("oiler::Range"), and signatures
    /// of functions that have a body ("oiler::ticks(Range,int)").
    std::vector<std::string> names;
    /// False if brackets do not match; `names` is then unreliable.
    bool balanced = true;
};

/// Finds the definitions of a file. Forward declarations, members, template specialisations and
/// the contents of anonymous namespaces do not count. Reads statements, not C++: it does not
/// expand macros and takes both branches of an #if.
Definitions find_definitions(const std::string& text);

/// The headers that a file includes, in order.
std::vector<std::string> find_includes(const std::string& text);

/// `text` with spaces in place of comments. Lines keep their numbers.
std::string without_comments(std::string text);

/// `text` with spaces in place of comments, of string and character literals, and of preprocessor
/// lines.
std::string code_of(std::string text);

/// `text` of a CMake file without its comments.
std::string without_cmake_comments(const std::string& text);

/// The tokens of a statement at namespace scope. A group in parentheses or square brackets is one
/// token with its text ("(int a)"); a group in braces is the token "{}".
using Statement = std::vector<std::string>;

/// Splits code into words, "::", "->" and single characters.
std::vector<std::string> tokenize(const std::string& code);

bool is_word(const std::string& token);

/// The name, or signature, that a statement defines; empty if it defines none.
std::string defined_name(const Statement& statement);

}  // namespace oiler::house
