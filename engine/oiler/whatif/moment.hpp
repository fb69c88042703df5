// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "oiler/game/game.hpp"

namespace oiler {

/// The bodies and the readings of a game at one time, to compare two plays of it.
struct Moment {
    struct Placed {
        Entity entity;
        std::uint32_t jumps;
        Vec3 position;
    };
    std::int64_t cuts = 0;
    bool quits = false;
    std::vector<Placed> bodies{};  ///< in the order of their entities
    std::vector<Reading> readings{};
};

[[nodiscard]] Moment moment_of(const AnyGame& game);

/// Whether bodies, teleports, restarts and whole-number readings are the same.
[[nodiscard]] bool is_same_play(const Moment& a, const Moment& b);

/// The bodies that both have and that were teleported in neither or in both, in pairs.
[[nodiscard]] std::vector<std::pair<const Moment::Placed*, const Moment::Placed*>> same_bodies(
    const Moment& a, const Moment& b);

/// The bodies as they are drawn at `alpha` between two moments, those that neither appeared nor
/// were teleported meanwhile; the rest as it is after them.
[[nodiscard]] Moment between(const Moment& before, const Moment& after, double alpha);

/// A body that is away from where it is in another play.
struct Apart {
    double distance = 0;  ///< m
    Entity body{};
};
/// The body with the largest distance from that of the other play; empty if they are not the same
/// play.
[[nodiscard]] std::optional<Apart> largest_distance(const Moment& a, const Moment& b);

/// A body where a run has it, and where the reference has it at the same time, m.
struct Ghost {
    Entity body{};
    Vec3 at{};
    Vec3 truth{};

    [[nodiscard]] double distance() const { return length(truth - at); }
};

inline constexpr std::size_t most_ghosts = 100;

/// The bodies of a run that the reference has, too, unless they were teleported in one of the two.
/// If there are more than `most_ghosts`, those with the largest errors are kept.
[[nodiscard]] std::vector<Ghost> ghosts_of(const Moment& run, const Moment& reference);

/// The ghosts with the largest errors, at most so many.
[[nodiscard]] std::vector<Ghost> furthest(std::vector<Ghost> ghosts, std::size_t most);

}  // namespace oiler
