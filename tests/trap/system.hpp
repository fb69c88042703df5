// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace oiler::trap {

using Real = long double;
using Point = std::array<Real, 3>;

/// Where the first sample inside a step lies, as a share of the distance between samples. It is
/// irrational, so that no oscillation meets all samples at the same phase.
inline constexpr Real first_sample = 0.618033988749894848204586834L;

/// Where sample `j` of a step with `inside` samples lies, as a share of the step; 0 is its start.
inline Real share_of(std::size_t j, std::size_t inside) {
    return j == 0 ? 0 : (static_cast<Real>(j - 1) + first_sample) / static_cast<Real>(inside);
}

/// The true motion of some bodies, computed without the engine.
class Motion {
public:
    Motion() = default;
    Motion(const Motion&) = delete;
    Motion& operator=(const Motion&) = delete;
    virtual ~Motion() = default;

    [[nodiscard]] virtual std::size_t size() const = 0;
    /// The shortest time in which the motion turns, s: a period, or that at the perihelion.
    [[nodiscard]] virtual Real shortest_period() const = 0;
    /// The cost of one sample of one body; 1 for a sum of three products.
    [[nodiscard]] virtual Real cost() const = 0;
    /// The largest error of a position, m, as far as it is measured.
    [[nodiscard]] virtual Real uncertainty() const { return 0; }
    /// Calls to `sample` take `inside` samples in steps of 1/rate s.
    virtual void prepare(std::int64_t rate, std::size_t inside) = 0;
    /// Writes the positions at (n + share_of(j, inside)) / rate, for j from 0 to `inside`: sample j
    /// of body i is out[i · (inside + 1) + j]. `n` must not decrease from call to call.
    virtual void sample(std::int64_t n, Point* out) = 0;
};

struct CoupledBody {
    Real mass = 1;            ///< kg
    Real drag = 0;            ///< N·s/m
    Real quadratic_drag = 0;  ///< N·s²/m²
    Point x{};                ///< m, at the start
    Point v{};                ///< m/s, at the start
};

struct CoupledSpring {
    std::size_t body = 0;
    std::optional<std::size_t> to{};  ///< if absent, `anchor` holds
    Point anchor{};                   ///< m
    Real stiffness = 0;               ///< N/m
    Real damping = 0;                 ///< N·s/m
    Real rest_length = 0;             ///< m
};

struct Attractor {
    Point centre{};  ///< m
    Real gm = 0;     ///< m³/s²
};

/// Bodies with the forces on them and between them.
struct System {
    std::vector<CoupledBody> bodies{};
    std::vector<CoupledSpring> springs{};
    std::vector<Attractor> attractors{};
    Point gravity{};  ///< m/s²

    [[nodiscard]] bool is_linear() const;
    /// At most the shortest period of the springs without damping, s.
    [[nodiscard]] Real shortest_spring_period() const;
};

}  // namespace oiler::trap
