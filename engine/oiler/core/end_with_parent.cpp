// SPDX-License-Identifier: MIT
#include "oiler/core/end_with_parent.hpp"

#ifdef __linux__
#include <sys/prctl.h>
#endif

namespace oiler {

void end_with_parent([[maybe_unused]] int signal) {
#ifdef __linux__
    prctl(PR_SET_PDEATHSIG, signal);
#endif
}

}  // namespace oiler
