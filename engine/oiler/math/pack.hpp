// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

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

}  // namespace oiler
