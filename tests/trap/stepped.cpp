// SPDX-License-Identifier: MIT
#include "trap/stepped.hpp"

#include <cmath>

namespace oiler::trap {

Stepped::Stepped(const Scene& scene, const Stepping& stepping)
    : world_(make_world(scene, Settings{stepping})),
      before_(world_.bodies().size()),
      after_(world_.bodies().size()) {
    read(after_);
}

bool Stepped::step(std::int64_t count) {
    if (count > 0) finite_ = finite_ && !world_.try_step(count);
    return finite_;
}

bool Stepped::go_to(std::int64_t n) {
    if (!finite_ || world_.tick() == n + 1) return finite_;
    if (world_.tick() < n) {
        if (!step(n - world_.tick())) return false;
        read(after_);
    }
    std::swap(before_, after_);
    if (!step(1)) return false;
    read(after_);
    return true;
}

void Stepped::read(std::vector<Point>& points) const {
    for (std::size_t row = 0; row < points.size(); ++row) {
        const auto x = world_.bodies().state(row).x;
        points[row] = {x[0], x[1], x[2]};
    }
}

}  // namespace oiler::trap
