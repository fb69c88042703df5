// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cassert>
#include <concepts>
#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "oiler/core/state_hash.hpp"
#include "oiler/world/pages.hpp"
#include "oiler/world/type_name.hpp"

namespace oiler {

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
        if (slot >= places_.size()) places_.resize(slot + std::size_t{1}, absent);
        assert(places_[slot] == absent);
        places_[slot] = static_cast<std::uint32_t>(dense_.size());
        dense_.push_back(slot);
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
    /// Like erase, but moves no other component before `bury`.
    void hide(std::uint32_t slot) {
        if (slots_.place(slot) != SlotSet::absent) holes_.push_back(slots_.hide(slot));
    }
    virtual void bury() = 0;
    /// Adds the components to a hash, if their type says how; false if it does not.
    virtual bool hash_into(StateHash& hash) const = 0;
    [[nodiscard]] virtual std::string_view type() const = 0;

    [[nodiscard]] const SlotSet& slots() const { return slots_; }

protected:
    AnyPool(const AnyPool&) = default;

    SlotSet slots_;
    std::vector<std::uint32_t> holes_;  ///< since the last bury
};

/// Places of holes in the order in which they are filled: each time, the last item is none.
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
    void bury() override {
        for (const std::uint32_t hole : last_first(holes_)) fill(hole);
    }
    bool hash_into(StateHash& hash) const override {
        if constexpr (Hashed<T>) {
            hash.add(slots_.size());
            for (std::size_t place = 0; place < items_.size(); ++place) {
                hash.add(std::uint64_t{slots_[place]});
                hash.add(items_[place]);
            }
        }
        return Hashed<T>;
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
