// SPDX-License-Identifier: MIT
// Functions of POSIX that emscripten lacks or that are otherwise in a page. A page has no time
// limit, no disk and no other programs.
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

// emscripten has it, but counts standard streams as terminals.
int isatty(int) { return 0; }

int memfd_create(const char*, unsigned) {
    errno = ENOSYS;
    return -1;
}

int syncfs(int) { return 0; }

}  // extern "C"
