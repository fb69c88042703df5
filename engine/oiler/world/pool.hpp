// SPDX-License-Identifier: MIT
#pragma once

#include <cassert>
#include <concepts>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

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
    void remove(std::uint32_t slot) {
        const std::uint32_t hole = places_[slot];
        dense_[hole] = dense_.back();
        places_[dense_[hole]] = hole;
        places_[slot] = absent;
        dense_.pop_back();
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

    [[nodiscard]] const SlotSet& slots() const { return slots_; }

protected:
    AnyPool(const AnyPool&) = default;

    SlotSet slots_;
};

/// The components of one type, contiguous, in the order of `slots()`.
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
        const std::uint32_t hole = slots_.place(slot);
        if (hole == SlotSet::absent) return;
        if (hole + std::size_t{1} != items_.size()) items_[hole] = std::move(items_.back());
        items_.pop_back();
        slots_.remove(slot);
    }
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
    std::vector<T> items_;
};

}  // namespace oiler
