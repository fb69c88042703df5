// SPDX-License-Identifier: MIT
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <boost/numeric/odeint/stepper/symplectic_euler.hpp>
#include <memory>

#include "bench/peers.hpp"

namespace oiler::bench {
namespace {

namespace odeint = boost::numeric::odeint;
using Numbers = std::vector<double>;

Numbers start(std::size_t count) {
    Numbers numbers;
    for (std::size_t i = 0; i < count; ++i)
        numbers.push_back(1 + static_cast<double>(i % 251) / 256);
    return numbers;
}

/// All positions, then all velocities.
void rates(const Numbers& state, Numbers& change, double) {
    const std::size_t half = state.size() / 2;
    const double* const x = state.data();
    const double* const v = x + half;
    double* const dx = change.data();
    double* const dv = dx + half;
    for (std::size_t i = 0; i < half; ++i) dx[i] = v[i];
    for (std::size_t i = 0; i < half; ++i) dv[i] = x[i] * -peer_stiffness;
}

void force(const Numbers& x, Numbers& dv) {
    for (std::size_t i = 0; i < x.size(); ++i) dv[i] = x[i] * -peer_stiffness;
}

}  // namespace

PeerWork odeint_rk4(std::size_t oscillators) {
    struct Run {
        odeint::runge_kutta4<Numbers> stepper;
        Numbers state;
    };
    const auto run = std::make_shared<Run>(Run{{}, start(2 * oscillators)});
    return {repeated([=] { run->stepper.do_step(rates, run->state, 0, peer_dt); }),
            [=] { return run->state.front(); }};
}

PeerWork odeint_symplectic_euler(std::size_t oscillators) {
    struct Run {
        odeint::symplectic_euler<Numbers> stepper;
        Numbers x;
        Numbers v;
    };
    const auto run = std::make_shared<Run>(Run{{}, start(oscillators), start(oscillators)});
    return {repeated([=] {
                run->stepper.do_step(force, std::pair(std::ref(run->x), std::ref(run->v)), 0,
                                     peer_dt);
            }),
            [=] { return run->x.front(); }};
}

}  // namespace oiler::bench
