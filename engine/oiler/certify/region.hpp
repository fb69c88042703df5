// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "oiler/picture/picture.hpp"
#include "oiler/physics/methods/methods.hpp"

namespace oiler::certify {

/// The plane of ω·dt and ζ in cells, each measured at its centre but for those of the lowest row,
/// which are undamped.
struct StabilityGrid {
    int columns = 150;
    int rows = 50;
    double omega_dt = 6;  ///< of the right edge
    double zeta = 2;      ///< of the upper edge

    [[nodiscard]] double omega_dt_of(int column) const;
    [[nodiscard]] double zeta_of(int row) const;
    [[nodiscard]] std::size_t size() const;
    [[nodiscard]] std::size_t index(int column, int row) const;
};

/// What became of damped springs: in theory, and when stepped.
struct StabilityRegion {
    const Method* method;
    Damping damping;
    std::vector<double> spectral_radius;  ///< of the step matrix, for each cell row by row
    std::vector<bool> stable;             ///< by its step matrix
    std::vector<bool> bounded_double;     ///< when simulated
    std::vector<bool> bounded_float;
};

/// Simulates each cell's spring over 2000 steps: bounded is what in the second half comes no
/// further than in the first, but for 5 %. An instability slower than that, below 5·10⁻⁵ a step, is
/// not seen in a run so short.
[[nodiscard]] StabilityRegion measure_region(const Method& method, Damping damping,
                                             const StabilityGrid& grid);

/// "method,damping,omega_dt,zeta,spectral_radius,stable,bounded_double,bounded_float" and a line
/// for each cell.
[[nodiscard]] std::string to_csv(const std::vector<StabilityRegion>& regions,
                                 const StabilityGrid& grid);

/// One panel for each region, all to the same scales.
[[nodiscard]] Picture atlas(const std::vector<StabilityRegion>& regions, const StabilityGrid& grid);

}  // namespace oiler::certify
