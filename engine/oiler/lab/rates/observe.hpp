// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "oiler/lab/reference/path.hpp"
#include "oiler/lab/sweep/judge.hpp"

namespace oiler::lab {

/// The quantities that a player notices in one run of a body; `unknown` if the run lacks one.
struct Observed {
    double apex = unknown;
    double apex_time = unknown;
    double landing_time = unknown;
    double landing_place = unknown;
    double first_impact = unknown;
    double bounce_1 = unknown;
    double bounce_3 = unknown;
    double bounce_10 = unknown;
    double rest_time = unknown;
    double period = unknown;
    double mean_period = unknown;
    double amplitude = unknown;
    double half_range = unknown;
    double overshoot = unknown;
    double settle_time = unknown;
};

/// The motion of a body: its three coordinates, and the times of its impacts, s.
struct Trace {
    std::array<Path, 3> paths{};
    std::vector<double> impacts{};   ///< on the floor
    std::vector<double> meetings{};  ///< with any obstacle
};

/// Whether a body that an obstacle turns or stops approaches it, rather than slides along it.
[[nodiscard]] bool approaches(const Real3& normal, const Real3& velocity);

/// The floor under a body: the plane that faces gravity most.
struct Floor {
    ObstacleHandle plane{};
    Real3 normal{};   ///< of length 1
    Real offset = 0;  ///< m, with the body's radius
};

/// The axes, the floor, the oscillation and the rest along which a body is measured.
class Observer {
public:
    Observer(const Scene& scene, const Reference& reference, std::size_t row);

    [[nodiscard]] const Observed& truth() const { return truth_; }
    /// Measures a run as drawn: straight lines between steps.
    [[nodiscard]] Observed observe(const Trace& trace) const;
    [[nodiscard]] const std::optional<Floor>& floor() const { return floor_; }

private:
    /// A coordinate that comes to rest.
    struct Rest {
        int axis = 0;
        double at = 0;            ///< m
        double band = 0;          ///< m, within which the body has settled
        double shortest_end = 0;  ///< s, for which a run must stay within the band
    };

    [[nodiscard]] Trace true_trace(const Reference& reference, std::size_t row) const;
    [[nodiscard]] std::optional<Rest> find_rest(const Reference& reference, std::size_t row,
                                                const Trace& truth) const;
    void find_oscillation_or_rest(const Reference& reference, std::size_t row, const Trace& truth);
    [[nodiscard]] Path height_along_gravity(const Trace& trace) const;
    /// The time at which the body is lowest after the first of its highest points, s.
    [[nodiscard]] double end_of_first_apex(const Trace& truth) const;
    void observe_jump(Observed& observed, const Trace& trace) const;
    void observe_bounces(Observed& observed, const Trace& trace) const;
    void observe_oscillation(Observed& observed, const Trace& trace) const;
    void observe_rest(Observed& observed, const Trace& trace) const;

    std::optional<int> up_;      ///< the axis of gravity
    double up_sign_ = 1;         ///< −1 if up is the negative direction
    std::optional<int> across_;  ///< the axis of the place of landing
    std::optional<Floor> floor_;
    double noise_ = 0;       ///< m: lower flights are no bounces, closer apexes equally high
    double apex_until_ = 0;  ///< s
    std::optional<PeriodicCoordinate> oscillation_;
    bool bounces_aside_ = false;  ///< the first impact is on no floor
    bool is_regular_ = false;     ///< the oscillation has an amplitude, else only a range
    std::optional<Rest> rest_;
    Observed truth_;
};

}  // namespace oiler::lab
