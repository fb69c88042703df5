// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/sim/bodies.hpp"
#include "support/test.hpp"

namespace oiler::test {

/// The steps of a run in which a trend of one rounding per step is visible; a hundredth of them in
/// unoptimised builds and with sanitizers.
#ifdef NDEBUG
inline constexpr int long_run = 1'000'000;
#else
inline constexpr int long_run = 10'000;
#endif

inline constexpr std::array precisions{Precision::single, Precision::double_};

/// The largest relative change of a number by a rounding.
constexpr double round_off_of(Precision precision) {
    return precision == Precision::single ? std::numeric_limits<float>::epsilon() / 2.0
                                          : std::numeric_limits<double>::epsilon() / 2;
}
constexpr double largest_of(Precision precision) {
    return precision == Precision::single ? double{std::numeric_limits<float>::max()}
                                          : std::numeric_limits<double>::max();
}

inline bool is_exact(const Method& method) { return method.order == exact_order; }
inline bool is_splitting(const Method& method) {
    return std::holds_alternative<Splitting>(method.rule);
}

/// The most roundings of numbers of the motion's size per step. A move of a splitting computes a
/// force, a product and a sum. Each stage of a tableau, and its end, sums up to `count` products in
/// x and v. The last iteration of an implicit step and the exact step are counted.
inline int roundings(const Method& method) {
    if (const auto* splitting = std::get_if<Splitting>(&method.rule))
        return 4 * static_cast<int>(splitting->stages().size());
    if (const auto* tableau = std::get_if<Tableau>(&method.rule))
        return static_cast<int>(4 * tableau->count * (tableau->count + 1));
    return is_exact(method) ? 8 : 16;
}

/// 1 kg on a spring along one axis, `k` in N/m and `c` in N·s/m.
inline Bodies oscillator(Precision precision, double k, double c, double x, double v = 0) {
    Bodies bodies(1, precision);
    bodies.add({.position = {x}, .velocity = {v}}, Spring{.stiffness = k, .damping = c});
    return bodies;
}

inline long double x_of(const Bodies& bodies, std::size_t row = 0) {
    return bodies.state(row).x[0];
}
inline long double v_of(const Bodies& bodies, std::size_t row = 0) {
    return bodies.state(row).v[0];
}
/// The amplitude √(ω²x² + v²): the square root of twice the energy per mass.
inline long double amplitude(const Bodies& bodies, long double omega) {
    return std::hypot(omega * x_of(bodies), v_of(bodies));
}

/// Calls f(method, precision) for each method that may step linked bodies, in both precisions.
template <class F>
void for_each_kind(F f) {
    for (const Method& method : methods())
        for (const Precision precision : precisions) {
            if (is_exact(method)) continue;
            SCOPED_TRACE(testing::Message() << method.name << " in " << name_of(precision));
            f(method, precision);
        }
}

inline std::uint64_t hash_of(const Bodies& bodies) {
    StateHash hash;
    bodies.hash_into(hash);
    return hash.value();
}

}  // namespace oiler::test
