// SPDX-License-Identifier: MIT
#include "oiler/lab/reference/true_energy.hpp"

namespace oiler::lab {

TrueEnergy::TrueEnergy(const Scene& scene, const Reference& reference)
    : reference_(reference),
      bodies_(
          make_world(scene,
                     Settings{{scene.stepping.method, scene.stepping.rate, Precision::extended}},
                     reference.start)
              .bodies()),
      states_(bodies_.size()),
      at_start_(bodies_.energy().total()) {}

double TrueEnergy::at(long double t) {
    if (reference_.conservative) return at_start_;
    reference_.motion->all_at(t, states_);
    return of(states_);
}

double TrueEnergy::of(std::span<const State<long double, 3>> states) {
    if (reference_.conservative) return at_start_;
    for (std::size_t row = 0; row < states.size(); ++row) bodies_.set_state(row, states[row]);
    return bodies_.energy().total();
}

}  // namespace oiler::lab
