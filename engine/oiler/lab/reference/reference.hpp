// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "oiler/lab/reference/exact_motion.hpp"
#include "oiler/lab/reference/samples.hpp"

namespace oiler::lab {

/// Where all bodies are at every look, and the energy in J.
struct Track {
    std::size_t bodies = 0;
    std::vector<State<long double, 3>>
        states{};  ///< of all bodies at the first look, then the next
    std::vector<double> energies{};

    [[nodiscard]] const State<long double, 3>& at(std::int64_t look, std::size_t row) const {
        return states[static_cast<std::size_t>(look) * bodies + row];
    }
};

/// How wrong something may be, up to a look.
struct Doubt {
    double position = 0;  ///< m
    double velocity = 0;  ///< m/s
    double energy = 0;    ///< of Reference::energy_scale
};

/// A coordinate that swings to and fro, by which phases are told.
struct Swing {
    std::size_t row = 0;
    int axis = 0;
    double level = 0;                 ///< m, which it crosses upwards once in a period
    double band = 0;                  ///< m, below which it is at rest
    double period = 0;                ///< s
    std::vector<double> crossings{};  ///< s
};

/// What runs of a scene are held against. It is never made by what it judges: the closed form where
/// the scene has one, else steps in long double so fine that their own error is known.
struct Reference {
    Looks looks;
    Track track;
    bool closed_form = false;
    std::string words;          ///< what it is and how good
    std::vector<Doubt> doubts;  ///< at each look the largest up to it
    double extent = 0;          ///< m, how far any body gets from its start
    double energy_scale = 0;    ///< J, by which energy drifts are told
    std::optional<Swing> swing{};
    /// How many looks from the first on errors mean anything: fewer than all where the scene is
    /// chaotic, so that it outgrows any reference, or roundings to double.
    std::int64_t meaningful = 0;
    std::string why_no_longer{};  ///< where they do not mean anything to the end

    /// Relative to the scale; what it is in J for a scene that has no energy.
    [[nodiscard]] double share_of_energy(double joules) const;
    /// Below which it cannot tell errors: a hundred times its own.
    [[nodiscard]] Doubt floor() const;
    [[nodiscard]] Looks meaningful_looks() const { return {looks.per_second, meaningful}; }
    /// In s.
    [[nodiscard]] double meaningful_until() const { return looks.time(meaningful - 1); }
};

/// How much trouble to take over a reference.
struct ReferenceEffort {
    /// Its own error in m; 0: a millionth of a millionth of what the bodies move.
    double wanted = 0;
    /// Evaluations of forces on one body or link in the finest run.
    double most_work = 2e9;
    /// Share of the work that is done, from 0 to 1.
    std::function<void(double)> progress = [](double) {};
    std::function<bool()> stopped = [] { return false; };
};

/// The closed form of a scene's bodies, or another that is claimed to be.
using ClosedForm = std::function<std::optional<std::vector<ExactMotion>>(const Bodies& bodies)>;

/// Stopped, it is of no use. A closed form is held against fine steps; where these disagree, it is
/// the closed form that is not believed, and the words say so.
[[nodiscard]] Reference make_reference(const Scene& scene, const Looks& looks,
                                       const ReferenceEffort& effort,
                                       const ClosedForm& closed_form = exact_motions);

/// What steps of a scene take, about: evaluations of the forces on one body or link.
class Work {
public:
    explicit Work(const Scene& scene);
    [[nodiscard]] double per_step(const Method& method) const;

private:
    double per_evaluation_;
    double to_solve_;  ///< evaluations, of an implicit step
};

}  // namespace oiler::lab
