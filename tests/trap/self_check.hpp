// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace oiler::trap {

/// Compares the true motions with one another on random scenes, and with reference numbers of
/// tests/data. Prints the largest differences; returns whether all are small.
[[nodiscard]] bool self_check(std::uint64_t seed);

}  // namespace oiler::trap
