// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "oiler/sim/body.hpp"
#include "oiler/stability/stability.hpp"

namespace oiler {

class Bodies;

/// The oscillation of a body on its springs, or of two bodies on their link.
struct BodyOscillation {
    std::size_t row;
    std::optional<std::size_t> linked;  ///< the other row
    Oscillation of;
};

/// The sums of the springs and dampers on a body, without links.
struct OwnMotion {
    Oscillation linear{};  ///< of those that act in all directions, and of linear drag
    Oscillation all{};
    bool has_lines = false;  ///< some act along a line
};
[[nodiscard]] std::vector<OwnMotion> own_motions(const Bodies& bodies);

/// The oscillations of a scene: one per body without links and one per link, with all springs and
/// dampers in it. With `dampers_split`, dampers along a line are left out, because the method
/// applies them separately. A body without links oscillates with the sum of its springs. No mode of
/// linked bodies is faster than the fastest link with all springs at its two ends: ω² ≤ Σk/m₁ +
/// Σk/m₂ (Anderson and Morley, Eigenvalues of the Laplacian of a graph, 1985, with masses).
[[nodiscard]] std::vector<BodyOscillation> oscillations(const Bodies& bodies, bool dampers_split);

/// The displacements (or velocities) of the bodies of a component, times the square roots of their
/// masses: stiffness and damping matrices are then symmetric.
using WeightedVectors = std::vector<Vec3>;

/// A linear spring or damper between two bodies, or from a body to the ground: the force on `a` is
/// −(along·d̂d̂ᵀ + all)·(x_a − x_b).
struct Coupling {
    static constexpr std::size_t ground = static_cast<std::size_t>(-1);

    std::size_t a;  ///< index in the component
    std::size_t b;  ///< index in the component, or `ground`
    Vec3 direction{};
    double along = 0;  ///< N/m or N·s/m
    double all = 0;    ///< N/m or N·s/m, in all directions
    bool is_rope = false;
};

/// Bodies that links connect, or one body, with their springs and dampers linearised at the present
/// positions. A spring with a rest length acts along its line. If it is stretched, its tension acts
/// across the line too. The negative stiffness across a compressed spring is left out, because it
/// vanishes as soon as the spring relaxes. A spring of length 0 has no direction and acts in all.
/// So the stiffness along a line is part of the sum whichever way a player rotates the bodies.
/// Negative stiffness and damping diverge with any method and are left out too. All ropes are taut,
/// as they may be later.
struct Component {
    int axes = 1;
    std::vector<std::size_t> rows{};
    std::vector<double> inverse_root_mass{};  ///< kg^−½
    std::vector<double> drag{};  ///< 1/s, of linear drag and of springs without rest length
    std::vector<Coupling> springs{};
    std::vector<Coupling> dampers{};  ///< all other dampers, in the order in which steps apply them

    [[nodiscard]] std::size_t freedoms() const {
        return rows.size() * static_cast<std::size_t>(axes);
    }
    [[nodiscard]] Vec3 between(const Coupling& coupling, const WeightedVectors& u) const;
    /// Adds a coupling's product with the mass-weighted vectors, times `scale`.
    void add_product(const Coupling& coupling, const WeightedVectors& u, double scale,
                     WeightedVectors& to) const;
    /// The energy of a coupling at the mass-weighted displacements, times 2.
    [[nodiscard]] double energy(const Coupling& coupling, const WeightedVectors& u) const;
    /// The spring that holds the most energy; a damper if no spring holds any. Null without either.
    [[nodiscard]] const Coupling* most_strained(const WeightedVectors& u) const;
};

/// Labels the rows by their component: the smallest row that links connect with a row.
[[nodiscard]] std::vector<std::size_t> component_labels(const Bodies& bodies);

/// The component of one body, without links.
[[nodiscard]] Component component_of_row(const Bodies& bodies, std::size_t row);

/// All components of bodies with links.
[[nodiscard]] std::vector<Component> linked_components(const Bodies& bodies,
                                                       const std::vector<std::size_t>& labels);

}  // namespace oiler
