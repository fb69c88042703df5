// SPDX-License-Identifier: MIT
// Scenes that the reader refuses: files in scene/bad, and for every key its wrong values and
// spellings.
#include <fmt/format.h>

#include "oiler/scene/keys.hpp"
#include "oiler/scene/read.hpp"
#include "scene/bad_files.hpp"
#include "scene/everything.hpp"
#include "support/oscillator.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

TEST(BadScenes, AreRefusedInOneLineWithFileLineAndKey) {
    const std::vector<BadFile> files = bad_files();
    EXPECT_GE(files.size(), 150U);
    for (const BadFile& file : files) {
        SCOPED_TRACE(file.path);
        const std::string line = line_of_error(Exit::usage, [&] { (void)read_scene(file.path); });
        const std::string place = file.path + ":" + std::to_string(file.line) + ": ";
        EXPECT_EQ(line.substr(0, place.size()), place) << line;
        EXPECT_TRUE(holds(line.substr(std::min(place.size(), line.size())), file.message)) << line;
        EXPECT_FALSE(holds(line, "\n"));
        EXPECT_LE(line.size(), file.path.size() + 400) << line;
    }
}

/// Values in TOML, each with the words of the message for it; a text, with the hint behind them.
using Values = std::vector<std::pair<std::string, std::string>>;

Values operator+(Values a, const Values& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}
Values texts(const std::vector<std::string>& texts) {
    Values values;
    for (const std::string& text : texts)
        values.emplace_back("\"" + text + "\"", "the text \"" + text + "\"");
    return values;
}
Values with_hint(const std::string& text, const std::string& meant) {
    return {{"\"" + text + "\"", "the text \"" + text + "\"; did you mean `" + meant + "`?"}};
}

const Values neither_number_nor_text{{"true", "true"},
                                     {"false", "false"},
                                     {"[]", "a list of 0"},
                                     {"[0.1]", "a list of 1"},
                                     {"[1.0, 0.0]", "a list of 2"},
                                     {"{}", "a table"},
                                     {"{ r = 1 }", "a table"},
                                     {"1979-05-27", "a date or a time"},
                                     {"07:32:00", "a date or a time"},
                                     {"1979-05-27T07:32:00Z", "a date or a time"}};
const Values no_number =
    neither_number_nor_text + texts({"", "1 kg", "0.0"}) +
    Values{{"nan", "nan"}, {"-nan", "nan"}, {"inf", "inf"}, {"+inf", "inf"}, {"-inf", "-inf"}};
/// Messages show up to 60 characters of a text.
const Values long_texts =
    texts({std::string(60, 'm')}) +
    Values{{"\"" + std::string(61, 'm') + "\"", "the text \"" + std::string(60, 'm') + "...\""}};
const Values below_0{{"-0.1", "-0.1"}, {"-2", "-2"}, {"-1e-300", "-1e-300"}};
const Values to_0 = below_0 + Values{{"0", "0"}, {"0.0", "0"}, {"-0.0", "-0"}};
const Values no_whole = no_number + Values{{"3.0", "3"}, {"-1", "-1"}};
const Values no_text =
    neither_number_nor_text + Values{{"7", "7"}, {"0x808080", "8421504"}, {"0.5", "0.5"}};
const Values no_colour = no_text + texts({"mauve", "#00g2b2", "#00f", "#0072b2ff", "#-072b2"}) +
                         with_hint("vermillion", "vermilion");
const Values no_vector = texts({"origin"}) + Values{{"0.0", "0"},
                                                    {"-9.81", "-9.81"},
                                                    {"true", "true"},
                                                    {"{ x = 0.0, y = 0.0 }", "a table"},
                                                    {"[]", "a list of 0"},
                                                    {"[0.0]", "a list of 1"},
                                                    {"[0.0, 0.0, 5.0]", "a list of 3"},
                                                    {"[0.0, 0.0, 0.0, 0.0]", "a list of 4"},
                                                    {"[[1.0, 2.0]]", "a list of 1"},
                                                    {"[nan, 0.0]", "nan"},
                                                    {"[-nan, 0.0]", "nan"},
                                                    {"[0.0, +inf]", "inf"},
                                                    {"[0.0, -inf]", "-inf"},
                                                    {"[\"0\", \"0\"]", "the text \"0\""},
                                                    {"[true, false]", "true"}};
