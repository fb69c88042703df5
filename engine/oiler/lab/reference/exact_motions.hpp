// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/lab/reference/exact_motion.hpp"

namespace oiler::lab {

/// The closed forms of a scene. Bodies with equal stiffness and damping share the factors of a
/// time.
class ExactMotions : public Motion {
public:
    explicit ExactMotions(std::vector<ExactMotion> motions);

    [[nodiscard]] std::size_t bodies() const override { return motions_.size(); }
    [[nodiscard]] State<long double, 3> at(std::size_t row, long double t) const override {
        return motions_[row](t);
    }
    void all_at(long double t, std::span<State<long double, 3>> states) const override;
    [[nodiscard]] Walk walk(std::int64_t rate) const override;
    [[nodiscard]] double bend(std::size_t row, const State<long double, 3>& first,
                              const State<long double, 3>& last, long double from,
                              long double to) const override {
        return motions_[row].bend(first, last, from, to);
    }
    [[nodiscard]] double bend_of_any(std::size_t row, long double h) const override {
        const auto length = static_cast<double>(h);
        return length * length * length * length * steady_bends_[row];
    }
    [[nodiscard]] Ball enclosure(std::size_t row,
                                 const State<long double, 3>& state) const override {
        return motions_[row].enclosure(state);
    }

private:
    class Blocks;
    static constexpr std::size_t alone = static_cast<std::size_t>(-1);

    std::vector<ExactMotion> motions_;
    std::vector<double> steady_bends_;  ///< see ExactMotion::steady_bend
    /// The first body of each group with equal k and c, and the group of each body.
    std::vector<std::size_t> first_of_group_;
    std::vector<std::size_t> group_;
};

}  // namespace oiler::lab
