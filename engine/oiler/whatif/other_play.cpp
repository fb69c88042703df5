// SPDX-License-Identifier: MIT
#include "oiler/whatif/other_play.hpp"

#include <algorithm>
#include <utility>

namespace oiler {
namespace {

constexpr double lasting_difference = 0.25;  // s

/// The moment with that body alone, if it has it.
Moment only(const Moment& moment, Entity body) {
    const auto found = std::ranges::find(moment.bodies, body, &Moment::Placed::entity);
    return {.bodies = {found, found == moment.bodies.end() ? found : found + 1}};
}

Moment without_bodies(const Moment& moment) {
    return {.cuts = moment.cuts, .quits = moment.quits, .readings = moment.readings};
}

}  // namespace

double OtherPlay::since() const {
    double first = rest_ ? rest_->from : std::numeric_limits<double>::infinity();
    for (const auto& [id, one] : bodies_) first = std::min(first, one.from);
    return first;
}

std::optional<OtherPlay::Found> OtherPlay::compare(
    const Moment& play, const Moment& truth, double time, double late,
    const std::function<std::string(Entity)>& name_of) {
    const std::string rest =
        describe_difference(without_bodies(play), without_bodies(truth), name_of);
    if (rest.empty())
        rest_.reset();
    else if (!rest_)
        rest_ = Found{time, rest};
    compare_bodies(play, truth, time);
    const double lasts_since = time - lasting_difference - late;
    if (rest_ && rest_->from <= std::min(lasts_since, since())) return rest_;
    const auto first =
        std::ranges::min_element(bodies_, {}, [](const auto& entry) { return entry.second.from; });
    if (first == bodies_.end() || first->second.from > lasts_since) return std::nullopt;
    const auto& [body, from] = first->second;
    return Found{from, describe_difference(only(play, body), only(truth, body), name_of)};
}

void OtherPlay::compare_bodies(const Moment& play, const Moment& truth, double time) {
    const auto before = std::exchange(bodies_, {});
    for (const Entity body : different_bodies(play, truth)) {
        const auto known = before.find(body.id());
        bodies_.emplace(body.id(), known == before.end() ? Different{body, time} : known->second);
    }
}

}  // namespace oiler
