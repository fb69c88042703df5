// SPDX-License-Identifier: MIT
#include "oiler/sim/kernels.hpp"

#include <array>
#include <cstdlib>
#include <string>
#include <string_view>

#include "oiler/core/error.hpp"

namespace oiler {
namespace baseline {
template <class T, int Axes>
const Kernels<T, Axes>& kernels();
}
namespace avx2 {
template <class T, int Axes>
const Kernels<T, Axes>& kernels();
}
namespace avx512 {
template <class T, int Axes>
const Kernels<T, Axes>& kernels();
}

namespace {

/// The kernels as compiled for one set of instructions.
struct InstructionSet {
    std::string_view name;
    bool (*runs_here)();
};

/// From the plainest, which every machine runs, to the widest.
#ifdef OILER_X86
constexpr std::array sets{
    InstructionSet{"baseline", [] { return true; }},
    InstructionSet{"avx2", [] { return bool(__builtin_cpu_supports("avx2")); }},
    InstructionSet{"avx512",
                   [] {
                       return __builtin_cpu_supports("avx512f") &&
                              __builtin_cpu_supports("avx512bw") &&
                              __builtin_cpu_supports("avx512dq") &&
                              __builtin_cpu_supports("avx512vl");
                   }},
};
template <class T, int Axes>
const Kernels<T, Axes>& kernels_of(std::size_t set) {
    if (set == 2) return avx512::kernels<T, Axes>();
    if (set == 1) return avx2::kernels<T, Axes>();
    return baseline::kernels<T, Axes>();
}
#else
constexpr std::array sets{InstructionSet{"baseline", [] { return true; }}};
template <class T, int Axes>
const Kernels<T, Axes>& kernels_of(std::size_t) {
    return baseline::kernels<T, Axes>();
}
#endif

constexpr const char* variable = "OILER_INSTRUCTIONS";

std::size_t widest_set() {
    std::size_t set = sets.size();
    while (!sets[--set].runs_here()) {
    }
    return set;
}

std::size_t chosen_set() {
    const char* const wanted = std::getenv(variable);
    if (wanted == nullptr) return widest_set();
    std::string names;
    for (std::size_t set = 0; set < sets.size(); ++set) {
        if (!sets[set].runs_here()) continue;
        if (sets[set].name == wanted) return set;
        names += fmt::format("{}{}", names.empty() ? "" : ", ", sets[set].name);
    }
    fail(Exit::usage, "{}={}: this machine runs {}", variable, wanted, names);
}

}  // namespace

template <std::floating_point T, int Axes>
const Kernels<T, Axes>& kernels() {
    static const Kernels<T, Axes>& chosen = kernels_of<T, Axes>(chosen_set());
    return chosen;
}

template const Kernels<float, 1>& kernels();
template const Kernels<float, 2>& kernels();
template const Kernels<float, 3>& kernels();
template const Kernels<double, 1>& kernels();
template const Kernels<double, 2>& kernels();
template const Kernels<double, 3>& kernels();

}  // namespace oiler
