// SPDX-License-Identifier: MIT
#include "oiler/whatif/energy_scale.hpp"

#include <cmath>

#include "oiler/sim/bodies.hpp"

namespace oiler {

double round_off_energy(const World& world) {
    const Bodies& bodies = world.bodies();
    const double places = 10 * (bodies.precision() == Precision::single
                                    ? double{std::numeric_limits<float>::epsilon()}
                                    : std::numeric_limits<double>::epsilon());
    double kinetic = 0;
    for (std::size_t row = 0; row < bodies.size(); ++row) {
        const double speed = places * length(bodies.position(row)) / world.dt();
        kinetic += bodies.mass(row) * speed * speed / 2;
    }
    const Energy energy = bodies.energy();
    return std::max(kinetic, places * (energy.kinetic + std::abs(energy.potential)));
}

double joules_of(const EnergyScale& scale, const World& world) {
    return scale.joules() > round_off_energy(world) ? scale.joules() : 0;
}

}  // namespace oiler
