// SPDX-License-Identifier: MIT
// The kernels for one instruction set and one precision, OILER_INSTRUCTIONS and OILER_PRECISION.
// This file is compiled once for each pair. Every function here is a template over the registers of
// its set, or always inlined, so that no two sets share a function.
#include "oiler/math/batch.hpp"
#include "oiler/sim/kernels.hpp"
#include "oiler/sim/link_rows.hpp"
#include "oiler/sim/take_steps.hpp"

namespace oiler::OILER_INSTRUCTIONS {
namespace {

#if defined(__AVX512F__)
constexpr std::size_t register_bytes = 64;
#elif defined(__AVX__)
constexpr std::size_t register_bytes = 32;
#else
constexpr std::size_t register_bytes = 16;
#endif
template <class T>
using Register = Pack<T, register_bytes>;

/// The largest number of registers per batch that leaves registers free for intermediate results,
/// and that row_padding allows. Splittings hold one state; Runge–Kutta methods hold several.
template <class T, int Axes>
constexpr std::size_t most_packs() {
    constexpr std::size_t room = register_bytes == 64 ? 24 : 12;
    std::size_t packs = 1;
    while (2 * Axes * packs * 2 <= room && 2 * packs * Register<T>::lanes <= row_padding)
        packs *= 2;
    return packs;
}
template <class T, int Axes>
using Wide = Batch<Register<T>, most_packs<T, Axes>()>;
template <class T, int Axes>
using Narrow = Batch<Register<T>, (most_packs<T, Axes>() + 1) / 2>;

/// A Source of Forces with one force of each kind in `Kinds` (bits, in the order of ForceList) and
/// the same numbers for all rows. Compilers keep these numbers in registers.
template <Number V, int Axes, unsigned Kinds>
class SharedForces {
public:
    using T = Scalar<V>;

    [[gnu::always_inline]] SharedForces(const Columns<T, Axes>& columns, std::size_t) {
        for_each_index<force_count>([&](auto i) __attribute__((always_inline)) {
            std::size_t next = 0;
            if constexpr ((Kinds >> i & 1U) != 0)
                for_each_number(
                    std::get<i>(list_), [&](T & number) __attribute__((always_inline)) {
                        number = *std::get<i>(columns.forces)[0][next++].data(0);
                    });
        });
    }

    [[nodiscard]] static bool fits(const Columns<T, Axes>& columns) {
        bool all = true;
        for_each_index<force_count>([&](auto i) __attribute__((always_inline)) {
            const auto& stored = std::get<i>(columns.forces);
            all = all && stored.size() == (Kinds >> i & 1U);
            if (stored.size() == 1)
                for (const Parameter<T>& number : stored[0]) all = all && number.shared();
        });
        return all;
    }

    template <class Force>
    [[gnu::always_inline]] static constexpr std::size_t count() {
        return Kinds >> at<Force> & 1U;
    }
    template <class Force>
    [[gnu::always_inline]] Force get(std::size_t) const {
        constexpr auto to = Force::fields();
        constexpr auto from = std::tuple_element_t<at<Force>, ForceList<T, Axes>>::fields();
        const auto& numbers = std::get<at<Force>>(list_);
        Force force;
        for_each_index<std::tuple_size_v<decltype(to)>>([&](auto i) __attribute__((always_inline)) {
            broadcast(numbers.*std::get<i>(from), force.*std::get<i>(to));
        });
        return force;
    }

private:
    template <class Force>
    static constexpr std::size_t at = index_of<Force>(static_cast<ForceList<V, Axes>*>(nullptr));

    [[gnu::always_inline]] static void broadcast(T from, V& to) { to = V(from); }
    [[gnu::always_inline]] static void broadcast(const Vec<T, Axes>& from, Vec<V, Axes>& to) {
        to = {generate<Axes>([&](auto i) { return V(from.axis[i]); })};
    }

