// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>

#include "oiler/scene/scene.hpp"
#include "trap/system.hpp"

namespace oiler::trap {

/// The true motion of a scene: closed forms where they exist, otherwise an integration.
class Truth {
public:
    enum class From {
        best,         ///< closed forms where they exist
        matrix,       ///< the exponential of a matrix for all linear forces
        integration,  ///< an integration for all forces
    };
    /// Throws std::domain_error if the motion is too long or too unsteady to be computed.
    explicit Truth(const Scene& scene, From from = From::best, std::size_t most_segments = 20'000);

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] Real shortest_period() const;
    /// The cost of one sample of all bodies.
    [[nodiscard]] Real cost() const;
    /// The error of the integrations, m.
    [[nodiscard]] Real uncertainty() const;
    /// As for Motion; the samples are those of the rows of the world.
    void prepare(std::int64_t rate, std::size_t inside);
    [[nodiscard]] const std::vector<Point>& sample(std::int64_t n);
    /// The largest distance of a body from its start, m.
    [[nodiscard]] Real extent(Real duration);

private:
    struct Part {
        std::unique_ptr<Motion> motion;
        std::vector<std::size_t> rows;
    };
    void add(const System& system, const std::vector<std::size_t>& rows, Real duration, From from);
    void add_integration(const System& system, const std::vector<std::size_t>& rows, Real duration);

    std::size_t size_ = 0;
    std::size_t most_segments_;  ///< of an integration
    std::vector<Part> parts_;
    std::vector<Point> buffer_;
    std::vector<Point> samples_;
    std::size_t inside_ = 0;
};

/// Compares the true motions with one another on random scenes, and with reference numbers of
/// tests/data. Prints the largest differences; returns whether all are small.
[[nodiscard]] bool self_check(std::uint64_t seed);

}  // namespace oiler::trap
