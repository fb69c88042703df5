// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace oiler {

/// A fingerprint for comparing runs on different compilers and machines: XXH3 (64 bits, seed 0)
/// over the added values in order, little-endian, without separators. Add a count before columns
/// whose lengths vary, because the hash does not depend on how the bytes are split into calls. It
/// hashes bits, so -0.0 differs from 0.0. It is a value: a copy continues independently.
class StateHash {
public:
    StateHash();

    void add(std::uint64_t number);
    void add(std::span<const float> column);
    void add(std::span<const double> column);
    void add(std::span<const std::byte> bytes);

    /// The hash of all values added so far; more may follow.
    [[nodiscard]] std::uint64_t value() const;

private:
    // Holds xxHash's state without including its header here.
    alignas(64) std::array<std::byte, 576> state_;
};

/// The hash as 16 lower-case hexadecimal digits, most significant first.
[[nodiscard]] std::string hash_text(std::uint64_t hash);

}  // namespace oiler
