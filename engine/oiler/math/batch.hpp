// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <tuple>
#include <utility>

#include "oiler/math/vec.hpp"

namespace oiler {

/// The vector type of g++ and clang. It is a class because g++ mistakes an alias of a dependent
/// vector type for the element type.
template <class T, std::size_t Bytes>
struct VectorOf {
    using type [[gnu::vector_size(Bytes)]] = T;
};

/// One SIMD register of `Bytes` bytes with numbers of type T. It uses the vector types of g++ and
/// clang, because std::experimental::simd compiles several times slower and is missing from libc++.
template <class T, std::size_t Bytes>
class Pack {
public:
    using value_type = T;
    using Register = typename VectorOf<T, Bytes>::type;
    /// The result of a comparison: all bits of a lane are set if it holds there.
    using Mask = decltype(Register{} < Register{});

    static constexpr std::size_t lanes = Bytes / sizeof(T);

    Pack() = default;
    [[gnu::always_inline]] Pack(Register lanes_given) : register_(lanes_given) {}
    [[gnu::always_inline]] explicit Pack(T everywhere) : register_(everywhere - Register{}) {}

    /// The address needs no alignment, and aligned loads cost no more.
    [[gnu::always_inline]] static Pack load(const T* from) {
        Register lanes_read;
        std::memcpy(&lanes_read, from, Bytes);
        return lanes_read;
    }
    [[gnu::always_inline]] void store(T* to) const { std::memcpy(to, &register_, Bytes); }

    /// The first and the second numbers of `lanes` pairs.
    [[gnu::always_inline]] static std::pair<Pack, Pack> load_pairs(const T* from) {
        return shuffle(load(from), load(from + lanes),
                       [](int i) { return i < int{lanes} ? 2 * i : 2 * (i - int{lanes}) + 1; });
    }
    [[gnu::always_inline]] static void store_pairs(Pack first, Pack second, T* to) {
        const auto [low, high] =
            shuffle(first, second, [](int i) { return i % 2 == 0 ? i / 2 : int{lanes} + i / 2; });
        low.store(to);
        high.store(to + lanes);
    }

    [[gnu::always_inline]] friend Pack operator+(Pack a, Pack b) {
        return a.register_ + b.register_;
    }
    [[gnu::always_inline]] friend Pack operator-(Pack a, Pack b) {
        return a.register_ - b.register_;
    }
    [[gnu::always_inline]] friend Pack operator*(Pack a, Pack b) {
        return a.register_ * b.register_;
    }
    [[gnu::always_inline]] friend Pack operator/(Pack a, Pack b) {
        return a.register_ / b.register_;
    }
    [[gnu::always_inline]] friend Pack operator-(Pack a) { return -a.register_; }

    [[gnu::always_inline]] friend Mask operator<(Pack a, Pack b) {
        return a.register_ < b.register_;
    }
    [[gnu::always_inline]] friend Mask operator>(Pack a, Pack b) {
        return a.register_ > b.register_;
    }
    [[gnu::always_inline]] friend Mask operator==(Pack a, Pack b) {
        return a.register_ == b.register_;
    }
    [[gnu::always_inline]] friend Mask operator!=(Pack a, Pack b) {
        return a.register_ != b.register_;
    }
    /// `a` in lanes where the mask holds, `b` in the others.
    [[gnu::always_inline]] static Pack select(Mask mask, Pack a, Pack b) {
        return mask ? a.register_ : b.register_;
    }

    /// Whether the mask holds in any lane.
    [[gnu::always_inline]] static bool any(Mask mask) {
#ifdef __AVX512DQ__
        // From a mask in a vector, g++ makes a chain of shuffles with three times the latency.
        using Ints = typename VectorOf<int, Bytes>::type;
        using Longs = typename VectorOf<long long, Bytes>::type;
        if constexpr (Bytes == 64 && sizeof(T) == 4)
            return __builtin_ia32_cvtd2mask512(reinterpret_cast<Ints>(mask)) != 0;
        if constexpr (Bytes == 64 && sizeof(T) == 8)
            return __builtin_ia32_cvtq2mask512(reinterpret_cast<Longs>(mask)) != 0;
#endif
        std::array<std::uint64_t, Bytes / sizeof(std::uint64_t)> words;
        std::memcpy(words.data(), &mask, Bytes);
        std::uint64_t all = 0;
        for (const std::uint64_t word : words) all |= word;
        return all != 0;
    }

    /// Whether all lanes are finite.
    [[gnu::always_inline]] friend bool is_finite(Pack a) {
#ifdef __AVX512DQ__
        constexpr int infinite_or_nan = 0x99;
        if constexpr (Bytes == 64 && sizeof(T) == 4)
            return __builtin_ia32_fpclassps512_mask(a.register_, infinite_or_nan, 0xFFFF) == 0;
        if constexpr (Bytes == 64 && sizeof(T) == 8)
            return __builtin_ia32_fpclasspd512_mask(a.register_, infinite_or_nan, 0xFF) == 0;
#endif
        return !any(a - a != Pack(T(0)));
    }

    [[gnu::always_inline]] friend Pack abs(Pack a) { return select(a < Pack(T(0)), -a, a); }
    [[gnu::always_inline]] friend Pack sqrt(Pack a) {
        for (std::size_t i = 0; i < lanes; ++i) a.register_[i] = std::sqrt(a.register_[i]);
        return a;
    }

private:
    /// Lane i of the result, of two registers, is lane from(i) of `a` and `b`.
    template <class From>
    [[gnu::always_inline]] static std::pair<Pack, Pack> shuffle(Pack a, Pack b, From) {
        return [&]<std::size_t... i>(std::index_sequence<i...>) __attribute__((always_inline)) {
            constexpr From from{};
            return std::pair<Pack, Pack>(
                __builtin_shufflevector(a.register_, b.register_, from(int{i})...),
                __builtin_shufflevector(a.register_, b.register_, from(int{lanes + i})...));
        }
        (std::make_index_sequence<lanes>{});
    }

    Register register_;
};

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
    /// `value` in lanes where a > limit; 0 elsewhere.
    [[gnu::always_inline]] friend Batch value_above(const Batch& value, const Batch& a,
                                                    const Batch& limit) {
        return Batch(generate<packs>([&](auto i) {
            return Pack::select(a.pack_[i] > limit.pack_[i], value.pack_[i], Pack(T(0)));
        }));
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
        return is_finite(a.template sum_from<0, packs>());
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
