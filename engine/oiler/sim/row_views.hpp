// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/sim/linear_columns.hpp"

namespace oiler {

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
    /// The flows of the columns must be those of the plan, see prepare_flows.
    RowViews(Columns<T, Axes>& columns, const LinearColumns<T, Axes>& linear)
        : linear_(linear), others_(columns.views) {
        for (std::size_t i = 0; i < columns.flows.of.size(); ++i) {
            const FlowColumns<T>& flow = columns.flows.of[i];
            flows_[i] = {NumberView<T>(flow.reach), NumberView<T>(flow.sway),
                         NumberView<T>(flow.decay)};
        }
        for_each_index<force_count>([&](auto kind) {
            using Force = std::tuple_element_t<kind, ForceList<T, Axes>>;
            if constexpr (!Linear<Force>)
                view_others(std::get<kind>(columns.forces), columns.flows.damping_numbers[kind],
                            std::get<kind>(columns.views));
        });
    }

    [[nodiscard]] const LinearColumns<T, Axes>& linear() const { return linear_; }
    /// The flows of the plan's durations.
    [[nodiscard]] const FlowView<T>* flows() const { return flows_.data(); }
    /// The forces of one kind.
    template <std::size_t kind>
    [[nodiscard]] [[gnu::always_inline]] const auto& others() const {
        return std::get<kind>(others_);
    }

private:
    template <class Stored, class Views>
    static void view_others(const Stored& stored, const std::vector<Parameter<T>>& damping_numbers,
                            Views& views) {
        views.resize(stored.size());
        for (std::size_t index = 0; index < stored.size(); ++index) {
            for (std::size_t i = 0; i < stored[index].size(); ++i)
                views[index].numbers[i] = NumberView<T>(stored[index][i]);
            if (index < damping_numbers.size())
                views[index].damping_number = NumberView<T>(damping_numbers[index]);
        }
    }

    LinearColumns<T, Axes> linear_;
    std::array<FlowView<T>, Splitting::most_stages> flows_;
    const typename ForceViewsOf<ForceList<T, Axes>, T>::type& others_;
};

}  // namespace oiler
