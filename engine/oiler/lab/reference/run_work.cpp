// SPDX-License-Identifier: MIT
#include "oiler/lab/reference/run_work.hpp"

#include <cmath>

#include "oiler/scene/make_world.hpp"
#include "oiler/sim/bodies.hpp"

namespace oiler::lab {

RunWork::RunWork(const Scene& scene) {
    const Bodies bodies = make_world(scene, Settings{scene.stepping}).bodies();
    const auto size = static_cast<double>(bodies.size());
    const auto links = static_cast<double>(bodies.link_count());
    per_evaluation_ = size + links;
    // A few iterations; each factorises the matrix of a net.
    to_solve_ = 4 * (links > 0 ? std::sqrt(size * scene.axes) : 1);
}

double RunWork::per_step(const Method& method) const {
    return per_evaluation_ * (method.evaluations > 0 ? method.evaluations : to_solve_);
}

}  // namespace oiler::lab
