// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace oiler {

class StateHash;

template <class T>
inline constexpr bool is_view = std::is_pointer_v<T>;
template <class T, std::size_t Extent>
inline constexpr bool is_view<std::span<T, Extent>> = true;

/// A type that says how it is hashed: `void hash(StateHash& hash) const { hash.add(points, speed);
/// }`
template <class T>
concept HashesItself = requires(const T& value, StateHash& hash) {
    value.hash(hash);
};
/// A type that can be part of a state hash: a number, a type without members, a type that hashes
/// itself, and of other types those whose bytes are their value. A struct without gaps and without
/// floating-point members is one of these.
template <class T>
concept Hashed = std::is_arithmetic_v<T> || std::is_empty_v<T> || HashesItself<T> ||
    (std::has_unique_object_representations_v<T> && !is_view<T>);

/// A fingerprint for comparing runs on different compilers and machines: XXH3 (64 bits, seed 0)
/// over the added values in order, little-endian, without separators. Add a count before columns
/// whose lengths vary, because the hash does not depend on how the bytes are split into calls. It
/// hashes bits, so -0.0 differs from 0.0. It is a value: a copy continues independently.
class StateHash {
public:
    StateHash();

    void add(std::span<const std::byte> bytes);
    void add(std::uint64_t number) { add(std::as_bytes(std::span(&number, 1))); }
    void add(std::span<const float> column) { add(std::as_bytes(column)); }
    void add(std::span<const double> column) { add(std::as_bytes(column)); }
    /// Adds the length and the bytes.
    void add(std::string_view text) {
        add(std::uint64_t{text.size()});
        add(std::as_bytes(std::span(text)));
    }
    /// Adds whole numbers as 64 bits, other numbers as a double.
    template <Hashed T>
    void add(const T& value) {
        if constexpr (std::floating_point<T>) {
            const double number = value;
            add(std::span(&number, 1));
        } else if constexpr (std::integral<T>) {
            add(static_cast<std::uint64_t>(value));
        } else if constexpr (HashesItself<T>) {
            value.hash(*this);
        } else if constexpr (!std::is_empty_v<T>) {
            add(std::as_bytes(std::span(&value, 1)));
        }
    }
    /// Adds several values, one after the other.
    template <class First, class Second, class... Rest>
    void add(const First& first, const Second& second, const Rest&... rest) {
        add(first);
        add(second, rest...);
    }

    /// The hash of all values added so far; more may follow.
    [[nodiscard]] std::uint64_t value() const;

private:
    // Holds xxHash's state without including its header here.
    alignas(64) std::array<std::byte, 576> state_;
};

/// The hash as 16 lower-case hexadecimal digits, most significant first.
[[nodiscard]] std::string hash_text(std::uint64_t hash);

}  // namespace oiler
