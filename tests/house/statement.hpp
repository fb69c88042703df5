// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace oiler::house {

/// The tokens of a statement at namespace scope. A group in parentheses or square brackets is one
/// token with its text ("(int a)"); a group in braces is the token "{}".
using Statement = std::vector<std::string>;

/// Splits code into words, "::", "->" and single characters.
std::vector<std::string> tokenize(const std::string& code);

bool is_word(const std::string& token);

/// The name, or signature, that a statement defines; empty if it defines none.
std::string defined_name(const Statement& statement);

}  // namespace oiler::house
