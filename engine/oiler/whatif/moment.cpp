// SPDX-License-Identifier: MIT
#include "oiler/whatif/moment.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace oiler {
namespace {

bool is_whole(double value) { return std::trunc(value) == value; }

bool is_same_body(const Moment::Placed& one, const Moment::Placed& other) {
    return one.entity == other.entity && one.jumps == other.jumps;
}

bool is_same_count(const Reading& one, const Reading& other) {
    const bool counts = is_whole(one.value) && is_whole(other.value);
    return one.name == other.name && (!counts || one.value == other.value);
}

/// "coins 2, true 3"
std::string two_counts(const std::string& name, double play, double truth) {
    return fmt::format("{} {:g}, true {:g}", name, play, truth);
}

/// Names the first body that only one of two plays has, or that was teleported more often in one.
std::string describe_bodies(const Moment& play, const Moment& truth,
                            const std::function<std::string(Entity)>& name_of) {
    const auto find = [](const Moment& in, Entity entity) {
        return std::ranges::find(in.bodies, entity, &Moment::Placed::entity);
    };
    for (const Moment::Placed& body : play.bodies) {
        const auto other = find(truth, body.entity);
        if (other == truth.bodies.end()) return name_of(body.entity) + " is not in the true motion";
        if (other->jumps != body.jumps)
            return two_counts("teleports of " + name_of(body.entity) + ":", body.jumps,
                              other->jumps);
    }
    for (const Moment::Placed& body : truth.bodies)
        if (find(play, body.entity) == play.bodies.end())
            return name_of(body.entity) + " is only in the true motion";
    return "";
}

}  // namespace

Moment moment_of(const AnyGame& game) {
    const World& world = game.world();
    Moment moment{.cuts = game.cuts(), .quits = game.loop().quits()};
    for (std::size_t row = 0; row < world.body_count(); ++row) {
        const Entity entity = world.entity_of_row(row);
        moment.bodies.push_back({entity, world.jumps(entity), world.position_of_row(row)});
    }
    std::ranges::sort(moment.bodies, {},
                      [](const Moment::Placed& body) { return body.entity.id(); });
    moment.readings = game.readings();
    return moment;
}

bool is_same_play(const Moment& a, const Moment& b) {
    return a.cuts == b.cuts && a.quits == b.quits &&
           std::ranges::equal(a.bodies, b.bodies, is_same_body) &&
           std::ranges::equal(a.readings, b.readings, is_same_count);
}

std::string describe_difference(const Moment& play, const Moment& truth,
                                const std::function<std::string(Entity)>& name_of) {
    if (play.quits != truth.quits)
        return play.quits ? "the game ends, the true motion goes on" : "the true motion has ended";
    if (play.cuts != truth.cuts)
        return two_counts("restarts", static_cast<double>(play.cuts),
                          static_cast<double>(truth.cuts));
    const auto [own, other] = std::ranges::mismatch(play.readings, truth.readings, is_same_count);
    if (own != play.readings.end() && other != truth.readings.end() && own->name == other->name)
        return two_counts(own->name, own->value, other->value);
    if (own != play.readings.end() || other != truth.readings.end())
        return "the readings have other names";
    return describe_bodies(play, truth, name_of);
}

std::vector<std::pair<const Moment::Placed*, const Moment::Placed*>> same_bodies(const Moment& a,
                                                                                 const Moment& b) {
    std::vector<std::pair<const Moment::Placed*, const Moment::Placed*>> pairs;
    auto other = b.bodies.begin();
    for (const Moment::Placed& body : a.bodies) {
        while (other != b.bodies.end() && other->entity.id() < body.entity.id()) ++other;
        if (other != b.bodies.end() && is_same_body(body, *other))
            pairs.emplace_back(&body, &*other);
    }
    return pairs;
}

Moment between(const Moment& before, const Moment& after, double alpha) {
    Moment drawn = after;
    drawn.bodies.clear();
    for (const auto& [from, to] : same_bodies(before, after))
        drawn.bodies.push_back(
            {to->entity, to->jumps, from->position + (to->position - from->position) * alpha});
    return drawn;
}

std::optional<Apart> largest_distance(const Moment& a, const Moment& b) {
    if (!is_same_play(a, b)) return std::nullopt;
    Apart largest;
    for (std::size_t i = 0; i < a.bodies.size(); ++i) {
        const Vec3 apart = a.bodies[i].position - b.bodies[i].position;
        const double distance = std::hypot(apart[0], apart[1], apart[2]);
        if (distance > largest.distance) largest = {distance, a.bodies[i].entity};
    }
    return largest;
}

std::optional<Apart> distance_of(const Moment::Placed& body, const Moment& moment) {
    const auto same = std::ranges::find_if(
        moment.bodies, [&](const Moment::Placed& one) { return is_same_body(one, body); });
    if (same == moment.bodies.end()) return std::nullopt;
    return Apart{length(same->position - body.position), body.entity};
}

std::vector<Ghost> ghosts_of(const Moment& run, const Moment& reference) {
    std::vector<Ghost> ghosts;
    for (const auto& [body, truth] : same_bodies(run, reference))
        ghosts.push_back({body->entity, body->position, truth->position});
    return furthest(std::move(ghosts), most_ghosts);
}

std::vector<Ghost> furthest(std::vector<Ghost> ghosts, std::size_t most) {
    if (ghosts.size() <= most) return ghosts;
    std::ranges::nth_element(ghosts, ghosts.begin() + static_cast<std::ptrdiff_t>(most),
                             std::greater<>(), &Ghost::distance);
    ghosts.resize(most);
    return ghosts;
}

}  // namespace oiler
