// SPDX-License-Identifier: MIT
#include "oiler/scene/keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <utility>

#include "oiler/core/require.hpp"
#include "oiler/scene/scene.hpp"

namespace oiler {
namespace {

using Words = std::vector<std::string_view>;

constexpr ValueRange any{};
constexpr ValueRange positive{.low = 0, .without_low = true};
constexpr ValueRange not_negative{.low = 0};

constexpr ValueRange from_to(double low, double high) { return {.low = low, .high = high}; }
constexpr ValueRange above_to(double low, double high) {
    return {.low = low, .high = high, .without_low = true};
}

Words method_words() {
    Words words;
    for (const Method& method : methods()) words.push_back(method.name);
    return words;
}
Words precision_words() { return {name_of(Precision::single), name_of(Precision::double_)}; }
Words damping_words() { return {name_of(Damping::in_kick), name_of(Damping::in_drift)}; }
Words hang_words() { return {"none", "corners", "top"}; }
Words shape_words() { return {"circle", "box", "segment"}; }

constexpr std::string_view required = "required";
constexpr std::string_view fits = "fits the start";
constexpr std::string_view of_round = "a circle and a box need it";
constexpr std::string_view all_layers = "all layers";
constexpr std::string_view of_meets = "layers of the obstacles that it meets";

using enum KeyKind;
constexpr double most = double{most_bodies};
/// Largest whole number that both TOML and a double hold, 2⁵³.
constexpr double largest_whole = 9007199254740992.0;

using enum SceneTable::Kind;
constexpr auto known_tables = std::to_array<SceneTable>({
    {"scene", once},
    {"gravity", once},
    {"body", repeated},
    {"spring", repeated},
    {"wind", force},
    {"drive", force},
    {"attractor", repeated},
    {"plane", repeated},
    {"obstacle", repeated},
    {"chain", repeated},
    {"tiles", repeated},
    {"grid", repeated},
    {"scatter", repeated},
    {"camera", once},
    {"view", once},
    {"budget", once},
});

constexpr std::array first_keys{
    SceneKey{"scene", "title", text, "", any, "\"\"", "", "title of the window, at most 200 bytes"},
    SceneKey{"scene", "axes", whole, "", from_to(1, 3), "2", required,
             "numbers in a vector; pictures show x and y"},
    SceneKey{"scene", "rate", whole, "1/s", from_to(1, 1e6), "100", "",
             "steps per second: dt = 1/rate"},
    SceneKey{"scene", "method", word, "", any, "\"semi_implicit_euler\"", "", "see `oiler methods`",
             method_words},
    SceneKey{"scene", "precision", word, "", any, "\"double\"", "",
             "number format of positions and velocities", precision_words},
    SceneKey{"scene", "damping", word, "", any, "\"drift\"", "the method's default",
             "where a splitting method puts linear damping: into its kicks or its drifts",
             damping_words},
    SceneKey{"scene", "duration", number, "s", above_to(0, 1e9), "10.0", "",
             "length of a run and of its film"},
    SceneKey{"gravity", "acceleration", vector, "m/s²", any, "[0.0, -9.81]", required,
             "the same for every body"},
    SceneKey{"body", "name", text, "", any, "\"mass\"", "no name",
             "springs refer to it, messages name it"},
    SceneKey{"body", "mass", number, "kg", positive, "1.0", "", ""},
    SceneKey{"body", "position", vector, "m", any, "[0.0, 0.0]", "", ""},
    SceneKey{"body", "velocity", vector, "m/s", any, "[0.0, 0.0]", "", ""},
    SceneKey{"body", "linear_drag", number, "N·s/m", not_negative, "0.0", "",
             "b of the force −b·v"},
    SceneKey{"body", "quadratic_drag", number, "N·s²/m²", not_negative, "0.0", "",
             "c of the force −c·|v|·v"},
    SceneKey{"body", "contact", number, "m", not_negative, "0.5", "passes through obstacles",
             "radius of its contact with obstacles; 0 for a point"},
    SceneKey{"body", "meets", lines, "", any, "[\"solid\"]", all_layers, of_meets},
    SceneKey{"body", "radius", number, "m", positive, "0.5",
             "`contact` above 0, else 1/40 of the camera's height", "of the disc in the picture"},
    SceneKey{"body", "colour", colour, "", any, "\"blue\"", "", "", colour_names},
    SceneKey{"spring", "body", text, "", any, "\"mass\"", required,
             "name of the body that the spring pulls"},
    SceneKey{"spring", "anchor", vector, "m", any, "[0.0, 0.0]", "`to` is given",
             "position of the fixed end"},
    SceneKey{"spring", "to", text, "", any, "\"other\"", "`anchor` is given",
             "name of the body at the other end"},
    SceneKey{"spring", "stiffness", number, "N/m", not_negative, "15.0", required, ""},
    SceneKey{"spring", "damping", number, "N·s/m", not_negative, "0.0", "",
             "in all directions; with a rest length only along the spring"},
    SceneKey{"spring", "rest_length", number, "m", not_negative, "0.0", "",
             "above 0 with `pulls_only`"},
    SceneKey{"spring", "pulls_only", flag, "", any, "false", "",
             "a rope: slack, without force and damping, up to its rest length"},
    SceneKey{"spring", "colour", colour, "", any, "\"grey\"", "", "", colour_names},
    SceneKey{"wind", "body", text, "", any, "\"mass\"", required, "name of the body in the wind"},
    SceneKey{"wind", "velocity", vector, "m/s", any, "[3.0, 0.0]", required, "w of the air"},
    SceneKey{"wind", "drag", number, "N·s²/m²", not_negative, "0.01", required,
             "c of the force −c·|v − w|·(v − w)"},
    SceneKey{"drive", "body", text, "", any, "\"mass\"", required, "name of the driven body"},
    SceneKey{"drive", "amplitude", vector, "N", any, "[5.0, 0.0]", required,
             "F of the force F·sin(2π·f·t + φ)"},
    SceneKey{"drive", "frequency", number, "Hz", not_negative, "2.0", required, "f"},
    SceneKey{"drive", "phase", number, "rad", any, "0.0", "", "φ"},
    SceneKey{"attractor", "position", vector, "m", any, "[0.0, 0.0]", "", ""},
    SceneKey{"attractor", "gm", number, "m³/s²", positive, "1.0", required,
             "attracts every body by gm/d²"},
    SceneKey{"attractor", "radius", number, "m", positive, "0.5", "1/40 of the camera's height",
             ""},
    SceneKey{"attractor", "colour", colour, "", any, "\"orange\"", "", "", colour_names},
};

/// A key of several tables of obstacles.
constexpr SceneKey name_key(std::string_view table, std::string_view example) {
    return {table, "name", text, "", any, example, "no name", "for messages"};
}
constexpr std::array<SceneKey, 2> bounce_keys(std::string_view table) {
    return {SceneKey{table, "restitution", number, "", from_to(0, 1), "0.0", "",
                     "part of the speed into it that a bounce gives back"},
            {table, "friction", number, "", not_negative, "0.0", "",
             "Coulomb's coefficient, in bounces and slides; a huge one means that nothing slides"}};
}
constexpr std::array<SceneKey, 6> motion_keys(std::string_view table) {
    return {SceneKey{table, "belt", number, "m/s", any, "0.0", "",
                     "speed of its surface, clockwise: on top to the right; with two axes"},
            {table, "velocity", vector, "m/s", any, "[0.0, 0.0]", "", "moves, and carries bodies"},
            {table, "swing", vector, "m", any, "[1.0, 0.0]", "does not swing",
             "moves by swing·sin(2π·t/period + phase), and carries bodies"},
            {table, "period", number, "s", positive, "1.0", "", "of the swing"},
            {table, "phase", number, "rad", any, "0.0", "", "of the swing"},
            {table, "one_way", vector, "", any, "[0.0, 1.0]", "met from all sides",
             "direction of the side from which bodies meet it, within 60°; they pass from other "
             "sides"}};
}
constexpr std::array<SceneKey, 2> last_keys(std::string_view table) {
    return {SceneKey{table, "layers", lines, "", any, "[\"solid\"]", "",
                     "names of its layers, of which a body must meet one"},
            {table, "colour", colour, "", any, "\"grey\"", "", "", colour_names}};
}

constexpr std::array plane_keys{
    name_key("plane", "\"floor\""),
    SceneKey{"plane", "normal", vector, "", any, "[0.0, 1.0]", required,
             "n, of any length; bodies stay on the side to which it points"},
    SceneKey{"plane", "offset", number, "m", any, "0.0", "", "the plane is where n·x = offset"},
};
constexpr std::array shape_keys{
    name_key("obstacle", "\"peg\""),
    SceneKey{"obstacle", "shape", word, "", any, "\"circle\"", required,
             "with three axes a circle is a sphere", shape_words},
    SceneKey{"obstacle", "centre", vector, "m", any, "[0.0, 0.0]", of_round, ""},
    SceneKey{"obstacle", "radius", number, "m", positive, "0.5", "a circle needs it", ""},
    SceneKey{"obstacle", "size", vector, "m", any, "[2.0, 1.0]", "a box needs it",
             "lengths of the sides, each above 0"},
    SceneKey{"obstacle", "angle", number, "rad", any, "0.0", "", "of a box, anticlockwise"},
    SceneKey{"obstacle", "from", vector, "m", any, "[0.0, 0.0]", "a segment needs it", "one end"},
    SceneKey{"obstacle", "to", vector, "m", any, "[1.0, 0.5]", "a segment needs it",
             "the other end; bodies with `contact = 0.0` pass segments"},
};
constexpr std::array solid_keys{
    SceneKey{"obstacle", "solid", flag, "", any, "true", "",
             "`false` is an area: bodies pass it, and impacts list when they enter and leave it"}};
constexpr std::array chain_keys{
    name_key("chain", "\"slope\""),
    SceneKey{"chain", "points", points, "m", any, "[[0.0, 0.0], [1.0, 0.5]]", required,
             "ends of its segments"},
    SceneKey{"chain", "closed", flag, "", any, "false", "",
             "adds a segment from the last point to the first one"},
};
constexpr std::array tiles_keys{
    name_key("tiles", "\"level\""),
    SceneKey{"tiles", "origin", vector, "m", any, "[0.0, 0.0]", "",
             "lower left corner of the last row"},
    SceneKey{"tiles", "tile", number, "m", positive, "1.0", required, "side of a tile"},
    SceneKey{"tiles", "rows", lines, "", any, "[\"#.=#\", \"####\"]", required,
             "the top row first; every character is a tile, except a space and a full stop"},
    SceneKey{"tiles", "one_way", text, "", any, "\"=\"", "no tile",
             "characters of `rows` whose tiles are met only from above"},
};

constexpr std::array other_keys{
    SceneKey{"grid", "count", counts, "", from_to(1, most), "[3, 2]", required,
             "bodies in a row, number of rows"},
    SceneKey{"grid", "origin", vector, "m", any, "[0.0, 0.0]", "",
             "position of the lower left body"},
    SceneKey{"grid", "spacing", number, "m", positive, "1.0", required,
             "distance between neighbours"},
    SceneKey{"grid", "velocity", vector, "m/s", any, "[0.0, 0.0]", "", "per body"},
    SceneKey{"grid", "mass", number, "kg", positive, "1.0", "", "per body"},
    SceneKey{"grid", "linear_drag", number, "N·s/m", not_negative, "0.0", "", "per body"},
    SceneKey{"grid", "quadratic_drag", number, "N·s²/m²", not_negative, "0.0", "", "per body"},
    SceneKey{"grid", "stiffness", number, "N/m", not_negative, "100.0", required, "per spring"},
    SceneKey{"grid", "damping", number, "N·s/m", not_negative, "0.0", "", "per spring"},
    SceneKey{"grid", "rest_length", number, "m", not_negative, "0.5", "the spacing",
             "per spring; diagonal springs have √2 times that"},
    SceneKey{"grid", "diagonals", flag, "", any, "false", "",
             "adds two diagonal springs to each cell"},
    SceneKey{"grid", "hang", word, "", any, "\"none\"", "",
             "anchored springs: none, at both ends of the top row, at the whole top row",
             hang_words},
    SceneKey{"grid", "contact", number, "m", not_negative, "0.5", "passes through obstacles",
             "per body; linked bodies land with order 1"},
    SceneKey{"grid", "meets", lines, "", any, "[\"solid\"]", all_layers, of_meets},
    SceneKey{"grid", "radius", number, "m", positive, "0.1",
             "`contact` above 0, else 1/200 of the camera's height", ""},
    SceneKey{"grid", "colour", colour, "", any, "\"blue\"", "", "", colour_names},
    SceneKey{"scatter", "count", whole, "", from_to(1, most), "3", required, "number of bodies"},
    SceneKey{"scatter", "seed", whole, "", from_to(0, largest_whole), "0", "",
             "a different seed, here or with `--seed`, gives different bodies"},
    SceneKey{"scatter", "position_from", vector, "m", any, "[-1.0, 0.0]", required, ""},
    SceneKey{"scatter", "position_to", vector, "m", any, "[1.0, 2.0]", required, ""},
    SceneKey{"scatter", "velocity_from", vector, "m/s", any, "[0.0, 0.0]", "", ""},
    SceneKey{"scatter", "velocity_to", vector, "m/s", any, "[3.0, 4.0]", "`velocity_from`", ""},
    SceneKey{"scatter", "mass", number, "kg", positive, "1.0", "", "per body"},
    SceneKey{"scatter", "linear_drag", number, "N·s/m", not_negative, "0.0", "", "per body"},
    SceneKey{"scatter", "quadratic_drag", number, "N·s²/m²", not_negative, "0.0", "", "per body"},
    SceneKey{"scatter", "contact", number, "m", not_negative, "0.5", "passes through obstacles",
             "per body"},
    SceneKey{"scatter", "meets", lines, "", any, "[\"solid\"]", all_layers, of_meets},
    SceneKey{"scatter", "radius", number, "m", positive, "0.1",
             "`contact` above 0, else 1/200 of the camera's height", ""},
    SceneKey{"scatter", "colour", colour, "", any, "\"sky_blue\"", "", "", colour_names},
    SceneKey{"camera", "centre", vector, "m", any, "[0.0, 0.0]", fits, "middle of the picture"},
    SceneKey{"camera", "height", number, "m", from_to(1e-30, 1e30), "10.0", fits,
             "metres from bottom to top"},
    SceneKey{"view", "background", colour, "", any, "\"paper\"", "", "", colour_names},
    SceneKey{"view", "trails", number, "s", positive, "2.0", "no trails",
             "the part of its path that follows each [[body]]; with one axis it moves down"},
    SceneKey{"view", "fastest", number, "m/s", positive, "30.0", "bodies have their own colours",
             "colours bodies by their speeds, from blue to orange at this one"},
    SceneKey{"view", "wind", flag, "", any, "true", "",
             "arrows that drift with the air, where all [[wind]] has one velocity"},
    SceneKey{"budget", "position_error", number, "m", positive, "1.0", "no limit",
             "largest error of the run, as drawn"},
    SceneKey{"budget", "energy_drift", number, "", positive, "0.01", "no limit",
             "largest change of the energy, relative to the largest kinetic energy or, if larger, "
             "to the range of the potential energy"},
};

template <std::size_t... Sizes>
constexpr auto joined(const std::array<SceneKey, Sizes>&... parts) {
    std::array<SceneKey, (Sizes + ...)> all{};
    auto to = all.begin();
    ((to = std::ranges::copy(parts, to).out), ...);
    return all;
}

constexpr auto known_keys =
    joined(first_keys, plane_keys, bounce_keys("plane"), last_keys("plane"), shape_keys,
           bounce_keys("obstacle"), motion_keys("obstacle"), solid_keys, last_keys("obstacle"),
           chain_keys, bounce_keys("chain"), motion_keys("chain"), last_keys("chain"), tiles_keys,
           bounce_keys("tiles"), last_keys("tiles"), other_keys);

constexpr std::array<std::pair<std::string_view, Colour>, 11> named{{
    {"black", palette::black},
    {"orange", palette::orange},
    {"sky_blue", palette::sky_blue},
    {"green", palette::green},
    {"blue", palette::blue},
    {"vermilion", palette::vermilion},
    {"purple", palette::purple},
    {"ink", palette::ink},
    {"grey", palette::grey},
    {"pale", palette::pale},
    {"paper", palette::paper},
}};

std::optional<Colour> from_hexadecimal(std::string_view text) {
    if (text.size() != 7 || text[0] != '#') return std::nullopt;
    std::uint32_t rgb = 0;
    const auto [last, error] = std::from_chars(text.begin() + 1, text.end(), rgb, 16);
    if (error != std::errc() || last != text.end()) return std::nullopt;
    return Colour{static_cast<std::uint8_t>(rgb >> 16U), static_cast<std::uint8_t>(rgb >> 8U),
                  static_cast<std::uint8_t>(rgb)};
}

std::string in_range(const ValueRange& range) {
    const bool below = range.low > any.low;
    const bool above = range.high < any.high;
    if (below && above)
        return fmt::format(" {} {:.16g} to {:.16g}", range.without_low ? "above" : "from",
                           range.low, range.high);
    if (below)
        return fmt::format(" {} {:g}", range.without_low ? "above" : "of at least", range.low);
    return "";
}

std::string numbers_of(int axes) {
    return axes == 1 ? "a list of one number, for the one axis"
                     : fmt::format("a list of {0} numbers, for the {0} axes", axes);
}

std::string kind_text(const SceneKey& key, int axes) {
    switch (key.kind) {
        case text:
            return "a text in quotes";
        case whole:
            return "a whole number" + in_range(key.range);
        case number:
            return "a number" + in_range(key.range);
        case flag:
            return "true or false";
        case vector:
            return numbers_of(axes);
        case points:
            return "a list of points, each " + numbers_of(axes);
        case lines:
            return "a list of texts in quotes";
        case counts:
            return "a list of one or two whole numbers" + in_range(key.range);
        case colour:
            return "\"#rrggbb\" or one of " + fmt::format("{}", fmt::join(key.words(), ", "));
        case word:
            break;
    }
    if (key.words == method_words) return "a method that `oiler methods` lists";
    return fmt::format("one of {}", fmt::join(key.words(), ", "));
}

}  // namespace

std::span<const SceneKey> scene_keys() { return known_keys; }

const SceneKey* find_scene_key(std::string_view table, std::string_view name) {
    const auto found = std::ranges::find_if(
        known_keys, [&](const SceneKey& key) { return key.table == table && key.name == name; });
    return found == known_keys.end() ? nullptr : &*found;
}

std::span<const SceneTable> scene_tables() { return known_tables; }

const SceneTable& scene_table(std::string_view name) {
    const auto found = std::ranges::find(known_tables, name, &SceneTable::name);
    require(found != known_tables.end(), "scene_tables() lacks a table that is read");
    return *found;
}

std::optional<Colour> find_colour(std::string_view text) {
    for (const auto& [name, colour] : named)
        if (name == text) return colour;
    return from_hexadecimal(text);
}

std::vector<std::string_view> colour_names() {
    std::vector<std::string_view> words;
    for (const auto& [name, colour] : named) words.push_back(name);
    return words;
}

std::string expectation(const SceneKey& key, int axes) {
    return kind_text(key, axes) + (key.unit.empty() ? "" : fmt::format(", in {}", key.unit));
}

}  // namespace oiler
