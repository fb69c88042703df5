// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace oiler::bench {

/// The data of a hand-written loop: columns for `axes` axes of `rows` rows, and shared numbers.
template <class T>
struct HandScene {
    std::size_t rows = 0;
    int axes = 0;
    T dt{};
    T gravity[3]{};
    T anchor[3]{};
    T stiffness{};
    T damping{};
    T* x[3]{};
    T* v[3]{};
};

/// The least time that this machine can take for the engine's work: hand-written loops for one
/// force and semi-implicit Euler, with literal formulas. `rows` is a multiple of row_multiple.
template <class T>
struct HandLoops {
    static constexpr std::size_t row_multiple = 128;

    /// Reads and writes each column once, the minimum of a step.
    void (*sweep)(const HandScene<T>& scene, T factor);
    void (*fall)(const HandScene<T>& scene);
    void (*spring)(const HandScene<T>& scene);
    /// Many steps per call, with rows that stay in registers.
    void (*fall_many)(const HandScene<T>& scene, int steps);
    void (*spring_many)(const HandScene<T>& scene, int steps);
    /// The sum of `count` numbers, a multiple of row_multiple.
    T (*read)(const T* numbers, std::size_t count);
};

/// The loops compiled for an instruction set.
struct Limits {
    std::string_view isa;
    const HandLoops<float>* in_float;
    const HandLoops<double>* in_double;

    template <class T>
    [[nodiscard]] const HandLoops<T>& loops() const {
        if constexpr (sizeof(T) == sizeof(float))
            return *in_float;
        else
            return *in_double;
    }
};

/// The sets that this processor supports, the widest last.
[[nodiscard]] std::vector<Limits> supported_limits();

}  // namespace oiler::bench
