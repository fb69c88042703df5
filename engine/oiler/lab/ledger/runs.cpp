// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <cmath>

#include "oiler/core/error.hpp"
#include "oiler/core/seconds_since.hpp"
#include "oiler/lab/ledger/parts.hpp"
#include "oiler/scene/make_world.hpp"

namespace oiler::lab {
namespace {

using Clock = std::chrono::steady_clock;

/// The limit of bodies × steps of all worlds together. A step of fewer bodies than `block` counts
/// as one of `block`.
constexpr double most_body_steps = 1.5e9;
constexpr double block = 16;
/// The limit of bodies × comparisons of all worlds together.
constexpr double most_compared_bodies = 4e7;
constexpr double most_comparing_seconds = 10;

/// Steps a world that may diverge.
class TrialRun {
public:
    explicit TrialRun(const Scene& scene) : world_(make_world(scene, Settings{scene.stepping})) {
        world_.require_applicable();
    }

    void step(std::int64_t count) try {
        if (!diverged_) world_.step(count);
    } catch (const Error& error) {
        if (error.exit() != Exit::diverged) throw;
        diverged_ = error.what();
    }
    [[nodiscard]] const Bodies& bodies() const { return world_.bodies(); }
    [[nodiscard]] const std::optional<std::string>& diverged() const { return diverged_; }

private:
    World world_;
    std::optional<std::string> diverged_;
};

class Comparing {
public:
    Comparing(const Scene& scene, const std::vector<Ablation>& ablations)
        : whole_(scene), start_(whole_.bodies()) {
        trials_.reserve(ablations.size());
        for (const Ablation& ablation : ablations) trials_.emplace_back(ablation.scene);
        result_.without.resize(ablations.size());
    }

    Comparison run(std::int64_t wanted, const LedgerProgress& progress) {
        const std::int64_t steps = std::min(wanted, most_steps());
        const std::int64_t stride = (steps + most_samples() - 1) / most_samples();
        const auto started = Clock::now();
        const auto goes_on = [&] {
            return result_.steps < 2 || seconds_since(started) < most_comparing_seconds;
        };
        while (result_.steps < steps && !whole_.diverged() && goes_on()) {
            advance(std::min({stride, steps - result_.steps, affordable(seconds_since(started))}));
            progress(comparing_share * static_cast<double>(result_.steps) /
                     static_cast<double>(steps));
        }
        result_.diverged = whole_.diverged();
        for (std::size_t i = 0; i < trials_.size(); ++i)
            result_.without[i].diverged = trials_[i].diverged();
        return std::move(result_);
    }

private:
    [[nodiscard]] double worlds() const { return static_cast<double>(trials_.size() + 1); }
    [[nodiscard]] double bodies() const { return static_cast<double>(start_.size()); }

    [[nodiscard]] std::int64_t most_steps() const {
        const double most = most_body_steps / worlds() / std::max(bodies(), block);
        return std::max<std::int64_t>(2, std::llround(most));
    }
    [[nodiscard]] std::int64_t most_samples() const {
        const double most = most_compared_bodies / worlds() / std::max(bodies(), block);
        return std::max<std::int64_t>(1, std::llround(most));
    }

    /// The number of steps that take about 1 s, if those so far took `seconds`.
    [[nodiscard]] std::int64_t affordable(double seconds) const {
        const double steps = static_cast<double>(result_.steps) / std::max(seconds, 1e-9);
        return std::max<std::int64_t>(1, std::llround(steps));
    }

    void advance(std::int64_t count) {
        whole_.step(count);
        result_.steps += count;
        if (whole_.diverged()) return;
        ++result_.samples;
        const Vec3 along = whole_.bodies().deviation_from(start_).along;
        for (int axis = 0; axis < 3; ++axis)
            result_.moved[axis] = std::max(result_.moved[axis], along[axis]);
        for (std::size_t i = 0; i < trials_.size(); ++i) advance(trials_[i], i, count);
    }
    void advance(TrialRun& trial, std::size_t i, std::int64_t count) {
        trial.step(count);
        if (trial.diverged()) return;
        double& change = result_.without[i].change;
        change = std::max(change, whole_.bodies().deviation_from(trial.bodies()).distance);
    }

    TrialRun whole_;
    Bodies start_;
    std::vector<TrialRun> trials_;
    Comparison result_;
};

}  // namespace

Comparison compare(const Scene& scene, const std::vector<Ablation>& ablations, std::int64_t steps,
                   const LedgerProgress& progress) {
    return Comparing(scene, ablations).run(steps, progress);
}

}  // namespace oiler::lab
