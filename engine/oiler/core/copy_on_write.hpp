// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <memory>

namespace oiler {

/// A value whose copies share its memory until one of them is written, whatever thread they are on.
template <class T>
class CopyOnWrite {
public:
    [[nodiscard]] const T& operator*() const { return *value_; }
    [[nodiscard]] const T* operator->() const { return value_.get(); }
    /// The value for this copy alone.
    [[nodiscard]] T& write() {
        if (value_.use_count() > 1)
            value_ = std::make_shared<T>(*value_);
        else  // the reads of copies that are gone came before
            std::atomic_thread_fence(std::memory_order_acquire);
        return *value_;
    }

private:
    std::shared_ptr<T> value_ = std::make_shared<T>();
};

}  // namespace oiler
