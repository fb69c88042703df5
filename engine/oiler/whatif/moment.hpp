// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
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
        std::uint64_t number = entity.id();  ///< see World::number
    };
    std::int64_t cuts = 0;
    bool quits = false;
    std::vector<Placed> bodies{};  ///< in the order of their numbers
    std::vector<Reading> readings{};
};

[[nodiscard]] Moment moment_of(const AnyGame& game);

/// Whether bodies, teleports, restarts and whole-number readings are the same.
[[nodiscard]] bool is_same_play(const Moment& a, const Moment& b);

/// Names a body of a play, or of the true one.
using NameOfEither = std::function<std::string(Entity, bool is_of_truth)>;

/// Names the first difference of a play from the true one: "coins 2, true 3", "ball is only in the
/// true motion". Empty if they are the same play.
[[nodiscard]] std::string describe_difference(const Moment& play, const Moment& truth,
                                              const NameOfEither& name_of);

/// Pairs of the bodies that both have and that were teleported equally often.
[[nodiscard]] std::vector<std::pair<const Moment::Placed*, const Moment::Placed*>> same_bodies(
    const Moment& a, const Moment& b);

/// The bodies that only one has, and those that were teleported more often in one.
[[nodiscard]] std::vector<Moment::Placed> different_bodies(const Moment& a, const Moment& b);

/// The bodies as drawn at `alpha` between two moments, without those that appeared or were
/// teleported meanwhile. All else is as in `after`.
[[nodiscard]] Moment between(const Moment& before, const Moment& after, double alpha);

/// The distance between the positions of a body in two plays.
struct Apart {
    double distance = 0;  ///< m
    Entity body{};
    bool is_same_play = true;  ///< whether all bodies and counts are the same, too
};
/// The same body with the largest distance in two plays; empty if they have none, or if only one
/// has restarted or ended.
[[nodiscard]] std::optional<Apart> largest_distance(const Moment& a, const Moment& b);
/// That of the bodies as drawn at `alpha` between two moments.
[[nodiscard]] std::optional<Apart> largest_distance(const Moment& truth, const Moment& before,
                                                    const Moment& after, double alpha);

/// The distance of a body from the same one as drawn at `alpha` between two moments; empty if one
/// of them has none.
[[nodiscard]] std::optional<Apart> distance_of(const Moment::Placed& body, const Moment& before,
                                               const Moment& after, double alpha);

/// The positions of a body in a run and in the reference at the same time, m.
struct Ghost {
    Entity body{};
    Vec3 at{};
    Vec3 truth{};

    [[nodiscard]] double distance() const { return length(truth - at); }
};

inline constexpr std::size_t most_ghosts = 100;

/// Ghosts of the bodies that both have and that were teleported equally often: at most
/// `most_ghosts`, those with the largest errors.
[[nodiscard]] std::vector<Ghost> ghosts_of(const Moment& run, const Moment& reference);

/// The ghosts with the largest errors, at most `most`.
[[nodiscard]] std::vector<Ghost> furthest(std::vector<Ghost> ghosts, std::size_t most);

}  // namespace oiler
