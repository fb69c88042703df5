// SPDX-License-Identifier: MIT
#include "oiler/app/interrupt.hpp"

namespace oiler {
namespace {

volatile std::sig_atomic_t requested_flag = 0;  // global: signal handlers have no argument for it

void remember(int) { requested_flag = 1; }

}  // namespace

Interrupt::Interrupt() {
    requested_flag = 0;
    struct sigaction action {};
    action.sa_flags = SA_RESTART;
    auto former = former_.begin();
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
        action.sa_handler = signal == SIGPIPE ? SIG_IGN : remember;
        former->signal = signal;
        sigaction(signal, &action, &former->action);
        ++former;
    }
}

Interrupt::~Interrupt() {
    for (const Former& former : former_) sigaction(former.signal, &former.action, nullptr);
}

bool Interrupt::requested() { return requested_flag != 0; }

}  // namespace oiler
