// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/scene/scene.hpp"

namespace oiler::lab {

/// Estimates the work of a step: force evaluations, each on one body or link.
class RunWork {
public:
    explicit RunWork(const Scene& scene);
    [[nodiscard]] double per_step(const Method& method) const;

private:
    double per_evaluation_;
    double to_solve_;  ///< evaluations per implicit step
};

}  // namespace oiler::lab
