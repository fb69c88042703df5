// SPDX-License-Identifier: MIT
#include "oiler/compare/captures/changes.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "oiler/core/floating_point.hpp"
#include "oiler/core/state_hash.hpp"

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

template <class State>
using StatesByName = std::map<std::string_view, const State*>;
using ByName = StatesByName<BodyState>;

template <class State>
StatesByName<State> by_name(const std::vector<State>& states) {
    StatesByName<State> named;
    for (const State& state : states) named.emplace(state.name, &state);
    return named;
}

/// "body 'bob'", "body 'bob' and 2 more".
std::string list_of(std::string_view kind, const std::vector<std::string_view>& names) {
    const std::string first = fmt::format("{} '{}'", kind, names.front());
    return names.size() == 1 ? first : fmt::format("{} and {} more", first, names.size() - 1);
}

template <class State>
std::vector<std::string_view> names_missing_in(const StatesByName<State>& there,
                                               const StatesByName<State>& here) {
    std::vector<std::string_view> names;
    for (const auto& [name, state] : there)
        if (!here.contains(name)) names.push_back(name);
    return names;
}

/// "body 'bob' is missing", "obstacle 'lift' and 2 more are new"; empty if both have all names.
template <class State>
std::string describe_others(std::string_view kind, const StatesByName<State>& before,
                            const StatesByName<State>& after) {
    if (const auto gone = names_missing_in(before, after); !gone.empty())
        return list_of(kind, gone) + (gone.size() == 1 ? " is missing" : " are missing");
    if (const auto added = names_missing_in(after, before); !added.empty())
        return list_of(kind, added) + (added.size() == 1 ? " is new" : " are new");
    return {};
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
    return std::ranges::equal(golden, actual, {}, &BodyState::name, &BodyState::name);
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

/// "obstacle 'lift', y: 2 → 2.5" for its first number that differs.
std::string change_of(const ObstacleState& golden, const ObstacleState& actual) {
    if (golden.shape != actual.shape)
        return fmt::format("obstacle '{}': {} → {}", golden.name, golden.shape, actual.shape);
    std::map<std::string_view, std::pair<double, double>> numbers;
    for (const auto& [name, number] : golden.numbers) numbers[name].first = number;
    for (const auto& [name, number] : actual.numbers) numbers[name].second = number;
    for (const auto& [name, pair] : numbers)
        if (!has_same_bits(pair.first, pair.second))
            return fmt::format("obstacle '{}', {}: {} → {}", golden.name, name, pair.first,
                               pair.second);
    return {};
}

/// The numbers of an element that are compared, whatever its kind is.
struct Element {
    ElementKey key;
    Space space = Space::world;
    Colour colour;
    std::vector<Point> points;
    float extent = 0;  ///< width, radius or size
    std::string text{};
    int placing = 0;  ///< layer, alignment and the like
    friend bool operator==(const Element&, const Element&) = default;
};

struct Kind {
    const char* name;    ///< of one element
    const char* extent;  ///< name of its extent
};
constexpr Kind sprite_kind{"sprite", "angle"};
constexpr Kind polygon_kind{"polygon", "outline"};
constexpr Kind line_kind{"line", "width"};
constexpr Kind disc_kind{"disc", "radius"};
constexpr Kind label_kind{"label", "size"};

template <class Shape>
Element element_of(const Shape& shape, std::vector<Point> points, float extent) {
    return {.key = shape.key,
            .space = shape.space,
            .colour = shape.colour,
            .points = std::move(points),
            .extent = extent,
            .placing = shape.layer * 256};
}

Element element_of(const Sprite& sprite) {
    Element element = element_of(sprite, {sprite.centre, sprite.size}, sprite.angle);
    element.text = hash_text(sprite.bitmap ? sprite.bitmap->hash : 0);
    if (const auto& part = sprite.part)
        element.text += fmt::format(" {}x{} at ({}, {})", part->size.width, part->size.height,
                                    part->left, part->top);
    element.placing += sprite.is_smooth ? 1 : 0;
    return element;
}
Element element_of(const Polygon& polygon) {
    Element element = element_of(polygon, polygon.points, polygon.outline);
    const Colour outline = polygon.outline_colour;
    if (outline != Colour{})
        element.text = fmt::format("outline #{:02x}{:02x}{:02x}{:02x}", outline.r, outline.g,
                                   outline.b, outline.a);
    return element;
}
Element element_of(const Polyline& line) { return element_of(line, line.points, line.width); }
Element element_of(const Disc& disc) { return element_of(disc, {disc.centre}, disc.radius); }
Element element_of(const Label& label) {
    Element element = element_of(label, {label.at}, label.size);
    element.text = label.text;
    element.placing += static_cast<int>(label.align) + 16 * static_cast<int>(label.size_in);
    return element;
}

template <class Shape>
std::vector<Element> elements_of(const std::vector<Shape>& shapes) {
    std::vector<Element> elements;
    for (const Shape& shape : shapes) elements.push_back(element_of(shape));
    return elements;
}

struct Pair {
    const Element* golden;
    const Element* actual;
};

/// Elements of both pictures that correspond to each other and differ, and those without a partner.
struct Matches {
    std::vector<Pair> changed;
    std::vector<const Element*> missing;
    std::vector<const Element*> added;
};

/// Moves pairs that `belong` together from the unmatched elements to `take`.
template <class Belong, class Take>
void match(Matches& matches, const Belong& belong, const Take& take) {
    std::vector<const Element*> missing;
    for (const Element* golden : matches.missing) {
        const auto found = std::ranges::find_if(
            matches.added, [&](const Element* actual) { return belong(*golden, *actual); });
        if (found == matches.added.end()) {
            missing.push_back(golden);
            continue;
        }
        take(Pair{golden, *found});
        matches.added.erase(found);
    }
    matches.missing = std::move(missing);
}

/// Equal elements first, so that one missing label does not shift all others against each other.
Matches match_all(const std::vector<Element>& golden, const std::vector<Element>& actual) {
    Matches matches;
    for (const Element& element : golden) matches.missing.push_back(&element);
    for (const Element& element : actual) matches.added.push_back(&element);
    const auto keep = [&](const Pair& pair) { matches.changed.push_back(pair); };
    const auto is_equal = [](const Element& a, const Element& b) { return a == b; };
    const auto has_same_key = [](const Element& a, const Element& b) {
        return a.key.object != 0 && a.key == b.key;
    };
    const auto has_same = [](auto Element::*member) {
        return [member](const Element& a, const Element& b) {
            return a.key.object == 0 && b.key.object == 0 && a.*member == b.*member;
        };
    };
    match(matches, is_equal, [](const Pair&) {});
    match(matches, has_same_key, keep);
    match(matches, has_same(&Element::text), keep);
    match(matches, has_same(&Element::points), keep);
    return matches;
}

int largest_channel(Colour a, Colour b) {
    return std::max(
        {std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b), std::abs(a.a - b.a)});
}

