// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <span>
#include <string_view>
#include <type_traits>

#include "oiler/core/state_hash.hpp"

namespace oiler {

/// A type that says how it is hashed: `void hash(StateHash& hash) const { hash.add(points); }`
template <class T>
concept HashesItself = requires(const T& value, StateHash& hash) {
    value.hash(hash);
};
/// A type that can be part of a state hash. Of types without `hash`, these are the ones whose
/// bytes are their value: whole numbers and enumerations without gaps, but no floating point.
template <class T>
concept Hashed = HashesItself<T> || std::has_unique_object_representations_v<T>;

template <Hashed T>
void add_to_hash(StateHash& hash, const T& value) {
    if constexpr (HashesItself<T>)
        value.hash(hash);
    else
        hash.add(std::as_bytes(std::span(&value, 1)));
}

/// The name of a type as the compiler writes it.
template <class T>
[[nodiscard]] constexpr std::string_view type_name() {
    const std::string_view text = __PRETTY_FUNCTION__;
    const std::size_t begin = text.find("T = ") + 4;
    return text.substr(begin, text.find_first_of(";]", begin) - begin);
}

}  // namespace oiler
