// SPDX-License-Identifier: MIT
#include "oiler/sim/linear_columns.hpp"

namespace oiler {
namespace {

/// The index of a field's first number among the numbers of its force.
template <class Force, class Field>
constexpr std::size_t offset_of(Field field) {
    std::size_t offset = 0;
    bool found = false;
    const auto visit = [&]<class Other>(Other other) {
        if constexpr (std::is_same_v<Field, Other>) found = found || other == field;
        if (found) return;
        Force force{};
        if constexpr (requires { (force.*other).axis; })
            offset += (force.*other).axis.size();
        else
            ++offset;
    };
    std::apply([&](auto... other) { (visit(other), ...); }, Force::fields());
    return offset;
}

template <class T>
bool is_zero(const Parameter<T>& number) {
    return number.shared() && number[0] == 0;
}

/// Collects which columns hold the numbers of the linear forces.
template <class T, int Axes>
class Collector {
public:
    explicit Collector(const Columns<T, Axes>& columns) {
        for_each_index<force_count>([&](auto kind) {
            using Force = std::tuple_element_t<kind, ForceList<T, Axes>>;
            if constexpr (Linear<Force>)
                for (const auto& numbers : std::get<kind>(columns.forces))
                    add<Force>(numbers, kind_bit<Force, T, Axes>);
        });
    }

    [[nodiscard]] const LinearColumns<T, Axes>& columns() const { return columns_; }
    /// Whether a number is the sum of several columns.
    [[nodiscard]] bool needs_sums() const { return needs_sums_; }

private:
    template <class Force, class Numbers>
    void add(const Numbers& numbers, Kinds kind) {
        constexpr auto fields = Force::linear_fields();
        using Parts = typename decltype(fields)::Parts;
        for (std::size_t i = 0; i < Axes; ++i) {
            if constexpr (Parts::constant)
                add(numbers[offset_of<Force>(fields.constant) + i], columns_.axis[i].constant);
            if constexpr (Parts::spring) {
                const bool acts =
                    add(numbers[offset_of<Force>(fields.stiffness)], columns_.axis[i].stiffness);
                if (acts)
                    columns_.axis[i].centre =
                        NumberView<T>(numbers[offset_of<Force>(fields.centre) + i]);
                columns_.axis[i].spring_kinds |= kind;
            }
            if constexpr (Parts::damping) {
                add(numbers[offset_of<Force>(fields.damping)], columns_.axis[i].damping);
                columns_.axis[i].damping_kinds |= kind;
            }
        }
    }
    bool add(const Parameter<T>& number, NumberView<T>& to) {
        if (is_zero(number)) return false;
        needs_sums_ = needs_sums_ || to;
        to = NumberView<T>(number);
        return true;
    }

    LinearColumns<T, Axes> columns_;
    bool needs_sums_ = false;
};

template <class T>
NumberView<T> view_of(const Parameter<T>& number) {
    return is_zero(number) ? NumberView<T>() : NumberView<T>(number);
}

/// Sums are rounded to T once.
template <class T>
using SumOf = std::conditional_t<std::is_same_v<T, float>, double, T>;

template <class T, int Axes>
void fill(LinearSums<T, Axes>& sums, const Columns<T, Axes>& columns) {
    using Sum = SumOf<T>;
    sums = {};
    for (std::size_t row = 0; row < columns.size; ++row) {
        LinearForce<Sum, Axes> sum;
        for_each_force<Sum>(columns, row, [&]<class Force>(const Force& force) {
            if constexpr (Linear<Force>) sum = sum + linear_form(force);
        });
        for (std::size_t i = 0; i < Axes; ++i) {
            sums.constant[i].push(static_cast<T>(sum.constant.axis[i]));
            sums.centre[i].push(static_cast<T>(sum.centre.axis[i]));
        }
        sums.stiffness.push(static_cast<T>(sum.stiffness));
        sums.damping.push(static_cast<T>(sum.damping));
    }
    sums.valid = true;
}

}  // namespace

template <std::floating_point T, int Axes>
LinearColumns<T, Axes> linear_columns(Columns<T, Axes>& columns) {
    const Collector<T, Axes> collected(columns);
    LinearColumns<T, Axes> linear = collected.columns();
    LinearSums<T, Axes>& sums = columns.linear_sums;
    if (collected.needs_sums() && !sums.valid) fill(sums, columns);
    for (std::size_t i = 0; i < Axes; ++i) {
        LinearAxis<T>& axis = linear.axis[i];
        if (collected.needs_sums()) {
            axis.constant = view_of(sums.constant[i]);
            axis.centre = NumberView<T>(sums.centre[i]);
            axis.stiffness = view_of(sums.stiffness);
            axis.damping = view_of(sums.damping);
        }
        if (!columns.applied.empty()) axis.applied = NumberView<T>(columns.applied.acceleration[i]);
    }
    return linear;
}

template LinearColumns<float, 1> linear_columns(Columns<float, 1>&);
template LinearColumns<float, 2> linear_columns(Columns<float, 2>&);
template LinearColumns<float, 3> linear_columns(Columns<float, 3>&);
template LinearColumns<double, 1> linear_columns(Columns<double, 1>&);
template LinearColumns<double, 2> linear_columns(Columns<double, 2>&);
template LinearColumns<double, 3> linear_columns(Columns<double, 3>&);
template LinearColumns<long double, 1> linear_columns(Columns<long double, 1>&);
template LinearColumns<long double, 2> linear_columns(Columns<long double, 2>&);
template LinearColumns<long double, 3> linear_columns(Columns<long double, 3>&);

}  // namespace oiler
