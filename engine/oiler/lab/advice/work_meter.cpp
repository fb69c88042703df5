// SPDX-License-Identifier: MIT
#include "oiler/lab/advice/work_meter.hpp"

#include "oiler/sim/bodies.hpp"

namespace oiler::lab {

WorkMeter::WorkMeter(const Scene& scene, double most, const std::function<bool()>& stopped)
    : work_(scene), most_(most), stopped_(stopped) {
    // As many evaluations take as long as the rest of a step, and to step a body on a plane.
    constexpr double rest = 250;
    constexpr double landing = 1500;
    const Bodies bodies = make_world(scene, Settings{scene.stepping}).bodies();
    linked_ = bodies.link_count() > 0;
    per_comparison_ = rest + comparison * static_cast<double>(bodies.size());
    if (!bodies.has_obstacles()) return;
    for (std::size_t row = 0; row < bodies.size(); ++row)
        if (bodies.contact(row)) per_comparison_ += landing;
}

double WorkMeter::per_step(const Method& method) const {
    // A factorisation of the matrix of a net, beside the evaluations for it.
    constexpr double factorisation = 20;
    const bool factorises = linked_ && method.evaluations == 0;
    return work_.per_step(method) * (factorises ? factorisation : 1) + per_comparison_;
}

std::function<bool()> WorkMeter::counting(const Method& method) {
    return [this, work = per_step(method)] {
        done_ += work;
        return stopped_();
    };
}

}  // namespace oiler::lab
