// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace oiler {

/// Slots that handles refer to. Each use of a slot has its own generation, so that stale handles
/// are recognised. Generations are odd while a slot is used, even while it is free: no handle
/// matches a free slot, not even one from a copy.
class HandleSlots {
public:
    /// Takes a slot, for Handle{slot, generation}.
    template <class Handle>
    [[nodiscard]] Handle take() {
        if (free_.empty()) {
            generations_.push_back(1);
            return {static_cast<std::uint32_t>(generations_.size() - 1), 1};
        }
        const std::uint32_t slot = free_.back();
        free_.pop_back();
        return {slot, ++generations_[slot]};
    }
    void release(std::uint32_t slot) {
        ++generations_[slot];
        free_.push_back(slot);
    }
    [[nodiscard]] bool holds(std::uint32_t slot, std::uint32_t generation) const {
        return slot < generations_.size() && generations_[slot] == generation;
    }
    [[nodiscard]] std::uint32_t generation(std::uint32_t slot) const { return generations_[slot]; }
    /// The number of slots, used or not.
    [[nodiscard]] std::size_t size() const { return generations_.size(); }
    [[nodiscard]] std::size_t used() const { return generations_.size() - free_.size(); }
    void reserve(std::size_t slots) { generations_.reserve(slots); }

private:
    std::vector<std::uint32_t> generations_;
    std::vector<std::uint32_t> free_;
};

}  // namespace oiler
