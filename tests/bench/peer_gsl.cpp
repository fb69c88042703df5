// SPDX-License-Identifier: MIT
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <memory>

#include "bench/peers.hpp"

namespace oiler::bench {
namespace {

using Oscillator = std::array<double, 2>;

int rates(double, const double* state, double* change, void*) {
    change[0] = state[1];
    change[1] = state[0] * -peer_stiffness;
    return GSL_SUCCESS;
}

}  // namespace

PeerWork gsl_rk4(std::size_t oscillators) {
    const auto state = std::make_shared<std::vector<Oscillator>>(oscillators, Oscillator{1, 1});
    const std::shared_ptr<gsl_odeiv2_step> stepper(gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk4, 2),
                                                   gsl_odeiv2_step_free);
    return {[=](long times) {
                const gsl_odeiv2_system system{rates, nullptr, 2, nullptr};
                Oscillator error{};
                for (long i = 0; i < times; ++i)
                    for (Oscillator& one : *state)
                        gsl_odeiv2_step_apply(stepper.get(), 0, peer_dt, one.data(), error.data(),
                                              nullptr, nullptr, &system);
            },
            [=] { return state->front()[0]; }};
}

}  // namespace oiler::bench
