// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
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
    /// Moves each message from its tick t to the tick `moved(t)`.
    virtual void move(const std::function<std::int64_t(std::int64_t)>& moved) = 0;
    [[nodiscard]] virtual std::string_view type() const = 0;

protected:
    AnyTimers(const AnyTimers&) = default;
};

/// Messages of one type to a later tick. They are data, so that a copy of the world has them, too.
template <class T>
class Timers final : public AnyTimers {
public:
    [[nodiscard]] std::unique_ptr<AnyTimers> clone() const override {
        return std::make_unique<Timers>(*this);
    }
    bool hash_into(StateHash& hash) const override {
        if constexpr (Hashed<T>)
            for (const Entry& entry : entries_) {
                hash.add(static_cast<std::uint64_t>(entry.tick));
                hash.add(entry.message);
            }
        return Hashed<T>;
    }
    void move(const std::function<std::int64_t(std::int64_t)>& moved) override {
        for (Entry& entry : entries_) entry.tick = moved(entry.tick);
    }
    [[nodiscard]] std::string_view type() const override { return type_name<T>(); }

    void add(std::int64_t tick, T message) { entries_.push_back({tick, std::move(message)}); }
    /// Removes and returns the messages due at a tick: earliest first, then in order of adding.
    [[nodiscard]] std::vector<T> take_due(std::int64_t tick) {
        const auto due =
            std::stable_partition(entries_.begin(), entries_.end(),
                                  [&](const Entry& entry) { return entry.tick > tick; });
        std::stable_sort(due, entries_.end(),
                         [](const Entry& a, const Entry& b) { return a.tick < b.tick; });
        std::vector<T> messages;
        for (auto entry = due; entry != entries_.end(); ++entry)
            messages.push_back(std::move(entry->message));
        entries_.erase(due, entries_.end());
        return messages;
    }

private:
    struct Entry {
        std::int64_t tick;
        T message;
    };
    std::vector<Entry> entries_;
};

}  // namespace oiler
