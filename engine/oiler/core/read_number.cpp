// SPDX-License-Identifier: MIT
#include "oiler/core/read_number.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>

namespace oiler {

template <class Number>
std::from_chars_result detail::read_by_strtod(const char* first, const char* last, Number& number) {
    // strtod skips spaces and a plus, and reads hexadecimal digits and the payload of a NaN.
    constexpr std::string_view in_numbers = "0123456789.+-eEinfatyINFATY";
    const std::string text(first, std::find_if_not(first, last, [&](char c) {
                               return in_numbers.find(c) != in_numbers.npos;
                           }));
    char* end = nullptr;
    const auto value =
        static_cast<Number>(sizeof(Number) == sizeof(float) ? std::strtof(text.c_str(), &end)
                                                            : std::strtod(text.c_str(), &end));
    if (end == text.c_str() || text.front() == '+') return {first, std::errc::invalid_argument};
    const char* const after = first + (end - text.c_str());
    const std::string_view read(text.c_str(), end);
    const bool is_named = read.find_first_of("iInN") != read.npos;
    const bool vanishes = value == 0 && read.find_first_of("123456789") < read.find_first_of("eE");
    if ((std::isinf(value) && !is_named) || vanishes)
        return {after, std::errc::result_out_of_range};
    number = value;
    return {after, std::errc()};
}

template std::from_chars_result detail::read_by_strtod(const char*, const char*, double&);
template std::from_chars_result detail::read_by_strtod(const char*, const char*, float&);

#ifdef __cpp_lib_to_chars
template <class Number>
static std::from_chars_result read(const char* first, const char* last, Number& number) {
    return std::from_chars(first, last, number);
}
#else
template <class Number>
static std::from_chars_result read(const char* first, const char* last, Number& number) {
    return detail::read_by_strtod(first, last, number);
}
#endif

std::from_chars_result read_number(const char* first, const char* last, double& number) {
    return read(first, last, number);
}

std::from_chars_result read_number(const char* first, const char* last, float& number) {
    return read(first, last, number);
}

}  // namespace oiler
