// SPDX-License-Identifier: MIT
#include "oiler/lab/reference/sampled_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace oiler::lab {
namespace {

constexpr std::size_t most_nodes = 4;

/// The places of nodes, in spacings of samples.
using Places = std::span<const Real>;

constexpr std::array<Real, most_nodes> equally_spaced{0, 1, 2, 3};

/// Hermite's interpolation of degree 2n − 1: the weights of the nodes' positions and velocities in
/// a position and in a velocity (Stoer and Bulirsch, Introduction to Numerical Analysis, 2.1.5).
class Hermite {
public:
    /// `u` is the place; `spacing` in s.
    Hermite(Places nodes, Real u, Real spacing) : nodes_(nodes.size()) {
        for (std::size_t i = 0; i < nodes_; ++i) weigh(nodes, i, u, spacing);
    }

    /// `node(i)` is the state of node i.
    template <class Node>
    [[nodiscard]] State3 operator()(Node node) const {
        State3 sum{};
        for (std::size_t i = 0; i < nodes_; ++i) {
            const Weights& w = weights_[i];
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

    void weigh(Places nodes, std::size_t i, Real u, Real spacing) {
        Real l = 1;        // Lagrange's polynomial of node i at u
        Real l_slope = 0;  // its derivative
        Real at_node = 0;  // its derivative at the node
        for (std::size_t j = 0; j < nodes_; ++j) {
            if (j == i) continue;
            const Real gap = nodes[i] - nodes[j];
            const Real factor = (u - nodes[j]) / gap;
            l_slope = l_slope * factor + l / gap;
            l *= factor;
            at_node += 1 / gap;
        }
        const Real off = u - nodes[i];
        const Real square = l * l;
        const Real square_slope = 2 * l * l_slope;
        const Real tilt = 1 - 2 * off * at_node;
        weights_[i] = {tilt * square, off * square * spacing,
                       (tilt * square_slope - 2 * at_node * square) / spacing,
                       square + off * square_slope};
    }

    std::size_t nodes_;
    std::array<Weights, most_nodes> weights_{};
};

/// The four samples around a time, or those nearest to it at either end.
struct Window {
    Window(Real t, std::int64_t per_second, std::int64_t samples)
        : spacing(1 / static_cast<Real>(per_second)),
          nodes(Places(equally_spaced)
                    .first(static_cast<std::size_t>(std::min<std::int64_t>(most_nodes, samples)))) {
        const Real at = t * static_cast<Real>(per_second);
        const auto before = static_cast<std::int64_t>(std::floor(at));
        const std::int64_t last = samples - static_cast<std::int64_t>(nodes.size());
        first = std::clamp<std::int64_t>(before - 1, 0, last);
        place = at - static_cast<Real>(first);
    }
    /// The time of a place, s.
    [[nodiscard]] Real time(Real of) const { return (static_cast<Real>(first) + of) * spacing; }
    [[nodiscard]] Real place_of(const Kink& kink) const {
        return kink.time / spacing - static_cast<Real>(first);
    }
    Real spacing;  ///< s
    Places nodes;
    std::int64_t first = 0;
    Real place = 0;  ///< in samples from the first
};

/// The nodes of a body around a time, on one side of each kink.
class SmoothNodes {
public:
    SmoothNodes(const Trajectory& trajectory, std::size_t row, const Window& window,
                std::span<const Kink> kinks) {
        // A node so close to a kink multiplies the round-off of the kink to double by up to
        // 1/close³.
        constexpr Real close = 0.125L;
        const auto later = std::ranges::find_if(
            kinks, [&](const Kink& kink) { return window.place_of(kink) > window.place; });
        Real from = -1;
        Real to = static_cast<Real>(most_nodes);
        if (later != kinks.begin()) {
            from = window.place_of(*(later - 1)) + close;
            add(from - close, (later - 1)->after);
        }
        if (later != kinks.end()) to = window.place_of(*later) - close;
        for (std::size_t i = 0; i < window.nodes.size(); ++i)
            if (const Real place = window.nodes[i]; place > from && place < to)
                add(place, trajectory.at(window.first + static_cast<std::int64_t>(i), row));
        if (later != kinks.end()) add(to + close, later->before);
        leave_out_far(window.place);
    }
    [[nodiscard]] Places places() const { return Places(places_).subspan(first_, size_ - first_); }
    [[nodiscard]] const State3& operator()(std::size_t i) const { return *states_[first_ + i]; }

private:
    void add(Real place, const State3& state) {
        places_[size_] = place;
        states_[size_++] = &state;
    }
    void leave_out_far(Real place) {
        while (size_ - first_ > most_nodes) {
            if (place - places_[first_] > places_[size_ - 1] - place)
                ++first_;
            else
                --size_;
        }
    }

    std::array<Real, most_nodes + 2> places_{};
    std::array<const State3*, most_nodes + 2> states_{};
    std::size_t first_ = 0;
    std::size_t size_ = 0;
};

/// The state of a body; `smooth` interpolates between the nodes of the window.
State3 state_in(const Window& window, const Hermite& smooth, const Trajectory& trajectory,
                std::size_t row) {
    const auto kinks =
        trajectory.kinks_between(row, window.time(0), window.time(window.nodes.back()));
    if (kinks.empty())
        return smooth([&](std::size_t i) -> const State3& {
            return trajectory.at(window.first + static_cast<std::int64_t>(i), row);
        });
    const SmoothNodes nodes(trajectory, row, window, kinks);
    return Hermite(nodes.places(), window.place, window.spacing)(nodes);
}

/// The largest distance of a sample from the polynomial through four samples from `first` on, every
/// `spacing`-th one; 0 if they are not all there, or near kinks.
double left_out(const Trajectory& trajectory, std::int64_t per_second, const Hermite& polynomial,
                std::int64_t sample, std::int64_t first, std::int64_t spacing) {
    const std::int64_t last = first + 3 * spacing;
    if (first < 0 || last >= trajectory.samples()) return 0;
    const auto time = [&](std::int64_t of) {
        return static_cast<Real>(of) / static_cast<Real>(per_second);
    };
    const Real from = time(std::min(first, sample));
    const Real until = time(std::max(last, sample));
    double most = 0;
    for (std::size_t row = 0; row < trajectory.bodies; ++row) {
        if (!trajectory.kinks_between(row, from, until).empty()) continue;
        const State3 there = polynomial([&](std::size_t i) -> const State3& {
            return trajectory.at(first + spacing * static_cast<std::int64_t>(i), row);
        });
        const Real3 off = there.x - trajectory.at(sample, row).x;
        most = std::max(most, static_cast<double>(std::sqrt(squared_length(off))));
    }
    return most;
}

/// The largest distance of one of the three first or last samples from the polynomial through the
/// four samples beside it.
double left_out_at_end(const Trajectory& trajectory, std::int64_t per_second, bool at_start) {
    const Hermite polynomial(equally_spaced, at_start ? -1.0L : 4.0L,
                             1 / static_cast<Real>(per_second));
    double most = 0;
    for (std::int64_t i = 0; i < std::min<std::int64_t>(3, trajectory.samples()); ++i) {
        const std::int64_t sample = at_start ? i : trajectory.samples() - 1 - i;
        const std::int64_t first = at_start ? sample + 1 : sample - 4;
        most = std::max(most, left_out(trajectory, per_second, polynomial, sample, first, 1));
    }
    return most;
}

double fastest_of(const Trajectory& trajectory) {
    Real most = 0;
    for (const State3& state : trajectory.states) most = std::max(most, squared_length(state.v));
    for (const auto& of_row : trajectory.kinks)
        for (const Kink& kink : of_row)
            most = std::max({most, squared_length(kink.before.v), squared_length(kink.after.v)});
    return static_cast<double>(std::sqrt(most));
}

}  // namespace

std::span<const Kink> Trajectory::kinks_between(std::size_t row, Real from, Real to) const {
    if (kinks.empty()) return {};
    const std::vector<Kink>& all = kinks[row];
    const auto first = std::ranges::upper_bound(all, from, {}, &Kink::time);
    const auto last = std::ranges::lower_bound(first, all.end(), to, {}, &Kink::time);
    return {first, last};
}

SampledMotion::SampledMotion(Trajectory trajectory, std::int64_t per_second, double fastest)
    : trajectory_(std::move(trajectory)), per_second_(per_second) {
    constexpr Real eighth = std::numbers::pi_v<Real> / 4;
    constexpr Real rounding = 1e-9L;
    const Real between = 1 / static_cast<Real>(per_second);
    longest_cubic_ =
        (1 + rounding) * (fastest > 0 ? std::max(between, eighth / Real(fastest)) : between);
    if (trajectory_.kinks.empty()) return;
    longest_cubic_ = (1 + rounding) * between;
    fastest_ = fastest_of(trajectory_);
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
    return state_in(window, Hermite(window.nodes, window.place, window.spacing), trajectory_, row);
}

void SampledMotion::all_at(Real t, std::span<State3> states) const {
    const Window window(t, per_second_, trajectory_.samples());
    const Hermite smooth(window.nodes, window.place, window.spacing);
    for (std::size_t row = 0; row < states.size(); ++row)
        states[row] = state_in(window, smooth, trajectory_, row);
}

double SampledMotion::cubic_error(std::size_t row, const State3&, const State3&, Real from,
                                  Real to) const {
    // The body and the cubic each stay within that distance of the first state.
    if (!trajectory_.kinks_between(row, from, to).empty())
        return 3 * fastest_ * static_cast<double>(to - from);
    return to - from <= longest_cubic_ ? 0 : std::numeric_limits<double>::infinity();
}

std::vector<double> interpolation_errors(const Trajectory& trajectory, std::int64_t per_second,
                                         bool may_jump) {
    // The first and the last interval have all nodes on one side.
    constexpr double at_ends = 3;
    const auto left_out_everywhere = [&](std::int64_t spacing) {
        const Hermite middle(equally_spaced, 1.5L,
                             2 * static_cast<Real>(spacing) / static_cast<Real>(per_second));
        std::vector<double> errors;
        for (std::int64_t sample = 0; sample < trajectory.samples(); ++sample)
            errors.push_back(left_out(trajectory, per_second, middle, sample, sample - 3 * spacing,
                                      2 * spacing));
        return errors;
    };
    const std::vector<double> at_twice = left_out_everywhere(1);
    const std::vector<double> at_four_times = left_out_everywhere(2);
    // Near the ends, the wide interpolation has no samples: the nearest convergence is used.
    const auto falls_at = [&](std::size_t sample) {
        return std::min(1.0, at_twice[sample] / at_four_times[sample]);
    };
    const auto is_known = [](double wide) { return wide > 0; };
    const auto first = std::ranges::find_if(at_four_times, is_known);
    double falls = first == at_four_times.end()
                       ? 1
                       : falls_at(static_cast<std::size_t>(first - at_four_times.begin()));
    std::vector<double> errors;
    double most = may_jump ? left_out_at_end(trajectory, per_second, true) : 0;
    for (std::size_t sample = 0; sample < at_twice.size(); ++sample) {
        if (is_known(at_four_times[sample])) falls = falls_at(sample);
        most = std::max(most, at_ends * at_twice[sample] * falls);
        errors.push_back(most);
    }
    if (!may_jump) return errors;
    const double at_end = left_out_at_end(trajectory, per_second, false);
    for (auto last = errors.rbegin(); last != errors.rend() && last - errors.rbegin() < 4; ++last)
        *last = std::max(*last, at_end);
    return errors;
}

}  // namespace oiler::lab
