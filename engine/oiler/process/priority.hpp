// SPDX-License-Identifier: MIT
#pragma once

namespace oiler {

/// From now on, the other threads go before the one that calls this, on Linux.
void lower_priority_of_thread();

}  // namespace oiler