/// Largest distance of corresponding points in units of the canvas.
float shift_of(const Element& golden, const Element& actual, const Camera& before,
               const Camera& after) {
    float largest = 0;
    for (std::size_t i = 0; i < golden.points.size(); ++i) {
        const bool world = golden.space == Space::world;
        const Point from = world ? before.to_canvas(golden.points[i]) : golden.points[i];
        const Point to = world ? after.to_canvas(actual.points[i]) : actual.points[i];
        largest = std::max(largest, std::hypot(to.x - from.x, to.y - from.y));
    }
    return largest;
}

std::string count_of(std::size_t count, const char* name) {
    return fmt::format("{} {}{}", count, name, count == 1 ? "" : "s");
}

/// Sentences about the changes of a picture, kind by kind, joined by semicolons.
class PictureChanges {
public:
    PictureChanges(const Picture& golden, const Picture& actual, Size size)
        : golden_(golden),
          actual_(actual),
          pixels_per_unit_(std::min(static_cast<float>(size.width) / canvas_width,
                                    static_cast<float>(size.height) / canvas_height)) {}

    [[nodiscard]] std::string describe() {
        compare_views();
        compare(sprite_kind, &Picture::sprites);
        compare(polygon_kind, &Picture::polygons);
        compare(line_kind, &Picture::polylines);
        compare(disc_kind, &Picture::discs);
        compare(label_kind, &Picture::labels);
        return std::move(words_);
    }

private:
    void compare_views() {
        const Camera& before = golden_.camera;
        const Camera& after = actual_.camera;
        if (golden_.background != actual_.background)
            append(fmt::format("background of another colour, by at most {}/255",
                               largest_channel(golden_.background, actual_.background)));
        if (before.centre != after.centre)
            append(fmt::format("camera: centre ({}, {}) → ({}, {})", before.centre.x,
                               before.centre.y, after.centre.x, after.centre.y));
        if (before.height != after.height)
            append(fmt::format("camera: height {} → {} m", before.height, after.height));
        if (golden_.has_bars != actual_.has_bars)
            append(fmt::format("bars beside the canvas {}", actual_.has_bars ? "new" : "missing"));
    }

