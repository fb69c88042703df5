// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <tuple>

#include "oiler/math/matrix.hpp"
#include "oiler/physics/state.hpp"

namespace oiler {

/// A number or a vector of a force, with its key in scene files.
template <class Member>
struct KeyedField {
    std::string_view key;
    Member member;
};
template <class Member>
KeyedField(const char*, Member) -> KeyedField<Member>;

/// The derivatives of an acceleration by position (1/s²) and velocity (1/s).
template <Number V, int Axes>
struct Jacobian {
    Matrix<V, Axes> dx{};
    Matrix<V, Axes> dv{};
};

/// The length and the unit vector of `d`. Both are 0 if |d|² underflows to 0: below 10⁻²³ m in
/// float and 10⁻¹⁶² m in double.
template <Number V, int Axes>
struct Direction {
    V length;
    V inverse_length;  ///< 0 for length 0
    Vec<V, Axes> unit;

    [[gnu::always_inline]] explicit constexpr Direction(const Vec<V, Axes>& d) {
        using std::sqrt;
        length = sqrt(squared_length(d));
        inverse_length = quotient_or_zero(V(1), length);
        unit = d * inverse_length;
    }
};

/// Quadratic drag −c·|u|·u per unit mass, u = v − w, through air of velocity w.
template <Number V, int Axes>
struct AirDrag {
    V coefficient{};          ///< c, 1/m
    Vec<V, Axes> velocity{};  ///< w, m/s
};

}  // namespace oiler
