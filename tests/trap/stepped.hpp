// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/scene/make_world.hpp"
#include "trap/motion.hpp"

namespace oiler::trap {

/// A run of a scene, seen step by step as a game draws it: on a line from before to after the step.
class Stepped {
public:
    Stepped(const Scene& scene, const Stepping& stepping);

    /// Takes steps until `before` is at tick `n` and `after` at tick n + 1; `n` must not decrease.
    /// Returns whether all numbers are finite.
    bool go_to(std::int64_t n);
    [[nodiscard]] const std::vector<Point>& before() const { return before_; }
    [[nodiscard]] const std::vector<Point>& after() const { return after_; }

private:
    bool step(std::int64_t count);
    void read(std::vector<Point>& points) const;

    World world_;
    std::vector<Point> before_;
    std::vector<Point> after_;
    bool finite_ = true;
};

}  // namespace oiler::trap
