// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "oiler/physics/methods/methods.hpp"
#include "oiler/picture/picture.hpp"

namespace oiler::certify {

/// The plane of ω·dt and ζ in cells. Each is measured at its centre, except for ζ of the lowest
/// row, which is 0.
struct StabilityGrid {
    int columns = 150;
    int rows = 50;
    double omega_dt = 6;  ///< at the right edge
    double zeta = 2;      ///< at the upper edge

    [[nodiscard]] double omega_dt_of(int column) const {
        return omega_dt * (column + 0.5) / columns;
    }
    [[nodiscard]] double zeta_of(int row) const { return row == 0 ? 0 : zeta * (row + 0.5) / rows; }
    [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(columns * rows); }
    [[nodiscard]] std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row * columns + column);
    }
};

/// The stability of a method on damped springs, by theory and by simulation.
struct StabilityRegion {
    const Method* method;
    Damping damping;
    std::vector<double> spectral_radius;  ///< of the step matrix, for each cell row by row
    std::vector<bool> stable;             ///< by the step matrix
    std::vector<bool> bounded_double;     ///< by simulation
    std::vector<bool> bounded_float;
};

/// Simulates each cell's spring over 2000 steps. A spring is bounded if its amplitude in the second
/// half exceeds that in the first by at most 5 %. A growth below 5·10⁻⁵ per step is not detected.
[[nodiscard]] StabilityRegion measure_region(const Method& method, Damping damping,
                                             const StabilityGrid& grid);

/// The header "method,damping,omega_dt,zeta,spectral_radius,stable,bounded_double,bounded_float",
/// and one line per cell.
[[nodiscard]] std::string to_csv(const std::vector<StabilityRegion>& regions,
                                 const StabilityGrid& grid);

/// Draws one panel per region, all to the same scales.
[[nodiscard]] Picture atlas(const std::vector<StabilityRegion>& regions, const StabilityGrid& grid);

}  // namespace oiler::certify
