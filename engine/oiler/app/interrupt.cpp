// SPDX-License-Identifier: MIT
#include "oiler/app/interrupt.hpp"

namespace oiler {
namespace {

volatile std::sig_atomic_t requested_flag = 0;  // a signal handler can reach nothing else

void remember(int) { requested_flag = 1; }

}  // namespace

Interrupt::Interrupt() {
    requested_flag = 0;
    struct sigaction action {};
    action.sa_handler = remember;
    action.sa_flags = SA_RESTART;
    sigaction(SIGINT, &action, &former_int_);
    sigaction(SIGTERM, &action, &former_term_);
}

Interrupt::~Interrupt() {
    sigaction(SIGINT, &former_int_, nullptr);
    sigaction(SIGTERM, &former_term_, nullptr);
}

bool Interrupt::requested() { return requested_flag != 0; }

}  // namespace oiler
