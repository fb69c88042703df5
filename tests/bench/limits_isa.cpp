// SPDX-License-Identifier: MIT
// Compiled once for each instruction set, OILER_BENCH_ISA, with registers of OILER_BENCH_BYTES.
// The linker must not use this code for the rest of the program: everything is in a namespace of
// the instruction set, and no inline function from elsewhere is called.
#include "bench/limits.hpp"

namespace oiler::bench::OILER_BENCH_ISA {
namespace {

template <class T>
struct PackOf {
    typedef T type __attribute__((vector_size(OILER_BENCH_BYTES), aligned(sizeof(T)), may_alias));
};
template <class T>
using Pack = typename PackOf<T>::type;
template <class T>
constexpr std::size_t lanes = OILER_BENCH_BYTES / sizeof(T);

// The number of registers of positions, and of velocities, that are stepped together: enough to
// hide the latency of dependent additions. Measured; some are spilled.
constexpr int fall_packs = OILER_BENCH_FALL_PACKS;
constexpr int spring_packs = OILER_BENCH_SPRING_PACKS;
constexpr int rest_packs = 4;

// __restrict works on parameters only: with local pointers, g++ does not vectorise these loops.
// `T...` has one number per axis.

template <class T, class... Column>
[[gnu::noinline]] void sweep_columns(std::size_t rows, T factor, Column* __restrict... column) {
    for (std::size_t i = 0; i < rows; ++i) ((column[i] *= factor), ...);
}

template <class... T>
struct Loops {
    template <class Dt>
    [[gnu::noinline]] static void fall(std::size_t rows, Dt dt, T... gravity, T* __restrict... x,
                                       T* __restrict... v) {
        for (std::size_t i = 0; i < rows; ++i) {
            ((v[i] = v[i] + gravity * dt), ...);
            ((x[i] = x[i] + v[i] * dt), ...);
        }
    }
    template <class Dt>
    [[gnu::noinline]] static void spring(std::size_t rows, Dt dt, Dt k, Dt c, T... anchor,
                                         T* __restrict... x, T* __restrict... v) {
        for (std::size_t i = 0; i < rows; ++i) {
            ((v[i] = v[i] + ((x[i] - anchor) * -k - v[i] * c) * dt), ...);
            ((x[i] = x[i] + v[i] * dt), ...);
        }
    }
};

/// Loads, steps and stores registers of positions and velocities, from row `i` on, while full
/// registers remain. Returns the next row.
template <int packs, class T, class Step>
[[gnu::always_inline]] inline std::size_t in_blocks(std::size_t i, std::size_t rows, int steps,
                                                    T* x, T* v, Step step) {
    using P = Pack<T>;
    for (; i + lanes<T> * packs <= rows; i += lanes<T> * packs) {
        P px[packs];
        P pv[packs];
        P* const to_x = reinterpret_cast<P*>(x + i);
        P* const to_v = reinterpret_cast<P*>(v + i);
        for (int p = 0; p < packs; ++p) px[p] = to_x[p], pv[p] = to_v[p];
        for (int s = 0; s < steps; ++s)
#pragma GCC unroll 16
            for (int p = 0; p < packs; ++p) step(px[p], pv[p]);
        for (int p = 0; p < packs; ++p) to_x[p] = px[p], to_v[p] = pv[p];
    }
    return i;
}

template <int packs, class T, class Step>
[[gnu::always_inline]] inline void in_registers(std::size_t rows, int steps, T* x, T* v,
                                                Step step) {
    const std::size_t done = in_blocks<packs>(0, rows, steps, x, v, step);
    in_blocks<rest_packs>(done, rows, steps, x, v, step);
}

template <class T>
[[gnu::noinline]] void fall_axis(std::size_t rows, int steps, T dt, T gravity, T* __restrict x,
                                 T* __restrict v) {
    using P = Pack<T>;
    const P change = P{} + gravity * dt;
    const P by = P{} + dt;
    in_registers<fall_packs>(rows, steps, x, v, [=](P& px, P& pv) {
        pv = pv + change;
        px = px + pv * by;
    });
}

template <class T>
[[gnu::noinline]] void spring_axis(std::size_t rows, int steps, T dt, T k, T c, T anchor,
                                   T* __restrict x, T* __restrict v) {
    using P = Pack<T>;
    const P by = P{} + dt;
    const P pull = P{} - k;
    const P brake = P{} + c;
    const P at = P{} + anchor;
    in_registers<spring_packs>(rows, steps, x, v, [=](P& px, P& pv) {
        pv = pv + ((px - at) * pull - pv * brake) * by;
        px = px + pv * by;
    });
}

template <class T>
[[gnu::noinline]] T read(const T* numbers, std::size_t count) {
    using P = Pack<T>;
    P sum[8]{};
    for (std::size_t i = 0; i < count; i += lanes<T> * 8)
#pragma GCC unroll 8
        for (std::size_t p = 0; p < 8; ++p)
            sum[p] += *reinterpret_cast<const P*>(numbers + i + p * lanes<T>);
    const P all = ((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7]));
    T total = 0;
    for (std::size_t lane = 0; lane < lanes<T>; ++lane) total += all[lane];
    return total;
}

template <class T>
void sweep(const HandScene<T>& s, T factor) {
    if (s.axes == 1) return sweep_columns(s.rows, factor, s.x[0], s.v[0]);
    if (s.axes == 2) return sweep_columns(s.rows, factor, s.x[0], s.x[1], s.v[0], s.v[1]);
    sweep_columns(s.rows, factor, s.x[0], s.x[1], s.x[2], s.v[0], s.v[1], s.v[2]);
}

template <class T>
void fall(const HandScene<T>& s) {
    const auto& [rows, axes, dt, g, anchor, k, c, x, v] = s;
    if (axes == 1) return Loops<T>::fall(rows, dt, g[0], x[0], v[0]);
    if (axes == 2) return Loops<T, T>::fall(rows, dt, g[0], g[1], x[0], x[1], v[0], v[1]);
    Loops<T, T, T>::fall(rows, dt, g[0], g[1], g[2], x[0], x[1], x[2], v[0], v[1], v[2]);
}

template <class T>
void spring(const HandScene<T>& s) {
    const auto& [rows, axes, dt, g, at, k, c, x, v] = s;
    if (axes == 1) return Loops<T>::spring(rows, dt, k, c, at[0], x[0], v[0]);
    if (axes == 2) return Loops<T, T>::spring(rows, dt, k, c, at[0], at[1], x[0], x[1], v[0], v[1]);
    Loops<T, T, T>::spring(rows, dt, k, c, at[0], at[1], at[2], x[0], x[1], x[2], v[0], v[1], v[2]);
}

template <class T>
void fall_many(const HandScene<T>& s, int steps) {
    for (int a = 0; a < s.axes; ++a) fall_axis(s.rows, steps, s.dt, s.gravity[a], s.x[a], s.v[a]);
}

template <class T>
void spring_many(const HandScene<T>& s, int steps) {
    for (int a = 0; a < s.axes; ++a)
        spring_axis(s.rows, steps, s.dt, s.stiffness, s.damping, s.anchor[a], s.x[a], s.v[a]);
}

}  // namespace

extern const HandLoops<float> in_float;
extern const HandLoops<double> in_double;
const HandLoops<float> in_float{sweep, fall, spring, fall_many, spring_many, read};
const HandLoops<double> in_double{sweep, fall, spring, fall_many, spring_many, read};

}  // namespace oiler::bench::OILER_BENCH_ISA
