// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "oiler/core/state_hash.hpp"

namespace oiler {

/// The name of a type as the compiler writes it.
template <class T>
[[nodiscard]] constexpr std::string_view type_name() {
    const std::string_view text = __PRETTY_FUNCTION__;
    const std::size_t begin = text.find("T = ") + 4;
    return text.substr(begin, text.find_first_of(";]", begin) - begin);
}

/// A type of component that is no state of a play, such as a name: hashes leave it out. It says so
/// with `static constexpr bool is_state = false`.
template <class T>
concept NoState = requires {
    requires !T::is_state;
};

/// A list in pages of equal size. Adding an item moves no other, and iterating over a page is as
/// fast as over an array.
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

/// A set of slots in the order of adding. The last slot moves to the place of a removed one. Add,
/// remove and look-up take O(1); the order depends only on the adds and removes.
class SlotSet {
public:
    static constexpr std::uint32_t absent = ~std::uint32_t{0};

    [[nodiscard]] std::size_t size() const { return dense_.size(); }
    [[nodiscard]] std::uint32_t operator[](std::size_t place) const { return dense_[place]; }
    /// The place of `slot` in the order, or `absent`.
    [[nodiscard]] std::uint32_t place(std::uint32_t slot) const {
        return slot < places_.size() ? places_[slot] : absent;
    }
    void reserve(std::size_t slots) {
        dense_.reserve(slots);
        places_.reserve(slots);
    }
    void add(std::uint32_t slot) {
        const auto place = static_cast<std::uint32_t>(dense_.size());
        dense_.push_back(slot);
        if (slot == places_.size()) return places_.push_back(place);
        if (slot > places_.size()) places_.resize(slot + std::size_t{1}, absent);
        assert(places_[slot] == absent);
        places_[slot] = place;
    }
    void remove(std::uint32_t slot) { fill(hide(slot)); }
    /// Takes a slot out of the set, and leaves a hole in the order: `absent`. Returns its place.
    std::uint32_t hide(std::uint32_t slot) {
        const std::uint32_t hole = places_[slot];
        dense_[hole] = absent;
        places_[slot] = absent;
        return hole;
    }
    /// Moves the last slot into a hole; it is the last hole.
    void fill(std::uint32_t hole) {
        const std::uint32_t last = dense_.back();
        dense_.pop_back();
        if (hole == dense_.size()) return;
        dense_[hole] = last;
        places_[last] = hole;
    }

private:
    std::vector<std::uint32_t> dense_;
    std::vector<std::uint32_t> places_;
};

/// The interface of a pool without the type of its components.
class AnyPool {
public:
    virtual ~AnyPool() = default;
    AnyPool() = default;
    AnyPool& operator=(const AnyPool&) = delete;

    [[nodiscard]] virtual std::unique_ptr<AnyPool> clone() const = 0;
    virtual void erase(std::uint32_t slot) = 0;
    /// Like erase, but moves no other component before `fill_holes`.
    void hide(std::uint32_t slot) {
        if (slots_.place(slot) != SlotSet::absent) holes_.push_back(slots_.hide(slot));
    }
    virtual void fill_holes() = 0;
    /// Adds the components to a hash, if they are state; false if their type does not say how.
    virtual bool hash_into(StateHash& hash) const = 0;
    [[nodiscard]] virtual std::string_view type() const = 0;

    [[nodiscard]] const SlotSet& slots() const { return slots_; }

protected:
    AnyPool(const AnyPool&) = default;

    SlotSet slots_;
    std::vector<std::uint32_t> holes_;  ///< since the last fill_holes
};

/// Places of holes, the last first: each is filled by an item that is no hole.
inline std::vector<std::uint32_t> last_first(std::vector<std::uint32_t>& holes) {
    std::sort(holes.begin(), holes.end(), std::greater<>());
    return std::exchange(holes, {});
}

/// The components of one type, in the order of `slots()`. Adding one moves no other.
template <class T>
class Pool final : public AnyPool {
    static_assert(!std::is_same_v<T, bool>, "wrap a bool in a struct with a descriptive name");

public:
    [[nodiscard]] std::unique_ptr<AnyPool> clone() const override {
        if constexpr (std::copyable<T>)
            return std::make_unique<Pool>(*this);
        else
            throw std::logic_error("a world with move-only components cannot be copied");
    }
    void erase(std::uint32_t slot) override {
        if (slots_.place(slot) != SlotSet::absent) fill(slots_.hide(slot));
    }
    void fill_holes() override {
        for (const std::uint32_t hole : last_first(holes_)) fill(hole);
    }
    bool hash_into(StateHash& hash) const override {
        if constexpr (Hashed<T> && !NoState<T>) {
            hash.add(slots_.size());
            for (std::size_t place = 0; place < items_.size(); ++place) {
                hash.add(std::uint64_t{slots_[place]});
                hash.add(items_[place]);
            }
        }
        return Hashed<T> || NoState<T>;
    }
    [[nodiscard]] std::string_view type() const override { return type_name<T>(); }

    T& add(std::uint32_t slot, T&& item) {
        items_.push_back(std::move(item));
        slots_.add(slot);
        return items_.back();
    }
    /// The component of slot `slots()[place]`.
    [[nodiscard]] T& operator[](std::size_t place) { return items_[place]; }
    /// Null if `slot` has none.
    [[nodiscard]] T* find(std::uint32_t slot) {
        const std::uint32_t place = slots_.place(slot);
        return place == SlotSet::absent ? nullptr : &items_[place];
    }

private:
    void fill(std::uint32_t hole) {
        if (hole + std::size_t{1} != items_.size()) items_[hole] = std::move(items_.back());
        items_.pop_back();
        slots_.fill(hole);
    }

    Pages<T> items_;
};

}  // namespace oiler