    ForceList<T, Axes> list_;
};

template <class V, int Axes>
[[gnu::always_inline]] inline bool may_be_infinite(const State<V, Axes>& state) {
    V total = state.x.axis[0] + state.v.axis[0];
    for_each_index<Axes - 1>([&](auto i) __attribute__((always_inline)) {
        total = total + (state.x.axis[i + 1] + state.v.axis[i + 1]);
    });
    return !is_finite(total);
}

template <class V, class Source, class T, int Axes, class Rule>
[[gnu::always_inline]] inline std::size_t step_batches(Columns<T, Axes>& columns, const Rule& rule,
                                                       const Steps& steps, std::size_t begin,
                                                       std::size_t end) {
    for (std::size_t row = begin; row < end; row += V::lanes) {
        RowPhysics<V, Axes, Source> physics(columns, row, damping_of(rule));
        State<V, Axes> state = load<V>(columns.motion, row);
        take_steps(rule, state, physics, steps);
        if (may_be_infinite(state)) return row;
        store(state, columns.motion, row);
        if (row == 0) columns.evaluations += physics.evaluations();
    }
    return end;
}

template <class V, class Fixed, unsigned Kinds, class T, int Axes, class Rule>
[[gnu::flatten]] std::size_t step_shared(Columns<T, Axes>& columns, const Rule& rule,
                                         const Steps& steps, std::size_t begin, std::size_t end) {
    const Fixed fixed(rule);
    return step_batches<V, SharedForces<V, Axes, Kinds>>(columns, fixed, steps, begin, end);
}

/// With three axes, the forces leave too few registers for Wide: splittings of six stages would
/// take 2.5 times as long.
template <class V, class Rule, class T, int Axes>
[[gnu::flatten]] std::size_t step_any(Columns<T, Axes>& columns, const Rule& rule,
                                      const Steps& steps, std::size_t begin, std::size_t end) {
    using Fitting = std::conditional_t<Axes == 3, Narrow<T, Axes>, V>;
    return step_batches<Fitting, ForcesOfRow<Fitting, T, Axes>>(columns, rule, steps, begin, end);
}

/// Has fast paths for the forces of most scenes: gravity alone, or springs alone.
template <class V, class Fixed, class T, int Axes, class Rule>
std::size_t step_fixed(Columns<T, Axes>& columns, const Rule& rule, const Steps& steps,
                       std::size_t begin, std::size_t end) {
    if (SharedForces<V, Axes, 1U>::fits(columns))
        return step_shared<V, Fixed, 1U>(columns, rule, steps, begin, end);
    if (SharedForces<V, Axes, 2U>::fits(columns))
        return step_shared<V, Fixed, 2U>(columns, rule, steps, begin, end);
    return step_any<V>(columns, rule, steps, begin, end);
}

template <class V, class T, int Axes>
std::size_t step_splitting(Columns<T, Axes>& columns, const SplittingPlan<T>& rule,
                           const Steps& steps, std::size_t begin, std::size_t end) {
    if (KickDriftPlan<T>::fits(rule)) {
        if (SharedForces<V, Axes, 3U>::fits(columns))
            return step_shared<V, KickDriftPlan<T>, 3U>(columns, rule, steps, begin, end);
        if (SharedForces<V, Axes, 5U>::fits(columns))
            return step_shared<V, KickDriftPlan<T>, 5U>(columns, rule, steps, begin, end);
        return step_fixed<V, KickDriftPlan<T>>(columns, rule, steps, begin, end);
    }
    if (KickDriftKickPlan<T>::fits(rule))
        return step_fixed<V, KickDriftKickPlan<T>>(columns, rule, steps, begin, end);
    return step_any<V>(columns, rule, steps, begin, end);
}

template <class V, class T, int Axes>
std::size_t step_tableau(Columns<T, Axes>& columns, const TableauPlan<T>& rule, const Steps& steps,
                         std::size_t begin, std::size_t end) {
    if (ChainTableauPlan<T, 4>::fits(rule))
        return step_fixed<V, ChainTableauPlan<T, 4>>(columns, rule, steps, begin, end);
    if (ChainTableauPlan<T, 2>::fits(rule))
        return step_fixed<V, ChainTableauPlan<T, 2>>(columns, rule, steps, begin, end);
    return step_any<V>(columns, rule, steps, begin, end);
}

}  // namespace

template <class T, int Axes>
const Kernels<T, Axes>& kernels() {
    using V = Wide<T, Axes>;
    static constexpr Kernels<T, Axes> all{step_splitting<V, T, Axes>,
                                          step_tableau<Narrow<T, Axes>, T, Axes>,
                                          step_fixed<V, ExactPlan<T>, T, Axes, ExactPlan<T>>,
                                          linked_kernels<Narrow<T, Axes>, T, Axes>()};
    return all;
}

template const Kernels<OILER_PRECISION, 1>& kernels();
template const Kernels<OILER_PRECISION, 2>& kernels();
template const Kernels<OILER_PRECISION, 3>& kernels();

}  // namespace oiler::OILER_INSTRUCTIONS
