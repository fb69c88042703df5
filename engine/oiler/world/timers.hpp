// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <iterator>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "oiler/core/state_hash.hpp"
#include "oiler/world/pool.hpp"

namespace oiler {

/// The interface of timers without the type of their messages.
class AnyTimers {
public:
    virtual ~AnyTimers() = default;
    AnyTimers() = default;
    AnyTimers& operator=(const AnyTimers&) = delete;

    [[nodiscard]] virtual std::unique_ptr<AnyTimers> clone() const = 0;
    virtual bool hash_into(StateHash& hash) const = 0;
    [[nodiscard]] virtual std::string_view type() const = 0;

protected:
    AnyTimers(const AnyTimers&) = default;
};

/// Messages of one type to a later time. They are data, so that a copy of the world has them, too.
template <class T>
class Timers final : public AnyTimers {
public:
    [[nodiscard]] std::unique_ptr<AnyTimers> clone() const override {
        return std::make_unique<Timers>(*this);
    }
    bool hash_into(StateHash& hash) const override {
        if constexpr (Hashed<T>)
            for (const Entry& entry : entries_) {
                hash.add(std::bit_cast<std::uint64_t>(entry.time));
                hash.add(entry.message);
            }
        return Hashed<T>;
    }
    [[nodiscard]] std::string_view type() const override { return type_name<T>(); }

    struct Entry {
        double time;  ///< s
        T message;
    };

    void add(double time, T message) { entries_.push_back({time, std::move(message)}); }
    /// Removes and returns the messages of after < time <= until: earliest first, then in order of
    /// adding.
    [[nodiscard]] std::vector<Entry> take(double after, double until) {
        const auto due = std::stable_partition(
            entries_.begin(), entries_.end(),
            [&](const Entry& entry) { return entry.time <= after || entry.time > until; });
        std::vector<Entry> taken(std::make_move_iterator(due),
                                 std::make_move_iterator(entries_.end()));
        entries_.erase(due, entries_.end());
        std::ranges::stable_sort(taken, {}, &Entry::time);
        return taken;
    }

private:
    std::vector<Entry> entries_;
};

}  // namespace oiler
