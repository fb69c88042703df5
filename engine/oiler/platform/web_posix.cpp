// SPDX-License-Identifier: MIT
// Functions of POSIX that emscripten declares and does not have. A page has no time limit, no
// disk and no other programs.
#include <cerrno>
#include <csignal>
#include <ctime>

extern "C" {

int timer_create(clockid_t, sigevent*, timer_t*) {
    errno = ENOSYS;
    return -1;
}

int timer_settime(timer_t, int, const itimerspec*, itimerspec*) {
    errno = ENOSYS;
    return -1;
}

int memfd_create(const char*, unsigned) {
    errno = ENOSYS;
    return -1;
}

int syncfs(int) { return 0; }

}  // extern "C"
