// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "oiler/sim/links/link_rows.hpp"
#include "oiler/sim/store/columns.hpp"

namespace oiler {

/// The functions that step rows in batches.
template <std::floating_point T, int Axes>
struct Kernels {
    RowKernels<T, Axes> (*of)(const Plan<T>&);
    LinkedKernels<T, Axes> linked;
};

/// The kernels for the widest registers that this machine and this build (OILER_KERNELS) have, or
/// for the instruction set in the environment variable OILER_INSTRUCTIONS. Null for long double,
/// and for the baseline of a build without kernels for it; rows are then stepped one at a time,
/// with the same bits. Throws Error{usage} for an unknown or missing instruction set.
template <std::floating_point T, int Axes>
[[nodiscard]] const Kernels<T, Axes>* kernels();

}  // namespace oiler