const Values no_counts{{"6", "6"},
                       {"[]", "a list of 0"},
                       {"[3, 2, 2]", "a list of 3"},
                       {"[0, 2]", "0"},
                       {"[3, -2]", "-2"},
                       {"[3.0, 2.0]", "3"},
                       {"[1000000000, 1]", "1000000000"},
                       {"[\"3\", \"2\"]", "the text \"3\""}};
const Values no_points{{"0.5", "0.5"},
                       {"\"0, 1\"", "the text \"0, 1\""},
                       {"{}", "a table"},
                       {"[0.0, 1.0]", "0"},
                       {"[[0.0, 0.0], [1.0]]", "a list of 1"},
                       {"[[0.0, 0.0, 0.0], [1.0, 1.0, 1.0]]", "a list of 3"},
                       {"[[0.0, nan], [1.0, 1.0]]", "nan"},
                       {"[[0.0, 0.0], [\"1\", 1.0]]", "the text \"1\""}};
const Values no_lines{{"7", "7"},      {"true", "true"},         {"\"###\"", "the text \"###\""},
                      {"[1, 2]", "1"}, {"[\"##\", 0.5]", "0.5"}, {"[[\"##\"]]", "a list of 1"}};
const Values no_method = no_text + texts({""}) + with_hint("rk5", "rk4") +
                         with_hint("Velocity_Verlet", "velocity_verlet") +
                         with_hint("semi implicit euler", "semi_implicit_euler");

/// Keys that refuse the same values for the same reason.
struct Refusal {
    std::string expected;  ///< the words of the message
    std::string keys;
    Values values;
};

const std::string words_of_colour =
    "\"#rrggbb\" or one of black, orange, sky_blue, green, blue, vermilion, purple, ink, grey, "
    "pale, paper";
const Values too_long{{"1e10", "10000000000"}};
const Values too_fast{
    {"0", "0"}, {"1000001", "1000001"}, {"9223372036854775807", "9223372036854775807"}};
const Values too_many{{"0", "0"}, {"1000001", "1000001"}, {"1000000000", "1000000000"}};

