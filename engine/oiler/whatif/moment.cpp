// SPDX-License-Identifier: MIT
#include "oiler/whatif/moment.hpp"

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
    const auto same_count = [](const Reading& one, const Reading& other) {
        const bool counts = is_whole(one.value) && is_whole(other.value);
        return one.name == other.name && (!counts || one.value == other.value);
    };
    return a.cuts == b.cuts && a.quits == b.quits &&
           std::ranges::equal(a.bodies, b.bodies, is_same_body) &&
           std::ranges::equal(a.readings, b.readings, same_count);
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
