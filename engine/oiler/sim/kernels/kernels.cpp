// SPDX-License-Identifier: MIT
#include "oiler/sim/kernels/kernels.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <string_view>
#include <type_traits>

#include "oiler/core/error.hpp"
#include "oiler/sim/kernels/instructions.hpp"

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

/// An instruction set, and whether this build has kernels for it.
struct InstructionSet {
    std::string_view name;
    bool built;
    bool (*runs_here)();
};

#ifdef OILER_KERNELS_BASELINE
constexpr bool baseline_built = true;
#else
constexpr bool baseline_built = false;
#endif
#ifdef OILER_KERNELS_AVX2
constexpr bool avx2_built = true;
#else
constexpr bool avx2_built = false;
#endif
#ifdef OILER_KERNELS_AVX512
constexpr bool avx512_built = true;
#else
constexpr bool avx512_built = false;
#endif

/// From the baseline, which every machine runs, to the widest.
constexpr std::array sets{
    InstructionSet{"baseline", baseline_built, [] { return true; }},
#ifdef __x86_64__
    InstructionSet{"avx2", avx2_built, [] { return bool(__builtin_cpu_supports("avx2")); }},
    InstructionSet{"avx512", avx512_built,
                   [] {
                       return __builtin_cpu_supports("avx512f") &&
                              __builtin_cpu_supports("avx512bw") &&
                              __builtin_cpu_supports("avx512dq") &&
                              __builtin_cpu_supports("avx512vl");
                   }},
#endif
};

template <class T, int Axes>
const Kernels<T, Axes>* kernels_of([[maybe_unused]] std::string_view set) {
    constexpr bool fits = !std::is_same_v<T, long double>;
    if constexpr (fits && avx512_built)
        if (set == "avx512") return &avx512::kernels<T, Axes>();
    if constexpr (fits && avx2_built)
        if (set == "avx2") return &avx2::kernels<T, Axes>();
    if constexpr (fits && baseline_built)
        if (set == "baseline") return &baseline::kernels<T, Axes>();
    return nullptr;
}

constexpr const char* variable = "OILER_INSTRUCTIONS";

/// Null if no kernels of this build run here.
const InstructionSet* widest_set() {
    const auto found = std::find_if(sets.rbegin(), sets.rend(), [](const InstructionSet& set) {
        return set.built && set.runs_here();
    });
    return found == sets.rend() ? nullptr : &*found;
}

std::string_view chosen_set() {
    const char* const wanted = std::getenv(variable);
    if (wanted == nullptr) {
        const InstructionSet* const widest = widest_set();
        return widest ? widest->name : sets[0].name;
    }
    std::string names;
    for (const InstructionSet& set : sets) {
        if (!set.runs_here() || (!set.built && &set != &sets[0])) continue;
        if (set.name == wanted) return set.name;
        names += fmt::format("{}{}", names.empty() ? "" : ", ", set.name);
    }
    fail(Exit::usage, "{}={}: expected one of {}, which this build and machine have", variable,
         wanted, names);
}

}  // namespace

std::optional<std::string> missing_instructions() {
    if (widest_set() != nullptr || std::getenv(variable) != nullptr) return std::nullopt;
    std::string names;
    for (const InstructionSet& set : sets)
        if (set.built) names += fmt::format("{}{}", names.empty() ? "" : ", ", set.name);
    if (names.empty()) return std::nullopt;
    return fmt::format(
        "built for processors with {}, which this one lacks: bodies are stepped one at a time, "
        "slowly; build with -DOILER_KERNELS=all",
        names);
}

template <std::floating_point T, int Axes>
const Kernels<T, Axes>* kernels() {
    static const Kernels<T, Axes>* const chosen = kernels_of<T, Axes>(chosen_set());
    return chosen;
}

template const Kernels<float, 1>* kernels();
template const Kernels<float, 2>* kernels();
template const Kernels<float, 3>* kernels();
template const Kernels<double, 1>* kernels();
template const Kernels<double, 2>* kernels();
template const Kernels<double, 3>* kernels();
template const Kernels<long double, 1>* kernels();
template const Kernels<long double, 2>* kernels();
template const Kernels<long double, 3>* kernels();

}  // namespace oiler
