// SPDX-License-Identifier: MIT
#include "oiler/lab/reference/exact_motions.hpp"

#include <algorithm>
#include <map>

namespace oiler::lab {
namespace {

using Real = long double;
using State3 = State<Real, 3>;

}  // namespace

ExactMotions::ExactMotions(std::vector<ExactMotion> motions) : motions_(std::move(motions)) {
    std::map<std::pair<Real, Real>, std::size_t> groups;
    for (std::size_t row = 0; row < motions_.size(); ++row) {
        const LinearMotion* const motion = motions_[row].linear();
        group_.push_back(alone);
        steady_bends_.push_back(motions_[row].steady_bend());
        if (!motion) continue;
        const auto [at, is_new] =
            groups.try_emplace(std::pair(motion->k, motion->c), first_of_group_.size());
        if (is_new) first_of_group_.push_back(row);
        group_.back() = at->second;
    }
}

void ExactMotions::all_at(Real t, std::span<State3> states) const {
    std::vector<LinearFactors> factors;
    for (const std::size_t row : first_of_group_)
        factors.push_back(factors_at(*motions_[row].linear(), t));
    for (std::size_t row = 0; row < states.size(); ++row) {
        const LinearMotion* const motion = motions_[row].linear();
        states[row] =
            motion ? state_after(*motion, motion->start, factors[group_[row]]) : motions_[row](t);
    }
}

/// The states at consecutive ticks: linear motions from the states at the start of a block of
/// ticks, with factors that all blocks share; orbits from their latest solutions.
class ExactMotions::Blocks {
public:
    Blocks(const ExactMotions& motions, std::int64_t rate)
        : motions_(motions), rate_(static_cast<Real>(rate)), solutions_(motions.bodies()) {
        constexpr std::size_t most_factors = 1 << 16;
        const std::size_t groups = std::max<std::size_t>(1, motions.first_of_group_.size());
        length_ = std::clamp<std::int64_t>(static_cast<std::int64_t>(most_factors / groups), 1, 64);
        for (std::int64_t tick = 0; tick < length_; ++tick)
            for (const std::size_t row : motions.first_of_group_)
                factors_.push_back(
                    factors_at(*motions.motions_[row].linear(), static_cast<Real>(tick) / rate_));
    }

    void write(std::int64_t tick, std::span<State3> states) {
        if (const std::int64_t block = tick / length_; block != block_) {
            block_ = block;
            starts_.resize(states.size());
            motions_.all_at(static_cast<Real>(block * length_) / rate_, starts_);
        }
        const auto first =
            static_cast<std::size_t>(tick % length_) * motions_.first_of_group_.size();
        const Real t = static_cast<Real>(tick) / rate_;
        for (std::size_t row = 0; row < states.size(); ++row) {
            const ExactMotion& motion = motions_.motions_[row];
            if (const LinearMotion* const linear = motion.linear()) {
                states[row] =
                    state_after(*linear, starts_[row], factors_[first + motions_.group_[row]]);
            } else if (const OrbitMotion* const orbit = motion.orbit()) {
                states[row] = orbit->ellipse.at(t, solutions_[row]);
                states[row].x = states[row].x + orbit->centre;
            } else {
                states[row] = motion(t);
            }
        }
    }

private:
    const ExactMotions& motions_;
    Real rate_;
    std::int64_t length_ = 1;
    std::vector<LinearFactors> factors_;  ///< of each tick of a block, for each group
    std::int64_t block_ = -1;
    std::vector<State3> starts_;
    std::vector<Ellipse<Real>::Solution> solutions_;  ///< of the latest tick, for orbits
};

Motion::Walk ExactMotions::walk(std::int64_t rate) const {
    return [blocks = Blocks(*this, rate)](std::int64_t tick, std::span<State3> states) mutable {
        blocks.write(tick, states);
    };
}

}  // namespace oiler::lab