const std::vector<Refusal> refusals{
    {"a text in quotes",
     "scene.title body.name spring.body spring.to wind.body drive.body plane.name "
     "obstacle.name chain.name tiles.name tiles.one_way",
     no_text},
    {"one of circle, box, segment", "obstacle.shape",
     no_text + texts({"ellipse", ""}) + with_hint("Circle", "circle")},
    {"a list of points, each a list of 2 numbers, for the 2 axes, in m", "chain.points", no_points},
    {"a list of texts in quotes",
     "tiles.rows plane.layers obstacle.layers chain.layers tiles.layers body.meets grid.meets "
     "scatter.meets",
     no_lines},
    {words_of_colour,
     "body.colour spring.colour attractor.colour plane.colour grid.colour scatter.colour "
     "obstacle.colour chain.colour tiles.colour view.background",
     no_colour},
    {"true or false", "spring.pulls_only grid.diagonals chain.closed obstacle.solid view.wind",
     texts({"yes"}) + Values{{"1", "1"}, {"[]", "a list of 0"}}},
    {"one of none, corners, top", "grid.hang",
     no_text + texts({"bottom"}) + with_hint("corner", "corners")},
    {"one of float, double", "scene.precision", no_text + texts({"half", "single", "long double"})},
    {"one of kick, drift", "scene.damping", no_text + texts({"none"})},
    {"a method that `oiler methods` lists", "scene.method", no_method},
    {"a list of one or two whole numbers from 1 to 1000000", "grid.count", no_counts},
    {"a whole number from 1 to 3", "scene.axes", no_whole + Values{{"0", "0"}, {"4", "4"}}},
    {"a whole number from 1 to 1000000, in 1/s", "scene.rate", no_whole + too_fast},
    {"a whole number from 1 to 1000000", "scatter.count", no_whole + too_many},
    {"a whole number from 0 to 9007199254740992", "scatter.seed",
     no_whole + Values{{"9223372036854775807", "9223372036854775807"}}},
    {"a list of 2 numbers, for the 2 axes, in m",
     "body.position spring.anchor attractor.position grid.origin scatter.position_from "
     "scatter.position_to camera.centre obstacle.centre obstacle.size obstacle.from obstacle.to "
     "obstacle.swing chain.swing tiles.origin",
     no_vector},
    {"a list of 2 numbers, for the 2 axes, in m/s",
     "body.velocity wind.velocity grid.velocity scatter.velocity_from scatter.velocity_to "
     "obstacle.velocity chain.velocity",
     no_vector},
    {"a list of 2 numbers, for the 2 axes, in m/s²", "gravity.acceleration", no_vector},
    {"a list of 2 numbers, for the 2 axes, in N", "drive.amplitude", no_vector},
    {"a list of 2 numbers, for the 2 axes", "plane.normal obstacle.one_way chain.one_way",
     no_vector},
    {"a number, in m", "plane.offset", no_number + long_texts},
    {"a number, in rad", "drive.phase obstacle.angle obstacle.phase chain.phase", no_number},
    {"a number, in m/s", "obstacle.belt chain.belt", no_number},
    {"a number above 0, in kg", "body.mass grid.mass scatter.mass", no_number + to_0},
    {"a number above 0, in m",
     "body.radius attractor.radius grid.spacing grid.radius scatter.radius budget.position_error "
     "obstacle.radius tiles.tile",
     no_number + to_0},
    {"a number above 0, in s", "obstacle.period chain.period view.trails", no_number + to_0},
    {"a number above 0, in m/s", "view.fastest", no_number + to_0},
    {"a number above 0, in m³/s²", "attractor.gm", no_number + to_0},
    {"a number above 0", "budget.energy_drift", no_number + to_0},
    {"a number above 0 to 1000000000, in s", "scene.duration", no_number + to_0 + too_long},
    {"a number from 1e-30 to 1e+30, in m", "camera.height",
     no_number + to_0 + Values{{"1e300", "1e+300"}}},
    {"a number from 0 to 1",
     "plane.restitution obstacle.restitution chain.restitution tiles.restitution",
     no_number + below_0 + Values{{"1.1", "1.1"}}},
    {"a number of at least 0", "plane.friction obstacle.friction chain.friction tiles.friction",
     no_number + below_0},
    {"a number of at least 0, in m",
     "body.contact spring.rest_length grid.rest_length grid.contact scatter.contact",
     no_number + below_0},
    {"a number of at least 0, in N/m", "spring.stiffness grid.stiffness", no_number + below_0},
    {"a number of at least 0, in N·s/m",
     "body.linear_drag spring.damping grid.linear_drag grid.damping scatter.linear_drag",
     no_number + below_0},
    {"a number of at least 0, in N·s²/m²",
     "body.quadratic_drag wind.drag grid.quadratic_drag scatter.quadratic_drag",
     no_number + below_0},
    {"a number of at least 0, in Hz", "drive.frequency", no_number + below_0},
};

std::vector<std::string> split(const std::string& text) {
    std::istringstream stream(text);
    return {std::istream_iterator<std::string>(stream), {}};
}

/// A key of a table: "body.mass".
struct Place {
    std::string table;
    std::string key;
    explicit Place(const std::string& name)
        : table(name.substr(0, name.find('.'))), key(name.substr(name.find('.') + 1)) {}
};

std::string error_of(const std::string& text) {
    return line_of_error(Exit::usage, [&] { (void)parse_scene(text, "test.toml"); });
}
/// The place of a key in `everything`: "test.toml:12: body.mass: ".
std::string place_of(const std::string& name, const std::string& text) {
    const auto same = std::ranges::mismatch(everything, text);
    return fmt::format("test.toml:{}: {}: ", 1 + std::count(everything.begin(), same.in1, '\n'),
                       name);
}

