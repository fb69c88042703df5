// SPDX-License-Identifier: MIT
#pragma once

namespace oiler {

/// Throws Error(Exit::usage) unless the calling thread rounds to nearest and keeps subnormal
/// numbers. A single linked shared object that was built with -ffast-math switches subnormals off
/// for the whole process before main(), because g++ puts crtfastmath.o into it. Runs would then
/// silently give other bits. Call this once at start, before starting threads: threads inherit the
/// mode.
void require_ieee_arithmetic();

}  // namespace oiler
