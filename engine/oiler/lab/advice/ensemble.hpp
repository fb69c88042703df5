// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "oiler/lab/advice/advise.hpp"

namespace oiler::lab {

/// Perturbed starts of a scene: positions by up to 0.1 % of the extent, velocities by up to 0.1 %
/// of the speed. A scene at rest is moved by 0.1 % of its size; there, errors up to twice that are
/// tolerated, because only instability makes them larger.
class Ensemble {
public:
    Ensemble(const Scene& scene, const Reference& reference, const Requirements& requirements,
             const std::function<bool()>& stopped)
        : scene_(scene), reference_(reference), requirements_(requirements), stopped_(stopped) {}

    /// Why a setting that meets the tolerances is not advised: a warning before the run, at this
    /// rate or 5 % below it, or an error from a perturbed start. Empty if it holds.
    [[nodiscard]] std::string objection(const Stepping& choice);

    /// The number of starts that were judged. Those without a reference that can judge the
    /// tolerance are left out.
    [[nodiscard]] std::size_t size() const { return members_.size(); }

private:
    struct Member {
        Reference reference;
        Requirements requirements;
    };
    struct Known {
        Stepping choice;
        std::string objection;
    };

    [[nodiscard]] std::string warning(Stepping choice) const;
    void make_members();
    [[nodiscard]] std::string judge_members(const Stepping& choice);

    const Scene& scene_;
    const Reference& reference_;
    const Requirements& requirements_;
    const std::function<bool()>& stopped_;
    std::vector<Member> members_;
    bool is_made_ = false;
    std::vector<Known> known_;
};

}  // namespace oiler::lab
