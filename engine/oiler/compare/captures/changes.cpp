// SPDX-License-Identifier: MIT
#include "oiler/compare/captures/changes.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
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
    match(
        matches, [](const Element& a, const Element& b) { return a == b; }, [](const Pair&) {});
    match(
        matches,
        [](const Element& a, const Element& b) { return a.key.object != 0 && a.key == b.key; },
        keep);
    match(
        matches,
        [](const Element& a, const Element& b) {
            return a.key.object == 0 && b.key.object == 0 && a.text == b.text;
        },
        keep);
    match(
        matches,
        [](const Element& a, const Element& b) {
            return a.key.object == 0 && b.key.object == 0 && a.points == b.points;
        },
        keep);
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

/// Sentences about one kind of elements, joined by semicolons.
class Report {
public:
    Report(const Kind& kind, std::string& words) : kind_(kind), words_(words) {}

    template <class Differs, class Describe>
    void add(const std::vector<Pair>& pairs, const Differs& differs, const Describe& describe) {
        std::vector<Pair> chosen;
        std::ranges::copy_if(pairs, std::back_inserter(chosen),
                             [&](const Pair& pair) { return differs(*pair.golden, *pair.actual); });
        if (!chosen.empty()) append(count_of(chosen.size(), kind_.name) + describe(chosen));
    }
    void add_unmatched(const std::vector<const Element*>& elements, const char* what) {
        if (elements.empty()) return;
        std::string names;
        for (const Element* element : elements)
            if (!element->text.empty() && names.size() < 60)
                names += fmt::format("{} '{}'", names.empty() ? ":" : ",", element->text);
        append(fmt::format("{} {}{}", count_of(elements.size(), kind_.name), what, names));
    }

    void append(const std::string& words) {
        if (!words_.empty()) words_ += "; ";
        words_ += words;
    }

private:
    const Kind& kind_;
    std::string& words_;
};

template <class Shape>
void compare_kind(const Kind& kind, const std::vector<Shape>& golden_shapes,
                  const std::vector<Shape>& actual_shapes, const Picture& golden,
                  const Picture& actual, float pixels_per_unit, std::string& words) {
    const std::vector<Element> before = elements_of(golden_shapes);
    const std::vector<Element> after = elements_of(actual_shapes);
    if (before == after) return;
    const Matches matches = match_all(before, after);
    Report report(kind, words);
    report.add_unmatched(matches.missing, "missing");
    report.add_unmatched(matches.added, "new");
    const auto has_as_many_points = [](const Element& a, const Element& b) {
        return a.points.size() == b.points.size();
    };
    report.add(
        matches.changed,
        [&](const Element& a, const Element& b) {
            return has_as_many_points(a, b) && a.points != b.points;
        },
        [&](const std::vector<Pair>& pairs) {
            float largest = 0;
            for (const Pair& pair : pairs)
                largest = std::max(
                    largest, shift_of(*pair.golden, *pair.actual, golden.camera, actual.camera));
            return fmt::format(" moved by at most {:.2g} px", largest * pixels_per_unit);
        });
    report.add(
        matches.changed,
        [&](const Element& a, const Element& b) { return !has_as_many_points(a, b); },
        [](const std::vector<Pair>& pairs) {
            return fmt::format(": {} → {} points", pairs[0].golden->points.size(),
                               pairs[0].actual->points.size());
        });
    report.add(
        matches.changed, [](const Element& a, const Element& b) { return a.extent != b.extent; },
        [&](const std::vector<Pair>& pairs) {
            return fmt::format(": {} {} → {}", kind.extent, pairs[0].golden->extent,
                               pairs[0].actual->extent);
        });
    report.add(
        matches.changed, [](const Element& a, const Element& b) { return a.colour != b.colour; },
        [](const std::vector<Pair>& pairs) {
            int largest = 0;
            for (const Pair& pair : pairs)
                largest =
                    std::max(largest, largest_channel(pair.golden->colour, pair.actual->colour));
            return fmt::format(" of another colour, by at most {}/255", largest);
        });
    report.add(
        matches.changed, [](const Element& a, const Element& b) { return a.text != b.text; },
        [](const std::vector<Pair>& pairs) {
            return fmt::format(": text '{}' → '{}'", pairs[0].golden->text, pairs[0].actual->text);
        });
    report.add(
        matches.changed,
        [](const Element& a, const Element& b) {
            return a.placing != b.placing || a.space != b.space;
        },
        [](const std::vector<Pair>&) { return std::string(" placed in another way"); });
    if (matches.missing.empty() && matches.added.empty() && matches.changed.empty())
        report.append(fmt::format("{}s in another order", kind.name));
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

std::string describe_picture_change(const Picture& golden, const Picture& actual, Size size) {
    std::string words;
    if (golden.background != actual.background)
        words = fmt::format("background of another colour, by at most {}/255",
                            largest_channel(golden.background, actual.background));
    const Camera& before = golden.camera;
    const Camera& after = actual.camera;
    const auto separator = [&] { return words.empty() ? "" : "; "; };
    if (before.centre != after.centre)
        words += fmt::format("{}camera: centre ({}, {}) → ({}, {})", separator(), before.centre.x,
                             before.centre.y, after.centre.x, after.centre.y);
    if (before.height != after.height)
        words +=
            fmt::format("{}camera: height {} → {} m", separator(), before.height, after.height);
    const float pixels_per_unit = std::min(static_cast<float>(size.width) / canvas_width,
                                           static_cast<float>(size.height) / canvas_height);
    if (golden.has_bars != actual.has_bars)
        words += fmt::format("{}bars beside the canvas {}", separator(),
                             actual.has_bars ? "new" : "missing");
    compare_kind(sprite_kind, golden.sprites, actual.sprites, golden, actual, pixels_per_unit,
                 words);
    compare_kind(polygon_kind, golden.polygons, actual.polygons, golden, actual, pixels_per_unit,
                 words);
    compare_kind(line_kind, golden.polylines, actual.polylines, golden, actual, pixels_per_unit,
                 words);
    compare_kind(disc_kind, golden.discs, actual.discs, golden, actual, pixels_per_unit, words);
    compare_kind(label_kind, golden.labels, actual.labels, golden, actual, pixels_per_unit, words);
    return words;
}

}  // namespace oiler
