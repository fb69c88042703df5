// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "oiler/lab/reference/exact_motion.hpp"
#include "oiler/lab/reference/samples.hpp"

namespace oiler::lab {

/// The smallest error that a reference resolves, as a multiple of its own error.
inline constexpr double margin = 100;

/// Bounds of the error up to a sample.
struct Uncertainty {
    double position = 0;  ///< m
    double velocity = 0;  ///< m/s
    double energy = 0;    ///< relative to Reference::energy_scale
};

/// An oscillating coordinate, for phase errors.
struct PeriodicCoordinate {
    std::size_t row = 0;
    int axis = 0;
    double level = 0;                 ///< m, crossed upwards once per period
    double band = 0;                  ///< m, dead band around the level
    double period = 0;                ///< s
    std::vector<double> crossings{};  ///< s, times of upward crossings
};

/// The motion with which runs of a scene are compared: the closed form if the scene has one, else
/// steps in long double so fine that their own error is known.
struct Reference {
    std::shared_ptr<const Motion> motion;
    Perturbation start{};  ///< of the scene's start
    SampleTimes samples;   ///< of the uncertainties
    bool closed_form = false;
    std::string words;                       ///< kind and own error, for people
    std::vector<Uncertainty> uncertainties;  ///< for each sample, the largest up to it
    double extent = 0;                       ///< m, the largest distance of any body from its start
    double coordinate = 0;                   ///< m, the largest coordinate of any body
    double speed = 0;                        ///< m/s, the largest component of a velocity
    double energy_scale = 0;                 ///< J, the unit of energy drifts, see scales_of
    bool conservative = false;               ///< no force takes or gives energy
    std::optional<PeriodicCoordinate> oscillation{};
    /// The last time at which errors are meaningful, s. It is before the end if the scene is
    /// chaotic: its motion then diverges from any reference, or changes by round-off to double
    /// alone.
    double meaningful_until = 0;
    std::string why_no_longer{};  ///< empty if errors are meaningful to the end

    /// The energy relative to energy_scale; unchanged, in J, for a scene without energy.
    [[nodiscard]] double share_of_energy(double joules) const;
    /// The smallest errors that the reference resolves: 100 × its own.
    [[nodiscard]] Uncertainty floor() const;
};

/// Whether nothing moves in the scene.
[[nodiscard]] bool rests(const Reference& reference);

/// The accuracy wanted of a reference, and the work it may take.
struct ReferenceEffort {
    /// The reference's own error, m; 0 for 10⁻¹² of the extent.
    double wanted = 0;
    /// The limit of force evaluations, each on one body or link, in the finest run.
    double most_work = 2e9;
    /// Called with the fraction of the work that is done, from 0 to 1.
    std::function<void(double)> progress = [](double) {};
    std::function<bool()> stopped = [] { return false; };
};

/// Returns the closed form of all bodies' motion, if there is one. Tests pass wrong ones.
using ClosedForm =
    std::function<std::optional<std::vector<ExactMotion>>(const Bodies& bodies, double until)>;

/// Makes the reference of a scene. A closed form is compared with fine steps; if they disagree, it
/// is rejected, and `words` says so. The result of a stopped call is incomplete. Throws
/// Error{usage} if the reference takes too much work, and Error{diverged} if no reference stays
/// finite.
[[nodiscard]] Reference make_reference(const Scene& scene, const ReferenceEffort& effort,
                                       const Perturbation& start = {},
                                       const ClosedForm& closed_form = exact_motions);

/// The energy of a scene's true motion.
class TrueEnergy {
public:
    TrueEnergy(const Scene& scene, const Reference& reference);
    ~TrueEnergy();

    /// The energy at a time (s), J.
    [[nodiscard]] double at(Real t);
    /// The energy in states of the true motion, J.
    [[nodiscard]] double of(std::span<const State3> states);

private:
    const Reference& reference_;
    std::unique_ptr<Bodies> bodies_;
    std::vector<State3> states_;
    double at_start_;  ///< J
};

}  // namespace oiler::lab
