// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <type_traits>

#include "oiler/math/batch.hpp"

namespace oiler {

template <class V>
constexpr std::size_t lanes_of = 1;
template <class Pack, std::size_t Packs>
constexpr std::size_t lanes_of<Batch<Pack, Packs>> = Batch<Pack, Packs>::lanes;

/// The number with the most lanes below those of V, for the rest after whole batches of V.
template <class V>
struct NarrowerOf {
    using type = V;
};
template <class T, std::size_t Bytes, std::size_t Packs>
struct NarrowerOf<Batch<Pack<T, Bytes>, Packs>> {
    static constexpr std::size_t smallest = 16;
    using type =
        std::conditional_t<(Packs > 1), Batch<Pack<T, Bytes>, 1>,
                           std::conditional_t<(Bytes > smallest), Batch<Pack<T, smallest>, 1>, T>>;
};
template <class V>
using Narrower = typename NarrowerOf<V>::type;

/// Calls f(N{}, i) for batches N of `count` numbers from `begin` on: whole batches of V first, then
/// narrower ones.
template <class V, class F>
[[gnu::always_inline]] inline void for_lanes(std::size_t begin, std::size_t count, F f) {
    std::size_t i = begin;
    for (; i + lanes_of<V> <= count; i += lanes_of<V>) f(V(Scalar<V>(0)), i);
    if constexpr (lanes_of < V >> 1) for_lanes<Narrower<V>>(i, count, f);
}

/// Like for_lanes from 0 on, beginning with the last numbers.
template <class V, class F>
[[gnu::always_inline]] inline void for_lanes_reversed(std::size_t count, F f) {
    for (; count >= lanes_of<V>; count -= lanes_of<V>) f(V(Scalar<V>(0)), count - lanes_of<V>);
    if constexpr (lanes_of < V >> 1) for_lanes_reversed<Narrower<V>>(count, f);
}

/// Like for_lanes, for an `f` that may handle an index twice: the last batch may overlap the one
/// before it.
template <class V, class F>
[[gnu::always_inline]] inline void for_overlapping_lanes(std::size_t count, F f) {
    if constexpr (lanes_of < V >> 1)
        if (count < lanes_of<V>) return for_overlapping_lanes<Narrower<V>>(count, f);
    if (count == 0) return;
    for (std::size_t i = 0; i + lanes_of<V> < count; i += lanes_of<V>) f(V(Scalar<V>(0)), i);
    f(V(Scalar<V>(0)), count - lanes_of<V>);
}

/// Calls f(N{}) for the N, V or narrower, with the most lanes up to `most`.
template <class V, class F>
[[gnu::always_inline]] inline void with_lanes(std::size_t most, F f) {
    if constexpr (lanes_of < V >> 1)
        if (lanes_of < V >> most) return with_lanes<Narrower<V>>(most, f);
    f(V(Scalar<V>(0)));
}

}  // namespace oiler
