// SPDX-License-Identifier: MIT
#include "oiler/compare/captures/state_changes.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

#include "oiler/core/floating_point.hpp"

namespace oiler {
namespace {

constexpr std::array<std::string_view, 6> field_names{"x", "y", "z", "vx", "vy", "vz"};

double field(const BodyState& body, std::size_t index) {
    return index < 3 ? body.position[index] : body.velocity[index - 3];
}

bool is_unchanged(const BodyState& a, const BodyState& b) {
    for (std::size_t i = 0; i < field_names.size(); ++i)
        if (!has_same_bits(field(a, i), field(b, i))) return false;
    return true;
}

using ByName = std::map<std::string_view, const BodyState*>;

ByName by_name(const std::vector<BodyState>& bodies) {
    ByName named;
    for (const BodyState& body : bodies) named.emplace(body.name, &body);
    return named;
}

/// "body 'bob'", "body 'bob' and 2 more".
std::string list_of(const std::vector<std::string_view>& names) {
    const std::string first = fmt::format("body '{}'", names.front());
    return names.size() == 1 ? first : fmt::format("{} and {} more", first, names.size() - 1);
}

std::vector<std::string_view> names_missing_in(const ByName& there, const ByName& here) {
    std::vector<std::string_view> names;
    for (const auto& [name, body] : there)
        if (!here.contains(name)) names.push_back(name);
    return names;
}

/// "bodies 'a' and 'b' are swapped" if each has the other's state.
std::string describe_swap(const ByName& golden, const ByName& actual) {
    std::vector<std::string_view> changed;
    for (const auto& [name, body] : golden)
        if (!is_unchanged(*body, *actual.at(name))) changed.push_back(name);
    if (changed.size() != 2) return {};
    const auto& [a, b] = std::pair(changed[0], changed[1]);
    const bool swapped =
        is_unchanged(*golden.at(a), *actual.at(b)) && is_unchanged(*golden.at(b), *actual.at(a));
    return swapped ? fmt::format("bodies '{}' and '{}' are swapped", a, b) : "";
}

bool has_same_order(const std::vector<BodyState>& golden, const std::vector<BodyState>& actual) {
    return std::equal(golden.begin(), golden.end(), actual.begin(), actual.end(),
                      [](const BodyState& a, const BodyState& b) { return a.name == b.name; });
}

struct Change {
    std::string_view body;
    std::size_t field = 0;
    double golden = 0;
    double actual = 0;
    std::uint64_t ulps = 0;
};

Change largest_change(const ByName& golden, const ByName& actual, bool single) {
    Change largest;
    for (const auto& [name, body] : golden)
        for (std::size_t i = 0; i < field_names.size(); ++i) {
            const double before = field(*body, i);
            const double after = field(*actual.at(name), i);
            const std::uint64_t ulps =
                single ? ulps_between(static_cast<float>(before), static_cast<float>(after))
                       : ulps_between(before, after);
            const bool is_first = largest.body.empty() && !has_same_bits(before, after);
            if (is_first || ulps > largest.ulps) largest = {name, i, before, after, ulps};
        }
    return largest;
}

}  // namespace

std::string describe_state_change(const std::vector<BodyState>& golden,
                                  const std::vector<BodyState>& actual,
                                  std::string_view precision) {
    const ByName before = by_name(golden);
    const ByName after = by_name(actual);
    if (const auto gone = names_missing_in(before, after); !gone.empty())
        return list_of(gone) + (gone.size() == 1 ? " is missing" : " are missing");
    if (const auto added = names_missing_in(after, before); !added.empty())
        return list_of(added) + (added.size() == 1 ? " is new" : " are new");
    if (const std::string swap = describe_swap(before, after); !swap.empty()) return swap;
    const bool single = precision == "float";
    const Change change = largest_change(before, after, single);
    if (change.body.empty()) return has_same_order(golden, actual) ? "" : "bodies in another order";
    const auto digits = [&](double value) {
        return single ? fmt::format("{}", static_cast<float>(value)) : fmt::format("{}", value);
    };
    constexpr std::uint64_t most_ulps = 1'000'000;  // above, metres say more
    const std::string distance =
        change.ulps <= most_ulps
            ? fmt::format("{} ulp", change.ulps)
            : fmt::format("by {:.2g} {}", std::abs(change.actual - change.golden),
                          change.field < 3 ? "m" : "m/s");
    return fmt::format("body '{}', {}: {} → {}, {}", change.body, field_names[change.field],
                       digits(change.golden), digits(change.actual), distance);
}

}  // namespace oiler
