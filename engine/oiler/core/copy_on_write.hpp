// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

namespace oiler {

/// A value whose copies share its memory until one of them is written.
template <class T>
class CopyOnWrite {
public:
    [[nodiscard]] const T& operator*() const { return *value_; }
    [[nodiscard]] const T* operator->() const { return value_.get(); }
    /// The value for this copy alone.
    [[nodiscard]] T& write() {
        if (value_.use_count() > 1) value_ = std::make_shared<T>(*value_);
        return *value_;
    }

private:
    std::shared_ptr<T> value_ = std::make_shared<T>();
};

}  // namespace oiler
