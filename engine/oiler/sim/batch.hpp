// SPDX-License-Identifier: MIT
#pragma once

#include <experimental/simd>

#include "oiler/sim/vec.hpp"

namespace oiler {

/// Several bodies' numbers as one Number: four SIMD registers of whatever width the file is
/// compiled for. Four, so that the additions of one register hide the latency of the others'. No
/// result depends on the width: lanes never meet.
template <std::floating_point T>
class Batch {
public:
    using Pack = std::experimental::native_simd<T>;
    static constexpr std::size_t packs = 4;
    static constexpr std::size_t lanes = packs * Pack::size();

    Batch() = default;
    [[gnu::always_inline]] Batch(T everywhere)
        : pack_(generate<packs>([&](auto) { return Pack(everywhere); })) {}

    /// `lanes` numbers from `from`, which is aligned to 64 bytes.
    [[gnu::always_inline]] static Batch load(const T* from) {
        return Batch(generate<packs>([&](auto i) {
            return Pack(from + i * Pack::size(), std::experimental::vector_aligned);
        }));
    }
    [[gnu::always_inline]] void store(T* to) const {
        for_each_index<packs>([&](auto i) {
            pack_[i].copy_to(to + i * Pack::size(), std::experimental::vector_aligned);
        });
    }

    [[gnu::always_inline]] friend Batch operator+(const Batch& a, const Batch& b) {
        return Batch(generate<packs>([&](auto i) { return Pack(a.pack_[i] + b.pack_[i]); }));
    }
    [[gnu::always_inline]] friend Batch operator-(const Batch& a, const Batch& b) {
        return Batch(generate<packs>([&](auto i) { return Pack(a.pack_[i] - b.pack_[i]); }));
    }
    [[gnu::always_inline]] friend Batch operator*(const Batch& a, const Batch& b) {
        return Batch(generate<packs>([&](auto i) { return Pack(a.pack_[i] * b.pack_[i]); }));
    }
    [[gnu::always_inline]] friend Batch operator/(const Batch& a, const Batch& b) {
        return Batch(generate<packs>([&](auto i) { return Pack(a.pack_[i] / b.pack_[i]); }));
    }
    [[gnu::always_inline]] friend Batch operator-(const Batch& a) {
        return Batch(generate<packs>([&](auto i) { return Pack(-a.pack_[i]); }));
    }
    [[gnu::always_inline]] friend Batch sqrt(const Batch& a) {
        return Batch(
            generate<packs>([&](auto i) { return Pack(std::experimental::sqrt(a.pack_[i])); }));
    }
    /// a/b, and 0 in the lanes where b is 0.
    [[gnu::always_inline]] friend Batch quotient_or_zero(const Batch& a, const Batch& b) {
        return quotient_where_not(b, a, b);
    }
    /// a/b, and 0 in the lanes where a is 0.
    [[gnu::always_inline]] friend Batch quotient_unless_nothing(const Batch& a, const Batch& b) {
        return quotient_where_not(a, a, b);
    }
    /// No lane is infinite or NaN.
    [[gnu::always_inline]] friend bool all_finite(const Batch& a) {
        const Batch nothing = a - a;
        const Pack sum =
            (nothing.pack_[0] + nothing.pack_[1]) + (nothing.pack_[2] + nothing.pack_[3]);
        return std::experimental::all_of(sum == Pack(T(0)));
    }

private:
    [[gnu::always_inline]] static Batch quotient_where_not(const Batch& zero, const Batch& a,
                                                           const Batch& b) {
        return Batch(generate<packs>([&](auto i) {
            Pack quotient = a.pack_[i] / b.pack_[i];
            std::experimental::where(zero.pack_[i] == Pack(T(0)), quotient) = Pack(T(0));
            return quotient;
        }));
    }

    [[gnu::always_inline]] explicit Batch(const std::array<Pack, packs>& pack) : pack_(pack) {}

    std::array<Pack, packs> pack_;
};

template <class T>
struct ScalarOf<Batch<T>> {
    using type = T;
};

}  // namespace oiler
