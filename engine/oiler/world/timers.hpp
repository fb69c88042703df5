// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>
#include <memory>
#include <optional>
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

    void add(double time, T message, bool waits) {
        entries_.push_back({time, std::move(message), waits});
    }
    /// Lets those that wait be taken, too.
    void begin() {
        for (Entry& entry : entries_) entry.waits = false;
    }
    struct Due {
        double time;  ///< s
        T message;
    };
    /// Removes and returns the earliest message of time <= until that does not wait, of several the
    /// one that was added first.
    [[nodiscard]] std::optional<Due> take(double until) {
        auto first = entries_.end();
        for (auto entry = entries_.begin(); entry != entries_.end(); ++entry)
            if (!entry->waits && entry->time <= until &&
                (first == entries_.end() || entry->time < first->time))
                first = entry;
        if (first == entries_.end()) return std::nullopt;
        Due due{first->time, std::move(first->message)};
        entries_.erase(first);
        return due;
    }

private:
    struct Entry {
        double time;  ///< s
        T message;
        bool waits;  ///< for the next call of `due`
    };
    std::vector<Entry> entries_;
};

}  // namespace oiler
