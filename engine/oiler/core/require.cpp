// SPDX-License-Identifier: MIT
#include "oiler/core/require.hpp"

namespace oiler {

void throw_mistake(const char* what) { throw Mistake(what); }

}  // namespace oiler
