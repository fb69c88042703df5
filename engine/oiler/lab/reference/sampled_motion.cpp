// SPDX-License-Identifier: MIT
#include "oiler/lab/reference/sampled_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace oiler::lab {
namespace {

using Real = long double;
using State3 = State<Real, 3>;

constexpr std::int64_t most_nodes = 4;

/// Hermite's interpolation of degree 2n − 1 at nodes of equal spacing: the weights of the nodes'
/// positions and velocities in a position and in a velocity (Stoer and Bulirsch, Introduction to
/// Numerical Analysis, 2.1.5).
class Hermite {
public:
    /// `u` is the place, in spacings from the first node; `spacing` in s.
    Hermite(std::int64_t nodes, Real u, Real spacing) : nodes_(nodes) {
        for (std::int64_t i = 0; i < nodes; ++i) weigh(i, u, spacing);
    }

    /// `node(i)` is the state of node i.
    template <class Node>
    [[nodiscard]] State3 operator()(Node node) const {
        State3 sum{};
        for (std::int64_t i = 0; i < nodes_; ++i) {
            const Weights& w = weights_[static_cast<std::size_t>(i)];
            const State3& state = node(i);
            sum.x = sum.x + state.x * w.x_in_x + state.v * w.v_in_x;
            sum.v = sum.v + state.x * w.x_in_v + state.v * w.v_in_v;
        }
        return sum;
    }

private:
    struct Weights {
        Real x_in_x, v_in_x, x_in_v, v_in_v;
    };

    void weigh(std::int64_t i, Real u, Real spacing) {
        Real l = 1;        // Lagrange's polynomial of node i at u
        Real l_slope = 0;  // its derivative
        Real at_node = 0;  // its derivative at the node
        for (std::int64_t j = 0; j < nodes_; ++j) {
            if (j == i) continue;
            const Real gap = static_cast<Real>(i - j);
            const Real factor = (u - static_cast<Real>(j)) / gap;
            l_slope = l_slope * factor + l / gap;
            l *= factor;
            at_node += 1 / gap;
        }
        const Real off = u - static_cast<Real>(i);
        const Real square = l * l;
        const Real square_slope = 2 * l * l_slope;
        const Real tilt = 1 - 2 * off * at_node;
        weights_[static_cast<std::size_t>(i)] = {
            tilt * square, off * square * spacing,
            (tilt * square_slope - 2 * at_node * square) / spacing, square + off * square_slope};
    }

    std::int64_t nodes_;
    std::array<Weights, most_nodes> weights_{};
};

/// The four samples around a time, or those nearest to it at either end.
struct Window {
    Window(Real t, std::int64_t per_second, std::int64_t samples)
        : nodes(std::min(most_nodes, samples)) {
        const Real at = t * static_cast<Real>(per_second);
        const auto before = static_cast<std::int64_t>(std::floor(at));
        first = std::clamp<std::int64_t>(before - 1, 0, samples - nodes);
        place = at - static_cast<Real>(first);
    }
    std::int64_t nodes;
    std::int64_t first = 0;
    Real place = 0;  ///< in samples from the first
};

/// The largest distance of a sample from the interpolation through the samples 1 and 3 `spacing`s
/// before and after it; 0 near the ends.
double left_out(const Trajectory& trajectory, const Hermite& middle, std::int64_t sample,
                std::int64_t spacing) {
    const std::int64_t first = sample - 3 * spacing;
    if (first < 0 || sample + 3 * spacing >= trajectory.samples()) return 0;
    double most = 0;
    for (std::size_t row = 0; row < trajectory.bodies; ++row) {
        const State3 between = middle([&](std::int64_t i) -> const State3& {
            return trajectory.at(first + 2 * spacing * i, row);
        });
        const auto& exact = trajectory.at(sample, row);
        most = std::max(most, static_cast<double>(std::sqrt(squared_length(between.x - exact.x))));
    }
    return most;
}

/// The factor of the error from the wide to the narrow spacing at the first sample that has both; 1
/// if none has.
double first_convergence(const Trajectory& trajectory, const Hermite& narrow, const Hermite& wide) {
    for (std::int64_t sample = 6; sample + 6 < trajectory.samples(); ++sample)
        if (const double far = left_out(trajectory, wide, sample, 2); far > 0)
            return std::min(1.0, left_out(trajectory, narrow, sample, 1) / far);
    return 1;
}

}  // namespace

SampledMotion::SampledMotion(Trajectory trajectory, std::int64_t per_second, double fastest)
    : trajectory_(std::move(trajectory)), per_second_(per_second) {
    constexpr Real eighth = std::numbers::pi_v<Real> / 4;
    constexpr Real rounding = 1e-9L;
    const Real between = 1 / static_cast<Real>(per_second);
    longest_cubic_ =
        (1 + rounding) * (fastest > 0 ? std::max(between, eighth / Real(fastest)) : between);
}

std::optional<std::int64_t> SampledMotion::sample_at(Real t) const {
    const auto per_second = static_cast<Real>(per_second_);
    const std::int64_t nearest = std::llround(t * per_second);
    if (static_cast<Real>(nearest) / per_second != t || nearest >= trajectory_.samples())
        return std::nullopt;
    return nearest;
}

State3 SampledMotion::at(std::size_t row, Real t) const {
    if (const auto sample = sample_at(t)) return trajectory_.at(*sample, row);
    const Window window(t, per_second_, trajectory_.samples());
    const Hermite interpolate(window.nodes, window.place, 1 / static_cast<Real>(per_second_));
    return interpolate(
        [&](std::int64_t i) -> const State3& { return trajectory_.at(window.first + i, row); });
}

void SampledMotion::all_at(Real t, std::span<State3> states) const {
    const Window window(t, per_second_, trajectory_.samples());
    const Hermite interpolate(window.nodes, window.place, 1 / static_cast<Real>(per_second_));
    for (std::size_t row = 0; row < states.size(); ++row)
        states[row] = interpolate(
            [&](std::int64_t i) -> const State3& { return trajectory_.at(window.first + i, row); });
}

double SampledMotion::bend(std::size_t, const State3&, const State3&, Real from, Real to) const {
    return to - from <= longest_cubic_ ? 0 : std::numeric_limits<double>::infinity();
}

std::vector<double> interpolation_errors(const Trajectory& trajectory, std::int64_t per_second) {
    // The first and the last interval have all nodes on one side.
    constexpr double at_ends = 3;
    const auto middle_of = [&](Real spacing) {
        return Hermite(most_nodes, 1.5L, 2 * spacing / static_cast<Real>(per_second));
    };
    const Hermite narrow = middle_of(1);
    const Hermite wide = middle_of(2);
    std::vector<double> errors;
    double most = 0;
    // Near the ends, where the wider interpolation has no samples, that of the nearest holds.
    double falls = first_convergence(trajectory, narrow, wide);
    for (std::int64_t sample = 0; sample < trajectory.samples(); ++sample) {
        const double at_twice = left_out(trajectory, narrow, sample, 1);
        const double at_four_times = left_out(trajectory, wide, sample, 2);
        if (at_four_times > 0) falls = std::min(1.0, at_twice / at_four_times);
        most = std::max(most, at_ends * at_twice * falls);
        errors.push_back(most);
    }
    return errors;
}

}  // namespace oiler::lab