/// The example at the end of a message, behind "; for example " or ", for example ".
std::string example_in(const std::string& message, const std::string& key) {
    const std::string before = " for example " + key + " = ";
    const std::size_t at = message.rfind(before);
    EXPECT_NE(at, std::string::npos) << message;
    return at == std::string::npos ? "" : message.substr(at + before.size());
}

/// Expects an example that the reader takes; names of bodies may be unknown.
void expect_valid(const Place& place, const std::string& example) {
    if (example == "\"mass\"" || example == "\"other\"") return;
    EXPECT_NO_THROW((void)parse_scene(altered(everything, place.table, place.key, example), "x"))
        << place.table << "." << place.key << " = " << example;
}

// The escapes are the code points of Unicode. Escapes mean nothing in comments, keys and ''.
TEST(BadScenes, WithOtherCharactersHaveTheHintForTheirPlace) {
    const std::vector<std::pair<std::string, std::string>> texts{
        {"title = \"caf\u00e9\"", "byte 0xc3; expected ASCII text, in quotes \\u00e9"},
        {"title = \"# 5 \u20ac\"", "byte 0xe2; expected ASCII text, in quotes \\u20ac"},
        {"title = \"\U0001f600\"", "byte 0xf0; expected ASCII text, in quotes \\U0001f600"},
        {"title = \"\"\"a\n\\\"\u00e9\"\"\"", "byte 0xc3; expected ASCII text, in quotes \\u00e9"},
        {"title = 'caf\u00e9'", "byte 0xc3; expected ASCII text, in double quotes \\u00e9"},
        {"title = \"\u202e\"", "byte 0xe2; expected ASCII text, in quotes \\u202e"},
        {"title = \"\xe9\"", "byte 0xe9; expected ASCII text"},
        {"title = \"\a\"", "byte 0x07; expected ASCII text"},
        {"# caf\u00e9", "byte 0xc3; expected ASCII text, also in a comment"},
        {"title = \"a\" # \"caf\u00e9\"", "byte 0xc3; expected ASCII text, also in a comment"},
        {"# \xe9", "byte 0xe9; expected ASCII text, also in a comment"},
        {"caf\u00e9 = 1", "byte 0xc3; expected ASCII text"},
        {"rate = 6\u00a00", "byte 0xc2; expected ASCII text"}};
    for (const auto& [text, message] : texts) {
        const std::string error = error_of("[scene]\n" + text);
        EXPECT_EQ(error.substr(error.find(": ") + 2), message) << text;
    }
}

TEST(BadKeys, EveryKeyNamesWhatItExpectsAndWhatItGot) {
    int count = 0;
    for (const Refusal& refusal : refusals)
        for (const std::string& name : split(refusal.keys))
            for (const auto& [value, got] : refusal.values) {
                const Place place(name);
                const std::string text = altered(everything, place.table, place.key, value);
                const std::string error = error_of(text);
                const std::string example = example_in(error, place.key);
                EXPECT_EQ(error, place_of(name, text) + "expected " + refusal.expected + ", got " +
                                     got + "; for example " + place.key + " = " + example);
                expect_valid(place, example);
                ++count;
            }
    EXPECT_GE(count, 1000);
}

const std::string required =
    "scene.axes gravity.acceleration spring.body spring.stiffness wind.body wind.velocity "
    "wind.drag drive.body drive.amplitude drive.frequency attractor.gm plane.normal grid.count "
    "grid.spacing grid.stiffness scatter.count scatter.position_from scatter.position_to "
    "obstacle.shape chain.points tiles.tile tiles.rows";

TEST(BadKeys, EveryKeyOfTheTableIsTried) {
    std::map<std::string, int> tried;
    for (const Refusal& refusal : refusals)
        for (const std::string& name : split(refusal.keys)) ++tried[name];
    const std::vector<std::string> needed = split(required);
    for (const SceneKey& key : scene_keys()) {
        const std::string name = fmt::format("{}.{}", key.table, key.name);
        EXPECT_EQ(tried[name], 1) << name;
        EXPECT_EQ(std::ranges::count(needed, name), key.required() ? 1 : 0) << name;
    }
    EXPECT_EQ(tried.size(), scene_keys().size());
}

