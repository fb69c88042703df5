// SPDX-License-Identifier: MIT
#include "oiler/process/priority.hpp"

#ifdef __linux__
#include <sys/resource.h>
#endif

namespace oiler {

void lower_priority_of_thread() {
#ifdef __linux__
    constexpr int nice = 10;  // a tenth of the time of a thread that is as busy
    setpriority(PRIO_PROCESS, 0, nice);
#endif
}

}  // namespace oiler