    template <class Shape>
    void compare(const Kind& kind, std::vector<Shape> Picture::*shapes) {
        const std::vector<Element> before = elements_of(golden_.*shapes);
        const std::vector<Element> after = elements_of(actual_.*shapes);
        if (before == after) return;
        const Matches matches = match_all(before, after);
        add_unmatched(kind, matches.missing, "missing");
        add_unmatched(kind, matches.added, "new");
        std::vector<Pair> comparable = matches.changed;
        std::erase_if(comparable, [](const Pair& pair) {
            return pair.golden->points.size() != pair.actual->points.size();
        });
        add(kind, comparable, &Element::points, [&](const std::vector<Pair>& pairs) {
            float largest = 0;
            for (const Pair& pair : pairs)
                largest = std::max(
                    largest, shift_of(*pair.golden, *pair.actual, golden_.camera, actual_.camera));
            return fmt::format(" moved by at most {:.2g} px", largest * pixels_per_unit_);
        });
        const auto point_count = [](const Element& element) { return element.points.size(); };
        add(kind, matches.changed, point_count, [&](const std::vector<Pair>& pairs) {
            return fmt::format(": {} → {} points", point_count(*pairs[0].golden),
                               point_count(*pairs[0].actual));
        });
        add(kind, matches.changed, &Element::extent, [&](const std::vector<Pair>& pairs) {
            return fmt::format(": {} {} → {}", kind.extent, pairs[0].golden->extent,
                               pairs[0].actual->extent);
        });
        add(kind, matches.changed, &Element::colour, [](const std::vector<Pair>& pairs) {
            int largest = 0;
            for (const Pair& pair : pairs)
                largest =
                    std::max(largest, largest_channel(pair.golden->colour, pair.actual->colour));
            return fmt::format(" of another colour, by at most {}/255", largest);
        });
        add(kind, matches.changed, &Element::text, [](const std::vector<Pair>& pairs) {
            return fmt::format(": text '{}' → '{}'", pairs[0].golden->text, pairs[0].actual->text);
        });
        const auto place = [](const Element& element) {
            return std::pair(element.placing, element.space);
        };
        add(kind, matches.changed, place,
            [](const std::vector<Pair>&) { return std::string(" placed in another way"); });
        if (matches.missing.empty() && matches.added.empty() && matches.changed.empty())
            append(fmt::format("{}s in another order", kind.name));
    }

    /// Describes the pairs whose elements differ in a property.
    template <class Property, class Describe>
    void add(const Kind& kind, const std::vector<Pair>& pairs, const Property& property,
             const Describe& describe) {
        std::vector<Pair> chosen = pairs;
        std::erase_if(chosen, [&](const Pair& pair) {
            return std::invoke(property, *pair.golden) == std::invoke(property, *pair.actual);
        });
        if (!chosen.empty()) append(count_of(chosen.size(), kind.name) + describe(chosen));
    }
    void add_unmatched(const Kind& kind, const std::vector<const Element*>& elements,
                       const char* what) {
        if (elements.empty()) return;
        std::string names;
        for (const Element* element : elements)
            if (!element->text.empty() && names.size() < 60)
                names += fmt::format("{} '{}'", names.empty() ? ":" : ",", element->text);
        append(fmt::format("{} {}{}", count_of(elements.size(), kind.name), what, names));
    }
    void append(const std::string& words) {
        if (!words_.empty()) words_ += "; ";
        words_ += words;
    }

    const Picture& golden_;
    const Picture& actual_;
    float pixels_per_unit_;
    std::string words_;
};

}  // namespace

std::string describe_state_change(const std::vector<BodyState>& golden,
                                  const std::vector<BodyState>& actual,
                                  std::string_view precision) {
    const ByName before = by_name(golden);
    const ByName after = by_name(actual);
    if (std::string others = describe_others("body", before, after); !others.empty()) return others;
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

std::string describe_obstacle_change(const std::vector<ObstacleState>& golden,
                                     const std::vector<ObstacleState>& actual) {
    const auto before = by_name(golden);
    const auto after = by_name(actual);
    if (std::string others = describe_others("obstacle", before, after); !others.empty())
        return others;
    std::string first;
    std::size_t changed = 0;
    for (const ObstacleState& one : golden) {
        const std::string change = change_of(one, *after.at(one.name));
        if (!change.empty() && changed++ == 0) first = change;
    }
    return changed > 1 ? fmt::format("{}; {}", first, count_of(changed - 1, "more obstacle"))
                       : first;
}

std::string describe_picture_change(const Picture& golden, const Picture& actual, Size size) {
    return PictureChanges(golden, actual, size).describe();
}

}  // namespace oiler
