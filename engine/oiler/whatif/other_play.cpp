// SPDX-License-Identifier: MIT
#include "oiler/whatif/other_play.hpp"

#include <algorithm>
#include <utility>

namespace oiler {
namespace {

constexpr double lasting_difference = 0.25;  // s

/// The moment with that body alone, if it has it.
Moment only(const Moment& moment, std::uint64_t number) {
    const auto found = std::ranges::find(moment.bodies, number, &Moment::Placed::number);
    return {.bodies = {found, found == moment.bodies.end() ? found : found + 1}};
}

Moment without_bodies(const Moment& moment) {
    return {.cuts = moment.cuts, .quits = moment.quits, .readings = moment.readings};
}

}  // namespace

double OtherPlay::since() const {
    double first = rest_ ? rest_->from : std::numeric_limits<double>::infinity();
    for (const auto& [number, from] : bodies_) first = std::min(first, from);
    return first;
}

std::optional<OtherPlay::Found> OtherPlay::compare(const Moment& play, const Moment& truth,
                                                   double time, double late,
                                                   const NameOfEither& name_of) {
    const std::string rest =
        describe_difference(without_bodies(play), without_bodies(truth), name_of);
    if (rest.empty())
        rest_.reset();
    else if (!rest_)
        rest_ = Found{time, rest};
    compare_bodies(play, truth, time);
    const double lasts_since = time - lasting_difference - late;
    if (rest_ && rest_->from <= std::min(lasts_since, since())) return rest_;
    for (const auto& [number, from] : bodies_)
        if (from == since() && from <= lasts_since)
            return Found{from,
                         describe_difference(only(play, number), only(truth, number), name_of)};
    return std::nullopt;
}

void OtherPlay::compare_bodies(const Moment& play, const Moment& truth, double time) {
    const auto before = std::exchange(bodies_, {});
    for (const Moment::Placed& body : different_bodies(play, truth)) {
        const auto known = before.find(body.number);
        bodies_.emplace(body.number, known == before.end() ? time : known->second);
    }
}

}  // namespace oiler
