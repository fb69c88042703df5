// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/physics/plan.hpp"
#include "oiler/sim/store/columns.hpp"

namespace oiler {

/// The numbers of the linear forces on all rows along one axis.
template <std::floating_point T>
struct LinearAxis {
    NumberView<T> constant{};   ///< m/s²
    NumberView<T> centre{};     ///< m
    NumberView<T> stiffness{};  ///< 1/s²
    NumberView<T> damping{};    ///< 1/s
    NumberView<T> applied{};    ///< m/s², added to the constant
    Kinds spring_kinds = 0;     ///< the kinds that have a stiffness
    Kinds damping_kinds = 0;

    /// The parts that act on rows with these kinds of force.
    [[nodiscard]] [[gnu::always_inline]] LinearParts parts(Kinds kinds) const {
        return {constant || applied, stiffness && (kinds & spring_kinds) != 0,
                damping && (kinds & damping_kinds) != 0};
    }
    /// The force on row `row`, or on a batch of rows from `row` on.
    template <Number V, class Parts>
    [[nodiscard]] [[gnu::always_inline]] LinearForce<V, 1> load_at(std::size_t row,
                                                                   const Parts& parts) const {
        return {{parts.constant ? constant_at<V>(row) : V(T(0))},
                {parts.spring ? centre.template at<V>(row) : V(T(0))},
                parts.spring ? stiffness.template at<V>(row) : V(T(0)),
                parts.damping ? damping.template at<V>(row) : V(T(0))};
    }
    /// The constant of that row, or of a batch, m/s²; 0 if there is none.
    template <Number V>
    [[nodiscard]] [[gnu::always_inline]] V constant_at(std::size_t row) const {
        if (!applied) return constant ? constant.template at<V>(row) : V(T(0));
        const V pushed = applied.template at<V>(row);
        return constant ? V(constant.template at<V>(row) + pushed) : pushed;
    }
};

/// The numbers of the linear forces on all rows, valid until the columns change.
template <std::floating_point T, int Axes>
struct LinearColumns {
    std::array<LinearAxis<T>, Axes> axis;

    /// The parts that act along any axis.
    [[nodiscard]] [[gnu::always_inline]] LinearParts parts(Kinds kinds) const {
        LinearParts any;
        for (const LinearAxis<T>& one : axis) {
            const LinearParts parts = one.parts(kinds);
            any = {any.constant || parts.constant, any.spring || parts.spring,
                   any.damping || parts.damping};
        }
        return any;
    }
    /// The force on row `row`, or on a batch of rows from `row` on.
    template <Number V>
    [[nodiscard]] [[gnu::always_inline]] LinearForce<V, Axes> load_at(
        std::size_t row, const LinearParts& parts) const {
        const auto along = [&](auto load) __attribute__((always_inline)) {
            return Vec<V, Axes>{generate<Axes>(load)};
        };
        return {along([&](auto i) { return axis[i].template constant_at<V>(row); }),
                along([&](auto i) {
                    return parts.spring ? axis[i].centre.template at<V>(row) : V(T(0));
                }),
                parts.spring ? axis[0].stiffness.template at<V>(row) : V(T(0)),
                parts.damping ? axis[0].damping.template at<V>(row) : V(T(0))};
    }
};

/// The Response of each row over one duration.
template <std::floating_point T>
struct FlowView {
    NumberView<T> reach;
    NumberView<T> sway;
    NumberView<T> decay;
};

/// Where all numbers are that steps of rows read, valid until the columns change.
template <std::floating_point T, int Axes>
class RowViews {
public:
    /// Fills the caches of the columns, unless they are valid: the sums of linear forces that share
    /// a number, such as those of two springs, and the exact flows of the plan. Throws Error{usage}
    /// if a flow overflows, see require_flows.
    RowViews(Columns<T, Axes>& columns, const Plan<T>& plan);

    [[nodiscard]] const LinearColumns<T, Axes>& linear() const { return linear_; }
    /// The flows of the plan's durations.
    [[nodiscard]] const FlowView<T>* flows() const { return flows_.data(); }
    /// The forces of one kind.
    template <std::size_t kind>
    [[nodiscard]] [[gnu::always_inline]] const auto& others() const {
        return std::get<kind>(others_);
    }

private:
    LinearColumns<T, Axes> linear_;
    std::array<FlowView<T>, Splitting::most_stages> flows_;
    const typename ForceViewsOf<ForceList<T, Axes>, T>::type& others_;
};

/// Throws Error{usage} if an exact flow of the plan overflows, which may happen in a negative
/// drift, because it runs damping backwards. It computes only those that may, and keeps none.
template <std::floating_point T, int Axes>
void require_flows(const Columns<T, Axes>& columns, const Plan<T>& plan);

}  // namespace oiler
