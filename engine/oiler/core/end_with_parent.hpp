// SPDX-License-Identifier: MIT
#pragma once

namespace oiler {

/// From now on, this process gets the signal when its parent ends, on Linux. The parent may have
/// ended before.
void end_with_parent(int signal);

}  // namespace oiler
