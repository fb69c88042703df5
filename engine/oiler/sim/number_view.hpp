// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/math/vec.hpp"
#include "oiler/sim/column.hpp"

namespace oiler {

/// Where the rows of one number are, for the inner loops: they read no Parameter, whose fields the
/// compiler would read again after every store. Valid until the number changes. A default view is
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
