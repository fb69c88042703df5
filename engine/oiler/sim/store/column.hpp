// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <new>
#include <type_traits>
#include <vector>

#include "oiler/math/vec.hpp"

namespace oiler {

/// Columns end on a multiple of this many rows, so that whole batches can be loaded for any
/// register width. The rows after the last body are scratch.
inline constexpr std::size_t row_padding = 128;
inline constexpr std::size_t column_alignment = 64;

[[nodiscard]] constexpr std::size_t padded(std::size_t rows) {
    return (rows + row_padding - 1) / row_padding * row_padding;
}

/// Aligned memory, shifted by `lines` cache lines. Without the shift, large columns would all begin
/// at the same offset of their pages and compete for the same cache sets.
template <class T>
struct AlignedAllocator {
    using value_type = T;
    using propagate_on_container_copy_assignment = std::true_type;
    using propagate_on_container_move_assignment = std::true_type;
    using propagate_on_container_swap = std::true_type;

    explicit AlignedAllocator(std::size_t lines = 0) : skipped(lines * column_alignment) {}
    template <class U>
    AlignedAllocator(const AlignedAllocator<U>& other) : skipped(other.skipped) {}

    T* allocate(std::size_t count) {
        void* const at =
            ::operator new(skipped + count * sizeof(T), std::align_val_t(column_alignment));
        return reinterpret_cast<T*>(static_cast<std::byte*>(at) + skipped);
    }
    void deallocate(T* at, std::size_t) {
        ::operator delete(reinterpret_cast<std::byte*>(at) - skipped,
                          std::align_val_t(column_alignment));
    }
    friend bool operator==(const AlignedAllocator&, const AlignedAllocator&) = default;

    std::size_t skipped;
};

/// The number at an address, or a batch of the numbers from there on.
template <class V, class T>
[[gnu::always_inline]] inline V load_from(const T* from) {
    if constexpr (std::is_same_v<V, T>)
        return *from;
    else
        return V::load(from);
}
template <class V, class T>
[[gnu::always_inline]] inline void store_to(const V& value, T* to) {
    if constexpr (std::is_same_v<V, T>)
        *to = value;
    else
        value.store(to);
}

/// One number for each row, aligned and padded.
template <class T>
class Column {
public:
    Column() = default;
    /// `index` is the column's index among columns that are read together.
    explicit Column(std::size_t index) : values_(AlignedAllocator<T>(5 * index)) {}

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] T* data() { return values_.data(); }
    [[nodiscard]] const T* data() const { return values_.data(); }
    T& operator[](std::size_t row) { return values_[row]; }
    const T& operator[](std::size_t row) const { return values_[row]; }

    void reserve(std::size_t rows) { values_.reserve(padded(rows)); }
    [[gnu::always_inline]] void push(T value) {
        if (size_ % row_padding == 0 && size_ == values_.size()) grow();
        values_[size_++] = value;
    }
    /// Removes `row`; the last row moves to its place.
    void swap_remove(std::size_t row) {
        values_[row] = values_[--size_];
        values_[size_] = T(0);
    }
    void clear_padding() { std::fill(values_.begin() + end(), values_.end(), T(0)); }

private:
    [[nodiscard]] std::ptrdiff_t end() const { return static_cast<std::ptrdiff_t>(size_); }

    [[gnu::noinline]] void grow() { values_.resize(padded(size_ + 1)); }

    std::vector<T, AlignedAllocator<T>> values_;
    std::size_t size_ = 0;
};

/// One number per row. It is stored once while all rows agree, and as a column after the first
/// difference, so that a scene pays only for numbers that vary. A shared number fills as many rows
/// as a batch may load.
template <class T>
class Parameter {
public:
    Parameter() = default;
    /// `rows` rows with the same value.
    Parameter(T value, std::size_t rows) : size_(rows) { share(value); }

    [[nodiscard]] bool shared() const { return shared_; }
    /// The numbers from row `row` on.
    [[nodiscard]] const T* data(std::size_t row) const {
        return column_.data() + (shared_ ? 0 : row);
    }
    T operator[](std::size_t row) const { return *data(row); }

    void push(T value) {
        if (!shared_ || size_ == 0 || differ(value, column_[0])) return push_unlike(value);
        ++size_;
    }
    void set(std::size_t row, T value) {
        if (shared_ && size_ == 1)
            share(value);
        else if (!shared_ || differ(value, column_[0]))
            spread(), column_[row] = value;
    }
    void swap_remove(std::size_t row) {
        --size_;
        if (!shared_) column_.swap_remove(row);
    }

private:
    /// 0 and −0 differ, so that the bits of a body do not depend on its neighbours.
    static bool differ(T a, T b) { return a != b || std::signbit(a) != std::signbit(b); }

    /// Adds a number that is not that of all rows before.
    [[gnu::noinline]] void push_unlike(T value) {
        if (size_ == 0) {
            *this = Parameter(value, 1);
            return;
        }
        spread();
        column_.push(value);
        ++size_;
    }
    void share(T value) {
        column_ = {};
        while (column_.size() < row_padding) column_.push(value);
    }
    void spread() {
        if (!shared_) return;
        const T value = column_[0];
        column_ = {};
        while (column_.size() < size_) column_.push(value);
        shared_ = false;
    }

    Column<T> column_;
    std::size_t size_ = 0;
    bool shared_ = true;
};

/// The place of one number of all rows. Inner loops read views, because the compiler would reload
/// the fields of a Parameter after every store. Valid until the number changes. A default view is
/// of a number that is 0 for all rows.
template <class T>
class NumberView {
public:
    NumberView() = default;
    explicit NumberView(const Parameter<T>& number)
        : from_(number.data(0)), stride_(number.shared() ? 0 : 1) {}
    /// A number that is the same for all rows.
    explicit NumberView(const T& shared) : from_(&shared) {}
    explicit NumberView(const Column<T>& column) : from_(column.data()), stride_(1) {}

    [[nodiscard]] [[gnu::always_inline]] explicit operator bool() const { return from_; }
    /// Whether all rows have the same number.
    [[nodiscard]] bool is_shared() const { return stride_ == 0; }
    /// The number of one row, or of a batch of rows from `row` on.
    template <Number V>
    [[nodiscard]] [[gnu::always_inline]] V at(std::size_t row) const {
        if constexpr (requires { V::load(from_); })
            return V::load(from_ + row * stride_);
        else
            return V(from_[row * stride_]);
    }

private:
    const T* from_ = nullptr;
    std::size_t stride_ = 0;
};

}  // namespace oiler