TEST(BadKeys, RequiredKeysAreReportedAsMissing) {
    for (const std::string& name : split(required)) {
        const Place place(name);
        const auto refusal = std::ranges::find_if(refusals, [&](const Refusal& one) {
            return std::ranges::count(split(one.keys), name) == 1;
        });
        const auto header = everything.find("[" + place.table + "]");
        const std::string error = error_of(altered(everything, place.table, place.key, ""));
        const std::string example = example_in(error, place.key);
        EXPECT_EQ(error,
                  fmt::format("test.toml:{}: {}: missing; [{}] needs {}, for example {} = {}",
                              1 + lines(everything.substr(0, header)), name, place.table,
                              refusal->expected, place.key, example));
        expect_valid(place, example);
    }
}

TEST(BadKeys, MisspeltKeysAreRefusedWithTheRightOne) {
    const std::vector<std::pair<std::string, std::string>> misspelt{
        {"scene", "titel title axis axes rates rate methode method percision precision"},
        {"scene", "durration duration dampin damping"},
        {"gravity", "accelaration acceleration"},
        {"body", "nam name maas mass positon position velocty velocity lineardrag linear_drag"},
        {"body",
         "quadratic-drag quadratic_drag contct contact meet meets raduis radius color colour"},
        {"spring", "bodyy body ancor anchor too to stifness stiffness dampening damping"},
        {"spring", "restlength rest_length color colour"},
        {"wind", "bdoy body velocitty velocity darg drag"},
        {"drive", "bod body amplitud amplitude frequenzy frequency phaze phase"},
        {"attractor", "postion position raduis radius color colour"},
        {"plane", "nmae name layer layers"},
        {"plane", "norml normal offsett offset restituton restitution frictoin friction"},
        {"obstacle", "nam name shap shape center centre raduis radius siz size angel angle"},
        {"obstacle", "fron from too to restituton restitution frictoin friction bellt belt"},
        {"obstacle", "velocitty velocity oneway one_way color colour"},
        {"obstacle", "swng swing preiod period phaze phase sold solid layer layers"},
        {"chain", "nmae name swng swing preiod period phaze phase layer layers"},
        {"chain", "point points close closed restituton restitution frictoin friction"},
        {"chain", "bellt belt velocitty velocity one-way one_way color colour"},
        {"tiles", "orgin origin tiles tile row rows oneway one_way restituton restitution"},
        {"tiles", "nmae name frictoin friction layer layers color colour"},
        {"grid", "cuont count orgin origin spaceing spacing velocitys velocity masss mass"},
        {"grid", "linear-drag linear_drag quadraticdrag quadratic_drag contacts contact"},
        {"grid", "stifness stiffness dampening damping restlength rest_length hangs hang"},
        {"grid", "diagonal diagonals meet meets raidus radius collour colour"},
        {"scatter", "cuont count sead seed positionfrom position_from positions_to position_to"},
        {"scatter", "velocity_form velocity_from velocityto velocity_to mas mass"},
        {"scatter", "linear_drug linear_drag quadratic_drak quadratic_drag contackt contact"},
        {"scatter", "meet meets radiuss radius colur colour"},
        {"camera", "center centre hight height"},
        {"view", "backgruond background trail trails fastes fastest winds wind"},
        {"budget", "positon_error position_error energydrift energy_drift"}};
    for (const auto& [table, words] : misspelt) {
        const std::vector<std::string> pairs = split(words);
        for (std::size_t i = 0; i < pairs.size(); i += 2) {
            const std::string& wrong = pairs[i];
            const std::string& right = pairs[i + 1];
            std::string text = altered(everything, table, right, "0");
            text.replace(text.find("\n" + right + " = 0\n") + 1, right.size(), wrong);
            EXPECT_EQ(error_of(text),
                      place_of(table + "." + wrong, text) +
                          fmt::format("[{}] has no such key; did you mean `{}`?", table, right));
        }
    }
    EXPECT_TRUE(holds(error_of(altered(everything, "attractor", "gm", "1.0\nGM = 1.0")),
                      ": attractor.GM: [attractor] has no such key; it has position, gm, radius"));
}

}  // namespace
}  // namespace oiler::test
