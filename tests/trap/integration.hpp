// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "trap/truth.hpp"

namespace oiler::trap {

/// Collocation at the nodes −cos(i·π/degree) of [−1, 1].
struct Chebyshev {
    static constexpr std::size_t degree = 20;
    static constexpr std::size_t nodes = degree + 1;
    /// The integrals of values at the nodes have one coefficient more, twice integrated two more.
    static constexpr std::size_t coefficients = nodes + 2;
    using Row = std::array<Real, nodes>;

    Row at{};                                  ///< the nodes
    std::array<Row, nodes> once{};             ///< from −1 to each node
    std::array<Row, nodes> twice{};            ///< integrated twice
    std::array<Row, nodes> transform{};        ///< coefficients of the values
    std::array<Row, coefficients> position{};  ///< coefficients of the double integral

    Chebyshev();
    [[nodiscard]] static const Chebyshev& get();
    /// The sum of the series at `x` in [−1, 1], by Clenshaw's recurrence.
    [[nodiscard]] static Real sum(const Real* series, Real x);
};

/// The motion in a segment: node by node, three coordinates per body.
struct Integration::Nodes {
    explicit Nodes(std::size_t coordinates)
        : width(coordinates), x(Chebyshev::nodes * width), v(x), a(x) {}
    std::size_t width;
    Numbers x, v, a;
};

}  // namespace oiler::trap
