// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace oiler::house {

/// `text` with spaces in place of comments. Lines keep their numbers.
std::string without_comments(std::string text);

/// `text` with spaces in place of comments, of string and character literals, and of preprocessor
/// lines.
std::string code_of(std::string text);

/// `text` of a CMake file without its comments.
std::string without_cmake_comments(const std::string& text);

}  // namespace oiler::house
