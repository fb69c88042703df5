// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <utility>
#include <vector>

namespace oiler {

/// A list in pages of equal size. Adding an item moves no other, and items of a page are walked as
/// fast as an array.
template <class T>
class Pages {
public:
    /// The number of items of a full page: 4 KiB, or at least 16 items.
    static constexpr std::size_t page_size =
        std::bit_floor(std::max<std::size_t>(16, 4096 / sizeof(T)));

    Pages() = default;
    Pages(const Pages& other) : size_(other.size_) {
        pages_.reserve(other.pages_.size());
        for (const std::vector<T>& page : other.pages_)
            add_page().insert(pages_.back().end(), page.begin(), page.end());
    }
    Pages& operator=(const Pages&) = delete;

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] T& operator[](std::size_t i) { return pages_[i / page_size][i % page_size]; }
    [[nodiscard]] const T& operator[](std::size_t i) const {
        return pages_[i / page_size][i % page_size];
    }
    [[nodiscard]] T& back() { return pages_.back().back(); }
    void push_back(T&& item) {
        if (size_ % page_size == 0) add_page();
        pages_.back().push_back(std::move(item));
        ++size_;
    }
    void pop_back() {
        pages_.back().pop_back();
        if (--size_ % page_size == 0) pages_.pop_back();
    }

private:
    std::vector<T>& add_page() {
        pages_.emplace_back().reserve(page_size);
        return pages_.back();
    }

    std::vector<std::vector<T>> pages_;  ///< each has memory for all its items
    std::size_t size_ = 0;
};

}  // namespace oiler
