// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "oiler/physics/forces/forces.hpp"
#include "oiler/physics/plan.hpp"
#include "oiler/physics/steps.hpp"
#include "oiler/sim/store/column.hpp"

namespace oiler {

/// A set of kinds of force: a bit for each type in ForceList.
using Kinds = std::uint16_t;
static_assert(force_count <= 16);

template <class Force, Number V, int Axes>
inline constexpr std::size_t kind_index =
    index_of<Force>(static_cast<ForceList<V, Axes>*>(nullptr));
template <class Force, Number V, int Axes>
inline constexpr Kinds kind_bit = static_cast<Kinds>(1U << kind_index<Force, V, Axes>);

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

/// The Response of each row over one duration.
template <std::floating_point T>
struct FlowView {
    NumberView<T> reach;
    NumberView<T> sway;
    NumberView<T> decay;
};

/// The rows along one axis.
template <std::floating_point T>
struct AxisRows {
    T* x;
    T* v;
    LinearAxis<T> forces;
    const FlowView<T>* flows;   ///< of the plan's durations
    std::int64_t* evaluations;  ///< of the first row; null if another axis counts them
};

/// The places of the numbers of one force, and of its number of prepare_damping.
template <class T>
struct ForceView {
    std::array<NumberView<T>, most_numbers> numbers;
    NumberView<T> damping_number;
};

/// The places of all numbers that steps of rows read, kept from call to call.
template <std::floating_point T, int Axes>
struct RowViews {
    bool valid = false;  ///< false after a change of forces, plan or memory
    std::array<AxisRows<T>, Axes> axis{};
    std::vector<FlowView<T>> flows{};  ///< of the plan's durations
    /// Per kind, without the linear kinds.
    std::array<std::vector<ForceView<T>>, force_count> others{};

    RowViews() = default;
    ~RowViews() = default;
    /// A copy of columns is in other memory, so its views are not valid.
    RowViews(const RowViews&) : RowViews() {}
    RowViews& operator=(const RowViews&) {
        valid = false;
        return *this;
    }

    /// The parts of linear forces that act along any axis.
    [[nodiscard]] [[gnu::always_inline]] LinearParts parts(Kinds kinds) const {
        LinearParts any;
        for (const AxisRows<T>& one : axis) {
            const LinearParts parts = one.forces.parts(kinds);
            any = {any.constant || parts.constant, any.spring || parts.spring,
                   any.damping || parts.damping};
        }
        return any;
    }
    /// The linear force on row `row`, or on a batch of rows from `row` on.
    template <Number V>
    [[nodiscard]] [[gnu::always_inline]] LinearForce<V, Axes> load_at(
        std::size_t row, const LinearParts& parts) const {
        const auto along = [&](auto load) __attribute__((always_inline)) {
            return Vec<V, Axes>{generate<Axes>(load)};
        };
        const LinearAxis<T>& first = axis[0].forces;
        return {along([&](auto i) { return axis[i].forces.template constant_at<V>(row); }),
                along([&](auto i) {
                    return parts.spring ? axis[i].forces.centre.template at<V>(row) : V(T(0));
                }),
                parts.spring ? first.stiffness.template at<V>(row) : V(T(0)),
                parts.damping ? first.damping.template at<V>(row) : V(T(0))};
    }
};

template <std::floating_point T, int Axes>
struct Columns;

/// A function that steps the rows from `begin`, the start of a block, to `end` along one axis, in
/// batches. Returns `end`, or the first row of a batch that it did not store because a number in it
/// may no longer be finite.
template <std::floating_point T>
using StepAxis = std::size_t (*)(const AxisRows<T>&, const Plan<T>&, const Steps&,
                                 std::size_t begin, std::size_t end);
/// Like StepAxis, but along all axes, for rows with forces of these kinds.
template <std::floating_point T, int Axes>
using StepAllAxes = std::size_t (*)(Columns<T, Axes>&, Kinds, const Steps&, std::size_t begin,
                                    std::size_t end);

/// The functions for one kind of plan; null where rows are stepped one at a time.
template <std::floating_point T, int Axes>
struct RowKernels {
    /// A function for each combination of parts that act, for calls of any steps, then for one step
    /// after which no body is put to sleep.
    const std::array<StepAxis<T>, 16>* axis = nullptr;
    StepAllAxes<T, Axes> all_axes = nullptr;

    [[nodiscard]] StepAxis<T> along_axis(const LinearParts& parts, bool one_step) const {
        return axis ? (*axis)[std::size_t{parts.constant} + 2 * std::size_t{parts.spring} +
                              4 * std::size_t{parts.damping} + 8 * std::size_t{one_step}]
                    : nullptr;
    }
};

}  // namespace oiler
