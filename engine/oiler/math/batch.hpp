// SPDX-License-Identifier: MIT
#pragma once

#include <tuple>
#include <utility>

#include "oiler/math/pack.hpp"
#include "oiler/math/vec.hpp"

namespace oiler {

/// One Number for several bodies: a few SIMD registers of one width. With several registers, the
/// arithmetic of one hides the latency of the others. Results do not depend on the width or the
/// number of registers, because lanes never interact.
template <class PackOfNumbers, std::size_t Packs>
class Batch {
public:
    using Pack = PackOfNumbers;
    using T = typename Pack::value_type;
    static constexpr std::size_t packs = Packs;
    static constexpr std::size_t lanes = packs * Pack::lanes;

    Batch() = default;
    [[gnu::always_inline]] Batch(T everywhere)
        : pack_(generate<packs>([&](auto) { return Pack(everywhere); })) {}

    /// Loads `lanes` numbers; the address needs no alignment.
    [[gnu::always_inline]] static Batch load(const T* from) {
        return Batch(generate<packs>([&](auto i) { return Pack::load(from + i * Pack::lanes); }));
    }
    [[gnu::always_inline]] void store(T* to) const {
        for_each_index<packs>([&](auto i) { pack_[i].store(to + i * Pack::lanes); });
    }

    /// The first and the second numbers of `lanes` pairs.
    [[gnu::always_inline]] static std::pair<Batch, Batch> load_pairs(const T* from) {
        std::pair<Batch, Batch> pairs;
        for_each_index<packs>([&](auto i) {
            std::tie(pairs.first.pack_[i], pairs.second.pack_[i]) =
                Pack::load_pairs(from + 2 * i * Pack::lanes);
        });
        return pairs;
    }
    [[gnu::always_inline]] static void store_pairs(const Batch& first, const Batch& second, T* to) {
        for_each_index<packs>([&](auto i) {
            Pack::store_pairs(first.pack_[i], second.pack_[i], to + 2 * i * Pack::lanes);
        });
    }

    [[gnu::always_inline]] friend Batch operator+(const Batch& a, const Batch& b) {
        return Batch(generate<packs>([&](auto i) { return a.pack_[i] + b.pack_[i]; }));
    }
    [[gnu::always_inline]] friend Batch operator-(const Batch& a, const Batch& b) {
        return Batch(generate<packs>([&](auto i) { return a.pack_[i] - b.pack_[i]; }));
    }
    [[gnu::always_inline]] friend Batch operator*(const Batch& a, const Batch& b) {
        return Batch(generate<packs>([&](auto i) { return a.pack_[i] * b.pack_[i]; }));
    }
    [[gnu::always_inline]] friend Batch operator/(const Batch& a, const Batch& b) {
        return Batch(generate<packs>([&](auto i) { return a.pack_[i] / b.pack_[i]; }));
    }
    [[gnu::always_inline]] friend Batch operator-(const Batch& a) {
        return Batch(generate<packs>([&](auto i) { return -a.pack_[i]; }));
    }
    [[gnu::always_inline]] friend Batch sqrt(const Batch& a) {
        return Batch(generate<packs>([&](auto i) { return sqrt(a.pack_[i]); }));
    }
    /// a/b; 0 in lanes where b is 0.
    [[gnu::always_inline]] friend Batch quotient_or_zero(const Batch& a, const Batch& b) {
        return masked_quotient(b, a, b);
    }
    /// a/b; 0 in lanes where a is 0, whatever b is.
    [[gnu::always_inline]] friend Batch quotient_of_nonzero(const Batch& a, const Batch& b) {
        return masked_quotient(a, a, b);
    }
    /// `instead` in lanes where 0 < |v| < limit, all |sizes| < limit and rate > 0; elsewhere
    /// `value`.
    template <class... Sizes>
    [[gnu::always_inline]] friend Batch replace_where_sleeping(const Batch& value,
                                                               const Batch& instead,
                                                               const Batch& rate, T limit,
                                                               const Batch& v,
                                                               const Sizes&... sizes) {
        return Batch(generate<packs>([&](auto i) {
            const auto less =
                ((abs(sizes.pack_[i]) < Pack(limit)) & ... & nonzero_below(v.pack_[i], limit));
            const auto positive = rate.pack_[i] > Pack(T(0));
            return Pack::select(less & positive, instead.pack_[i], value.pack_[i]);
        }));
    }
    /// Whether 0 < |v| < limit in any lane.
    [[gnu::always_inline]] friend bool any_nonzero_below(const Batch& v, T limit) {
        auto any = nonzero_below(v.pack_[0], limit);
        for_each_index<packs - 1>([&](auto i) __attribute__((always_inline)) {
            any |= nonzero_below(v.pack_[i + 1], limit);
        });
        return Pack::any(any);
    }
    [[gnu::always_inline]] friend bool any_positive(const Batch& a) {
        bool any = false;
        for_each_index<packs>([&](auto i) { any = any || Pack::any(a.pack_[i] > Pack(T(0))); });
        return any;
    }
    /// Whether the sum of the registers is finite in all lanes; then all numbers are finite.
    [[gnu::always_inline]] friend bool is_finite(const Batch& a) {
        const Pack total = a.template sum_from<0, packs>();
        return !Pack::any(total - total != Pack(T(0)));
    }

private:
    /// The sum of `Count` registers from `First` on, in pairs: few additions wait for each other.
    template <std::size_t First, std::size_t Count>
    [[gnu::always_inline]] Pack sum_from() const {
        if constexpr (Count == 1)
            return pack_[First];
        else
            return sum_from<First, Count / 2>() + sum_from<First + Count / 2, Count - Count / 2>();
    }
    [[gnu::always_inline]] static auto nonzero_below(const Pack& v, T limit) {
        return (abs(v) < Pack(limit)) & (v != Pack(T(0)));
    }
    [[gnu::always_inline]] static Batch masked_quotient(const Batch& zero, const Batch& a,
                                                        const Batch& b) {
        return Batch(generate<packs>([&](auto i) {
            return Pack::select(zero.pack_[i] == Pack(T(0)), Pack(T(0)), a.pack_[i] / b.pack_[i]);
        }));
    }

    [[gnu::always_inline]] explicit Batch(const std::array<Pack, packs>& pack) : pack_(pack) {}

    std::array<Pack, packs> pack_;
};

template <class Pack, std::size_t Packs>
struct ScalarOf<Batch<Pack, Packs>> {
    using type = typename Pack::value_type;
};

}  // namespace oiler
