// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <tuple>
#include <vector>

#include "oiler/physics/contacts/plane.hpp"
#include "oiler/sim/store/column.hpp"

namespace oiler {

/// An impact of the body in a row.
template <std::floating_point T, int Axes>
struct RowImpact {
    std::int64_t tick;  ///< at the start of the step
    std::size_t row;
    std::size_t index;  ///< among the impacts of the row in the step
    ImpactOf<T, Axes> impact;

    [[nodiscard]] friend bool operator<(const RowImpact& a, const RowImpact& b) {
        return std::tie(a.tick, a.impact.after_start, a.row, a.index) <
               std::tie(b.tick, b.impact.after_start, b.row, b.index);
    }
};

/// The planes of a world and the rows that meet them.
template <std::floating_point T, int Axes>
struct Contacts {
    static constexpr T no_contact = -std::numeric_limits<T>::infinity();

    std::vector<PlaneOf<T, Axes>> planes;
    Parameter<T> radius;                ///< m; no_contact for rows that pass through planes
    std::size_t rows = 0;               ///< the number of rows with a contact
    std::vector<std::uint8_t> settled;  ///< per row, see Landed; rows at the end may be missing
    std::vector<RowImpact<T, Axes>> impacts;                        ///< of the last call, in order
    std::vector<std::vector<RowImpact<T, Axes>>> impacts_of_parts;  ///< memory of a step

    /// Whether any body may meet a plane.
    [[nodiscard]] bool possible() const { return rows > 0 && !planes.empty(); }

    [[nodiscard]] static T radius_of(const std::optional<Contact>& contact) {
        return contact ? static_cast<T>(contact->radius) : no_contact;
    }
    void push_row(T of) {
        radius.push(of);
        rows += of != no_contact;
    }
    void set(std::size_t row, T to) {
        rows -= radius[row] != no_contact;
        rows += to != no_contact;
        radius.set(row, to);
        wake(row);
    }
    /// Removes `row`, to whose place row `last` moves.
    void swap_remove(std::size_t row, std::size_t last) {
        rows -= radius[row] != no_contact;
        radius.swap_remove(row);
        if (row < settled.size()) settled[row] = last < settled.size() ? settled[last] : 0;
        settled.resize(std::min(settled.size(), last));
    }
    void wake(std::size_t row) {
        if (row < settled.size()) settled[row] = 0;
    }
    void wake_all() { settled.clear(); }

    /// Gathers the impacts of all parts of a call.
    void gather_impacts() {
        for (auto& of_part : impacts_of_parts) {
            impacts.insert(impacts.end(), of_part.begin(), of_part.end());
            of_part.clear();
        }
        std::sort(impacts.begin(), impacts.end());
    }
};

}  // namespace oiler
