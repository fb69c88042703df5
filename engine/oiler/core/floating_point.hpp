// SPDX-License-Identifier: MIT
#pragma once

namespace oiler {

/// Throws Error(Exit::usage) unless the calling thread rounds to nearest and keeps subnormal
/// numbers. Linking a single shared object that was built with -ffast-math switches subnormals off
/// for the whole process before main() (g++ puts crtfastmath.o into it), and the same run then
/// gives other bits, silently. To be called once at start, before threads are started: they inherit
/// the mode.
void require_ieee_arithmetic();

}  // namespace oiler
