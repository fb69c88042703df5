// SPDX-License-Identifier: MIT
#include "oiler/core/require.hpp"

#include <cstdio>
#include <cstdlib>

namespace oiler {

void abort_on_mistake(const char* what) {
    std::fputs("oiler: mistake in the program: ", stderr);
    std::fputs(what, stderr);
    std::fputs("\n", stderr);
    std::abort();
}

}  // namespace oiler
