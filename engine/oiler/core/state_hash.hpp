// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace oiler {

/// The fingerprint by which runs on different compilers and machines are held against each other:
/// XXH3 (64 bits, seed 0) over values in little-endian byte order, in the order they were added,
/// with nothing in between. Add a count before columns whose lengths vary, since how the bytes were
/// cut into calls does not show. Bits are hashed, so -0.0 differs from 0.0. A value; a copy goes on
/// independently.
class StateHash {
public:
    StateHash();

    void add(std::uint64_t number);
    void add(std::span<const float> column);
    void add(std::span<const double> column);
    void add(std::span<const std::byte> bytes);

    /// The hash of all that was added; adding may go on afterwards.
    [[nodiscard]] std::uint64_t value() const;

private:
    // Holds xxHash's own state, whose header stays out of everybody else's.
    alignas(64) std::array<std::byte, 576> state_;
};

/// Sixteen lower-case hexadecimal digits, the most significant first.
[[nodiscard]] std::string hash_text(std::uint64_t hash);

}  // namespace oiler
