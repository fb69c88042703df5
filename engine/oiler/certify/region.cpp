// SPDX-License-Identifier: MIT
#include "oiler/certify/region.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "oiler/sim/bodies.hpp"
#include "oiler/stability/stability.hpp"

namespace oiler::certify {
namespace {

std::vector<Oscillation> oscillations(const StabilityGrid& grid) {
    std::vector<Oscillation> cells;
    for (int row = 0; row < grid.rows; ++row)
        for (int column = 0; column < grid.columns; ++column) {
            const double omega = grid.omega_dt_of(column);
            cells.push_back({omega * omega, 2 * grid.zeta_of(row) * omega});
        }
    return cells;
}

/// The springs of all cells, stepped together. They start small, so that the most unstable do not
/// overflow in their first steps. A spring that has grown by 10⁶ is unbounded. It is reset to zero,
/// as is one that has shrunk by 10⁻⁸, because subnormal numbers are slow.
class Springs {
public:
    Springs(const Method& method, Damping damping, const std::vector<Oscillation>& cells,
            Precision precision)
        : method_(method),
          damping_(damping),
          bodies_(1, precision),
          omega_(cells.size()),
          unbounded_(cells.size()) {
        for (std::size_t i = 0; i < cells.size(); ++i) {
            omega_[i] = std::sqrt(cells[i].k);
            bodies_.add({.position = {start}, .velocity = {0.7 * start * omega_[i]}},
                        Spring{.stiffness = cells[i].k, .damping = cells[i].c});
        }
    }

    /// The largest amplitude of each spring over `samples` samples, `least` to `least + spread − 1`
    /// steps apart.
    std::vector<double> farthest(int samples, int least, int spread) {
        std::vector<double> most(omega_.size());
        for (int i = 0; i < samples; ++i) {
            advance(least + 7 * i % spread);
            for (std::size_t cell = 0; cell < most.size(); ++cell)
                most[cell] = std::max(most[cell], sample(cell));
        }
        return most;
    }
    [[nodiscard]] bool unbounded(std::size_t cell) const { return unbounded_[cell]; }

private:
    static constexpr double start = 0x1p-90;

    /// Marks springs that overflow as unbounded, resets them to zero and repeats the steps.
    void advance(int steps) {
        for (;;) {
            Bodies after = bodies_;
            const auto at =
                after.try_step(method_, {.rate = {1}, .count = steps, .damping = damping_});
            if (!at) {
                bodies_ = std::move(after);
                return;
            }
            unbounded_[at->row] = true;
            bodies_.set_state(at->row, {});
        }
    }

    double sample(std::size_t cell) {
        const double x = std::abs(bodies_.position(cell)[0]);
        const double size = std::max(x, std::abs(bodies_.velocity(cell)[0]) / omega_[cell]);
        if (size > start * 1e6) unbounded_[cell] = true;
        if (size > start * 1e6 || size < start * 1e-8) bodies_.set_state(cell, {});
        return size;
    }

    const Method& method_;
    Damping damping_;
    Bodies bodies_;
    std::vector<double> omega_;
    std::vector<bool> unbounded_;
};

std::vector<bool> bounded(const Method& method, Damping damping,
                          const std::vector<Oscillation>& cells, Precision precision) {
    Springs springs(method, damping, cells, precision);
    // Single steps, until few springs are left that could overflow between two samples.
    springs.farthest(20, 1, 1);
    // Samples 13 to 23 steps apart, so that an oscillation is not sampled at repeating phases.
    const std::vector<double> before = springs.farthest(55, 13, 11);
    const std::vector<double> after = springs.farthest(55, 13, 11);
    std::vector<bool> found(cells.size());
    for (std::size_t i = 0; i < found.size(); ++i)
        found[i] = !springs.unbounded(i) && after[i] <= 1.05 * before[i];
    return found;
}

}  // namespace

StabilityRegion measure_region(const Method& method, Damping damping, const StabilityGrid& grid) {
    const std::vector<Oscillation> cells = oscillations(grid);
    StabilityRegion region{.method = &method,
                           .damping = damping,
                           .spectral_radius = {},
                           .stable = {},
                           .bounded_double = bounded(method, damping, cells, Precision::double_),
                           .bounded_float = bounded(method, damping, cells, Precision::single)};
    for (const StepMatrix& matrix : step_matrices(method, damping, cells)) {
        region.spectral_radius.push_back(static_cast<double>(spectral_radius(matrix)));
        region.stable.push_back(is_stable(matrix));
    }
    return region;
}

std::string to_csv(const std::vector<StabilityRegion>& regions, const StabilityGrid& grid) {
    std::string csv =
        "method,damping,omega_dt,zeta,spectral_radius,stable,bounded_double,bounded_float\n";
    const auto digit = [](bool yes) { return yes ? 1 : 0; };
    for (const StabilityRegion& region : regions)
        for (int row = 0; row < grid.rows; ++row)
            for (int column = 0; column < grid.columns; ++column) {
                const std::size_t i = grid.index(column, row);
                fmt::format_to(std::back_inserter(csv), "{},{},{:.6g},{:.6g},{:.9g},{},{},{}\n",
                               region.method->name, name_of(region.damping),
                               grid.omega_dt_of(column), grid.zeta_of(row),
                               region.spectral_radius[i], digit(region.stable[i]),
                               digit(region.bounded_double[i]), digit(region.bounded_float[i]));
            }
    return csv;
}

}  // namespace oiler::certify
