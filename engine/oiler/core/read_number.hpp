// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>

namespace oiler {
namespace detail {

/// What std::from_chars does, through the C library in the locale "C".
template <class Number>
std::from_chars_result read_by_strtod(const char* first, const char* last, Number& number);

}  // namespace detail

/// std::from_chars, also where the standard library has none for floating-point numbers (libc++
/// before version 20).
std::from_chars_result read_number(const char* first, const char* last, double& number);
std::from_chars_result read_number(const char* first, const char* last, float& number);
template <class Whole>
std::from_chars_result read_number(const char* first, const char* last, Whole& number) {
    return std::from_chars(first, last, number);
}

}  // namespace oiler
