// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include "oiler/scene/make_world.hpp"
#include "oiler/scene/scene.hpp"
#include "trap/truth.hpp"

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

/// Where the positions of a run count.
enum class Meaning {
    drawn,     ///< at all times, on the lines between the steps
    at_steps,  ///< at the steps
    display,   ///< on the lines, 60 times per second
};

/// The largest distance of any body from the truth, m. It is infinite if the run diverges.
struct Errors {
    Real drawn = 0;
    Real at_steps = 0;
};

struct Effort {
    Real samples = 3e7L;                                  ///< a sample of an oscillator counts 1
    Real enough = std::numeric_limits<Real>::infinity();  ///< stops above this error as drawn
};

/// Samples every step at 64 instants or more. If that exceeds the effort, takes fewer instants of
/// short steps, and then leaves out steps: the errors are then lower bounds.
[[nodiscard]] Errors measure(const Scene& scene, const Stepping& stepping, Truth& truth,
                             const Effort& effort = {});

/// The largest distance at t = i/60 s, m.
[[nodiscard]] Real display_error(const Scene& scene, const Stepping& stepping, Truth& truth);

/// One of the errors.
[[nodiscard]] Real error_of(const Scene& scene, const Stepping& stepping, Truth& truth,
                            Meaning meaning, const Effort& effort = {});

}  // namespace oiler::trap
