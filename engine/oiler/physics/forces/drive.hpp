// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numbers>

#include "oiler/math/sine.hpp"
#include "oiler/physics/forces/force.hpp"

namespace oiler {

/// A force that oscillates: F·sin(2π·f·t + φ), t in s since the start of the simulation.
template <Number V, int Axes>
struct DriveForce {
    Vec<V, Axes> amplitude{};  ///< F, N
    V frequency{};             ///< f, Hz
    V phase{};                 ///< φ, rad
    V frequency_rest{};        ///< Hz, added to f: the digits that V has no place for

    static constexpr std::string_view name = "drive";
    static constexpr std::string_view plural = "drives";
    static constexpr bool everywhere = false;
    static constexpr bool depends_on_time = true;
    static constexpr auto fields() {
        return std::tuple(KeyedField{"amplitude", &DriveForce::amplitude},
                          KeyedField{"frequency", &DriveForce::frequency},
                          KeyedField{"phase", &DriveForce::phase});
    }
    static constexpr auto rests() {
        return std::tuple(KeyedField{"frequency rest", &DriveForce::frequency_rest});
    }
    constexpr DriveForce per_unit_mass(V mass) const {
        return {amplitude * (V(1) / mass), frequency, phase, frequency_rest};
    }
    /// Takes all digits of the frequency of a force in another precision.
    template <class From>
    constexpr void take_rests(const From& from) {
        const auto whole = from.frequency + from.frequency_rest;
        frequency = static_cast<V>(whole);
        frequency_rest = static_cast<V>(whole - frequency);
    }

    [[gnu::always_inline]] constexpr Vec<V, Axes> field(const Vec<V, Axes>&, double t) const {
        using T = Scalar<V>;
        const V of_rest = frequency_rest * V(static_cast<T>(t));
        return amplitude * sine_of_turns(turns(frequency, t) + of_rest + phase * V(T(per_radian)));
    }
    [[gnu::always_inline]] constexpr Vec<V, Axes> accelerate(const State<V, Axes>& state,
                                                             double t) const {
        return field(state.x, t);
    }
    constexpr Jacobian<V, Axes> jacobian(const State<V, Axes>&) const { return {}; }
    /// 0: a force that depends on time has no potential.
    constexpr V potential(const State<V, Axes>&) const { return V(0); }
    V fastest(const State<V, Axes>&) const {
        if (!(squared_length(amplitude) > 0)) return 0;
        return 2 * std::numbers::pi_v<V> * std::abs(frequency);
    }

private:
    static constexpr long double per_radian = 0.159154943091895335768883763372514362L;
};

}  // namespace oiler
