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
    return one.number == other.number && one.jumps == other.jumps;
}

bool is_same_count(const Reading& one, const Reading& other) {
    const bool counts = is_whole(one.value) && is_whole(other.value);
    return one.name == other.name && (!counts || one.value == other.value);
}

bool is_same_round(const Moment& a, const Moment& b) {
    return a.cuts == b.cuts && a.quits == b.quits;
}

bool have_same_counts(const Moment& a, const Moment& b) {
    return std::ranges::equal(a.readings, b.readings, is_same_count);
}

/// "coins 2, true 3"
std::string two_counts(const std::string& name, double play, double truth) {
    return fmt::format("{} {:g}, true {:g}", name, play, truth);
}

/// Names the first body that only one of two plays has, or that was teleported more often in one.
std::string describe_bodies(const Moment& play, const Moment& truth, const NameOfEither& name_of) {
    const auto find = [](const Moment& in, const Moment::Placed& body) {
        return std::ranges::find(in.bodies, body.number, &Moment::Placed::number);
    };
    for (const Moment::Placed& body : play.bodies) {
        const auto other = find(truth, body);
        const auto name = [&] { return name_of(body.entity, false); };
        if (other == truth.bodies.end()) return name() + " is not in the true motion";
        if (other->jumps != body.jumps)
            return two_counts("teleports of " + name() + ":", body.jumps, other->jumps);
    }
    for (const Moment::Placed& body : truth.bodies)
        if (find(play, body) == play.bodies.end())
            return name_of(body.entity, true) + " is only in the true motion";
    return "";
}

/// Null if the moment has none.
const Moment::Placed* same_body(const Moment& moment, const Moment::Placed& body) {
    const auto found =
        std::ranges::lower_bound(moment.bodies, body.number, {}, &Moment::Placed::number);
    return found != moment.bodies.end() && is_same_body(*found, body) ? &*found : nullptr;
}

/// Finds the bodies of a moment in the order of their numbers.
class SameBody {
public:
    explicit SameBody(const Moment& moment)
        : next_(moment.bodies.data()), end_(next_ + moment.bodies.size()) {}

    /// Null if there is none.
    const Moment::Placed* of(const Moment::Placed& body) {
        while (next_ != end_ && next_->number < body.number) ++next_;
        return next_ != end_ && is_same_body(*next_, body) ? next_ : nullptr;
    }

private:
    const Moment::Placed* next_;
    const Moment::Placed* end_;
};

Vec3 place(const Moment::Placed& from, const Moment::Placed& to, double alpha) {
    return from.position + (to.position - from.position) * alpha;
}

}  // namespace

Moment moment_of(const AnyGame& game) {
    const World& world = game.world();
    Moment moment{.cuts = game.cuts(), .quits = game.loop().quits()};
    moment.bodies.reserve(world.body_count());
    for (std::size_t row = 0; row < world.body_count(); ++row) {
        const Entity entity = world.entity_of_row(row);
        moment.bodies.push_back(
            {entity, world.jumps(entity), world.position_of_row(row), world.number(entity)});
    }
    if (!std::ranges::is_sorted(moment.bodies, {}, &Moment::Placed::number))
        std::ranges::sort(moment.bodies, {}, &Moment::Placed::number);
    moment.readings = game.readings();
    return moment;
}

bool is_same_play(const Moment& a, const Moment& b) {
    return is_same_round(a, b) && have_same_counts(a, b) &&
           std::ranges::equal(a.bodies, b.bodies, is_same_body);
}

std::string describe_difference(const Moment& play, const Moment& truth,
                                const NameOfEither& name_of) {
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
    SameBody other(b);
    for (const Moment::Placed& body : a.bodies)
        if (const Moment::Placed* const same = other.of(body)) pairs.emplace_back(&body, same);
    return pairs;
}

std::vector<Moment::Placed> different_bodies(const Moment& a, const Moment& b) {
    std::vector<Moment::Placed> different;
    const auto add_missing = [&](const Moment& from, const Moment& to) {
        SameBody other(to);
        for (const Moment::Placed& body : from.bodies)
            if (!other.of(body)) different.push_back(body);
    };
    add_missing(a, b);
    add_missing(b, a);
    return different;
}

Moment between(const Moment& before, const Moment& after, double alpha) {
    Moment drawn = after;
    drawn.bodies.clear();
    for (const auto& [from, to] : same_bodies(before, after))
        drawn.bodies.push_back({to->entity, to->jumps, place(*from, *to, alpha), to->number});
    return drawn;
}

std::optional<Apart> largest_distance(const Moment& a, const Moment& b) {
    return largest_distance(a, b, b, 1);
}

std::optional<Apart> largest_distance(const Moment& truth, const Moment& before,
                                      const Moment& after, double alpha) {
    if (!is_same_round(truth, after) || !is_same_round(before, after)) return std::nullopt;
    std::optional<Apart> largest;
    double largest_squared = 0;
    std::size_t compared = 0;
    SameBody from(before), real(truth);
    for (const Moment::Placed& to : after.bodies) {
        const Moment::Placed* const start = from.of(to);
        const Moment::Placed* const goal = real.of(to);
        if (!start || !goal) continue;
        ++compared;
        if (!largest) largest = Apart{0, to.entity};
        const Vec3 apart = goal->position - place(*start, to, alpha);
        const double squared = dot(apart, apart);
        if (!(squared > largest_squared)) continue;
        largest_squared = squared;
        largest = {std::hypot(apart[0], apart[1], apart[2]), to.entity};
    }
    if (largest)
        largest->is_same_play = compared == truth.bodies.size() &&
                                compared == before.bodies.size() &&
                                compared == after.bodies.size() && have_same_counts(truth, after) &&
                                have_same_counts(before, after);
    return largest;
}

std::optional<Apart> distance_of(const Moment::Placed& body, const Moment& before,
                                 const Moment& after, double alpha) {
    const Moment::Placed* const from = same_body(before, body);
    const Moment::Placed* const to = same_body(after, body);
    if (!from || !to) return std::nullopt;
    return Apart{length(place(*from, *to, alpha) - body.position), body.entity};
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
