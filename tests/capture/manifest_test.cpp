// SPDX-License-Identifier: MIT
#include <bit>
#include <nlohmann/json.hpp>
#include <random>

#include "oiler/capture/frame_record.hpp"
#include "oiler/capture/manifest.hpp"
#include "oiler/picture/picture.hpp"
#include "support/folder.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

using Json = nlohmann::json;

/// No two fields have the same value.
Manifest manifest() {
    Manifest manifest{.version = "0.1.0",
                      .compiler = "g++ 12.2.0",
                      .provider = "osmesa",
                      .gl_renderer = "llvmpipe",
                      .gl_version = "3.3",
                      .size = {640, 360},
                      .fps = 30,
                      .rate = 100,
                      .method = "rk4",
                      .damping = "drift",
                      .precision = "float",
                      .scene = "a \"scene\"",
                      .scene_text = "[scene]\n# \xC3\xA9\n",
                      .seed = 18'446'744'073'709'551'615U,
                      .planned_frames = 3};
    for (int i = 0; i < 3; ++i)
        manifest.frames.push_back({.index = i,
                                   .file = i == 1 ? "" : "frame_" + std::to_string(i) + ".png",
                                   .tick = 2 * i,
                                   .alpha = 0.1 * i,
                                   .state_hash = 0xfedcba9876543210U + static_cast<unsigned>(i),
                                   .picture_hash = 16U + static_cast<unsigned>(i),
                                   .pixel_hash = 0xffffffffffffff00U + static_cast<unsigned>(i),
                                   .tick_hashes = i == 2 ? "01ab23cd" : ""});
    return manifest;
}

/// The JSON has every field, see capture_test.
void expect_equal(const Manifest& a, const Manifest& b) { EXPECT_EQ(to_json(a), to_json(b)); }

/// The message about a damaged manifest, without the name of the file.
std::string refusal_of(const std::string& text) {
    const std::string line =
        line_of_error(Exit::usage, [&] { (void)parse_manifest(text, "some/manifest.json"); });
    EXPECT_TRUE(line.starts_with("some/manifest.json: ")) << line;
    EXPECT_TRUE(line.ends_with("; capture again")) << line;
    EXPECT_FALSE(holds(line, "\n"));
    return line.substr(line.find(": ") + 2);
}

TEST(Manifest, ReadsBack) {
    expect_equal(parse_manifest(to_json(manifest()), ""), manifest());
    Manifest unfinished = manifest();
    unfinished.frames.pop_back();
    expect_equal(parse_manifest(to_json(unfinished), ""), unfinished);
    Manifest bare = manifest();
    bare.frames.clear();
    bare.damping = bare.scene_text = "";
    expect_equal(parse_manifest(to_json(bare), ""), bare);
}

TEST(Manifest, ReadsTheFolderAndTheFile) {
    const Folder folder;
    put(folder / "manifest.json", to_json(manifest()));
    expect_equal(read_manifest(folder.path()), manifest());
    expect_equal(read_manifest(folder / "manifest.json"), manifest());
    for (const char* none : {"none", "none/manifest.json"})
        EXPECT_TRUE(holds(line_of_error(Exit::usage, [&] { (void)read_manifest(folder / none); }),
                          (folder / none).string()));
}

/// Values that no field of the manifest may have, or only fields of another type.
const std::vector<Json> wrong_values{nullptr,       true,          -1, 0.5, 1e300, "", "text",
                                     Json::array(), Json::object()};

/// Values that a field may have besides its own.
bool may_be(const std::string& field, const Json& value) {
    const auto is_one_of = [&](const char* fields) { return holds(fields, " " + field + " "); };
    if (value.is_string())
        return is_one_of(" version compiler provider gl_renderer gl_version method scene ") ||
               is_one_of(" scene_text file ");
    if (value.is_null()) return is_one_of(" damping scene_text file ");
    return (field == "alpha" && value == 0.5) || (field == "frames" && value.is_array());
}

TEST(Manifest, NamesEachDamagedFieldOfTheHeader) {
    const Json good = Json::parse(to_json(manifest()));
    for (const auto& [field, value] : good.items()) {
        Json damaged = good;
        damaged.erase(field);
        EXPECT_TRUE(refusal_of(damaged.dump()).starts_with(field + ": expected ")) << field;
        for (const Json& wrong : wrong_values) {
            if (may_be(field, wrong) || wrong == value) continue;
            damaged = good;
            damaged[field] = wrong;
            const std::string line = refusal_of(damaged.dump());
            EXPECT_TRUE(line.starts_with(field + ": expected ")) << field << " = " << wrong;
            EXPECT_TRUE(holds(line, ", got " + wrong.dump() + ";"));
        }
    }
}

TEST(Manifest, NamesEachDamagedFieldOfAFrame) {
    const Json good = Json::parse(to_json(manifest()));
    for (const auto& [field, value] : good.at("frames")[2].items()) {
        const std::string start = "frame 2: " + field + ": expected ";
        Json damaged = good;
        damaged["frames"][2].erase(field);
        if (field != "tick_hashes") {
            EXPECT_TRUE(refusal_of(damaged.dump()).starts_with(start)) << field;
        }
        for (const Json& wrong : wrong_values) {
            if (may_be(field, wrong) || wrong == value) continue;
            damaged = good;
            damaged["frames"][2][field] = wrong;
            EXPECT_TRUE(refusal_of(damaged.dump()).starts_with(start)) << field << " = " << wrong;
        }
    }
}

struct Damage {
    const char* pointer;
    Json value;
    const char* line;
};

TEST(Manifest, RefusesValuesOutOfRange) {
    const std::vector<Damage> damages{
        {"/width", 0, "width: expected a whole number from 1 to 1000000, got 0;"},
        {"/height", 1'000'001, "height: expected a whole number from 1 to 1000000, got 1000001;"},
        {"/fps", 18'446'744'073'709'551'615U, "fps: expected a whole number from 1 to 1000000, "},
        {"/rate", 0, "rate: expected "},
        {"/planned_frames", 4, "finished: expected false, because 3 of 4 frames are listed, got "},
        {"/planned_frames", 2, "finished: expected false, because 3 of 2 frames are listed, got "},
        {"/finished", false, "finished: expected true, because 3 of 3 frames are listed, got "},
        {"/precision", "quad", "precision: expected \"float\" or \"double\", got \"quad\";"},
        {"/damping", "kicks", "damping: expected \"kick\" or \"drift\" or null, got \"kicks\";"},
        {"/seed", 1.0, "seed: expected "},
        {"/frames/1", 7, "frame 1: index: expected a whole number from 1 to 1, got nothing;"},
        {"/frames/1/index", 2, "frame 1: index: expected a whole number from 1 to 1, got 2;"},
        {"/frames/1/tick", 5, "frame 2: tick: expected a whole number from 5 to "},
        {"/frames/0/alpha", 1, "frame 0: alpha: expected a number from 0 to less than 1, got 1;"},
        {"/frames/0/file", "../x.png", "frame 0: file: expected the name of a file in the folder"},
        {"/frames/0/state_hash", "FEDCBA9876543210", "frame 0: state_hash: expected 16 hexadec"},
        {"/frames/0/pixel_hash", "fedcba987654321", "frame 0: pixel_hash: expected 16 hexadeci"},
        {"/frames/0/picture_hash", "0xdcba9876543210", "frame 0: picture_hash: expected 16 hex"},
        {"/frames/2/tick_hashes", "01ab23c", "frame 2: tick_hashes: expected 8 hexadecimal dig"},
        {"/frames/2/tick_hashes", "01ab23cx", "frame 2: tick_hashes: expected 8 hexadecimal di"},
    };
    for (const Damage& damage : damages) {
        Json json = Json::parse(to_json(manifest()));
        json[Json::json_pointer(damage.pointer)] = damage.value;
        const std::string line = refusal_of(json.dump());
        EXPECT_TRUE(line.starts_with(damage.line)) << damage.pointer << ": " << line;
    }
}

// A file that was cut off, and one with a byte of another value.
TEST(Manifest, RefusesDamagedText) {
    const std::string text = to_json(manifest());
    for (std::size_t end = 0; end + 2 < text.size(); end += 7)
        (void)refusal_of(text.substr(0, end));
    for (const char* other : {"[]", "3", "null", "\"\"", "{}", "{\"frames\": []}"})
        (void)refusal_of(other);
}

std::mt19937_64 bits{7};

/// A finite number of random bits.
template <class Real, class Bits>
Real number() {
    const Real value = std::bit_cast<Real>(static_cast<Bits>(bits()));
    return std::isfinite(value) ? value : Real{0};
}
float single() { return number<float, std::uint32_t>(); }
double twice() { return number<double, std::uint64_t>(); }

Colour colour() {
    const std::uint64_t b = bits();
    return {static_cast<std::uint8_t>(b), static_cast<std::uint8_t>(b >> 8U),
            static_cast<std::uint8_t>(b >> 16U), static_cast<std::uint8_t>(b >> 24U)};
}

ElementKey key() {
    return {bits(), static_cast<std::uint32_t>(bits()), static_cast<std::uint32_t>(bits())};
}

Space space() { return static_cast<Space>(bits() % 8); }

std::vector<Point> points(int count) {
    std::vector<Point> points;
    for (int i = 0; i < count; ++i) points.push_back({single(), single()});
    return points;
}

int layer() { return static_cast<int>(bits() % 5) - 2; }

std::optional<BitmapPart> part() {
    if (bits() % 2 == 0) return {};
    return BitmapPart{layer(), layer(), {layer(), layer()}};
}

/// Adds what plain pictures do not have.
void add_rich(Picture& picture) {
    picture.has_bars = bits() % 2 == 0;
    for (int i = 0; i < 3; ++i) {
        picture.sprites.push_back({.key = key(),
                                   .centre = {single(), single()},
                                   .size = {single(), single()},
                                   .bitmap = std::make_shared<const Bitmap>(
                                       Bitmap{.size = {}, .rgba = {}, .hash = bits()}),
                                   .angle = single(),
                                   .colour = colour(),
                                   .space = space(),
                                   .layer = layer(),
                                   .is_smooth = bits() % 2 == 0,
                                   .part = part()});
        picture.polygons.push_back(
            {key(), points(i), colour(), single(), colour(), space(), layer()});
        picture.polylines[0].layer = layer();
        picture.discs[1].layer = layer();
        picture.labels[2].layer = layer();
        picture.labels[1].size_in = space();
    }
}

Picture random_picture() {
    Picture picture{.background = colour(), .camera = {{single(), single()}, single()}};
    for (int i = 0; i < 4; ++i) {
        picture.polylines.push_back({key(), points(i), single(), colour(), space()});
        picture.discs.push_back({key(), {single(), single()}, single(), colour(), space()});
        picture.labels.push_back({key(),
                                  {single(), single()},
                                  "t = \xE2\x86\x92 \"\\\n" + std::to_string(bits()),
                                  single(),
                                  colour(),
                                  static_cast<Align>(bits() % 3),
                                  space()});
    }
    return picture;
}

FrameRecord random_record(std::int64_t index) {
    FrameRecord record{.index = index, .picture = random_picture()};
    for (int i = 0; i < 3; ++i)
        record.bodies.push_back({"body " + std::to_string(i),
                                 {twice(), twice(), twice()},
                                 {twice(), twice(), twice()}});
    return record;
}

TEST(FrameRecord, ReadsBackToTheSameBits) {
    std::string lines;
    std::vector<FrameRecord> written;
    for (int i = 0; i < 1000; ++i) {
        written.push_back(random_record(i));
        if (i % 2 == 0) add_rich(written.back().picture);
        lines += to_json(written.back());
    }
    const std::vector<FrameRecord> read = parse_frame_records(lines, "");
    ASSERT_EQ(read.size(), written.size());
    for (std::size_t i = 0; i < read.size(); ++i) {
        EXPECT_EQ(read[i].index, written[i].index);
        EXPECT_EQ(hash_of(read[i].picture), hash_of(written[i].picture)) << i;
        EXPECT_EQ(read[i].bodies, written[i].bodies);
        for (std::size_t body = 0; body < 3; ++body)
            for (std::size_t axis = 0; axis < 3; ++axis)
                EXPECT_EQ(std::signbit(read[i].bodies[body].velocity[axis]),
                          std::signbit(written[i].bodies[body].velocity[axis]));
    }
}

// As another reader of JSON sees it.
TEST(FrameRecord, IsALineOfJson) {
    FrameRecord record{.index = 5};
    record.bodies = {{"bob", {1, 2, 3}, {4, 5, -0.0}}};
    record.picture.labels = {{.at = {1, 2}, .text = "a", .align = Align::centre}};
    record.picture.polylines = {
        {.points = {{1, 2}, {3, 4.5F}}, .width = 0.1F, .space = Space::canvas}};
    const std::string line = to_json(record);
    EXPECT_EQ(lines(line), 1);
    EXPECT_EQ(line.back(), '\n');
    const Json json = Json::parse(line);
    EXPECT_EQ(json.at("frame"), 5);
    EXPECT_EQ(json.at("bodies"), Json::parse(R"([["bob", 1.0, 2.0, 3.0, 4.0, 5.0, -0.0]])"));
    EXPECT_EQ(json.at("picture").at("lines")[0].at("points"), (Json{1.0, 2.0, 3.0, 4.5}));
    EXPECT_EQ(json.at("picture").at("lines")[0].at("space"), "canvas");
    EXPECT_TRUE(holds(line, "\"width\":0.1,"));
    EXPECT_EQ(json.at("picture").at("labels")[0].at("align"), 1);
    EXPECT_EQ(json.at("picture").at("background"), (Json{255, 255, 255, 255}));
}

TEST(FrameRecord, HasObstaclesUnlessTheyAreTooMany) {
    FrameRecord record;
    EXPECT_FALSE(parse_frame_records(to_json(record), "").at(0).obstacles);
    record.obstacles = {{"lift", "box", {{"x", -0.0}, {"y", 0.1}, {"width", 1e300}}},
                        {"edge", "segment", {}}};
    const std::string line = to_json(record);
    EXPECT_TRUE(holds(line, R"({"name":"edge","shape":"segment"})"));
    const FrameRecord read = parse_frame_records(line, "").at(0);
    EXPECT_EQ(read.obstacles, record.obstacles);
    EXPECT_TRUE(std::signbit(read.obstacles->at(0).numbers.at("x")));
    record.obstacles.emplace();
    EXPECT_EQ(parse_frame_records(to_json(record), "").at(0).obstacles, record.obstacles);
}

// A game may draw a body that is infinitely far away: its captures can still be compared.
TEST(FrameRecord, NumbersThatAreNotFiniteReadBackAsNan) {
    const double infinity = std::numeric_limits<double>::infinity();
    FrameRecord record;
    record.bodies = {{"lost", {infinity, 1, 0}, {}}};
    record.picture.discs = {{.centre = {static_cast<float>(infinity), 3}, .radius = 2}};
    const FrameRecord read = parse_frame_records(to_json(record), "").at(0);
    EXPECT_TRUE(std::isnan(read.bodies[0].position[0]));
    EXPECT_EQ(read.bodies[0].position[1], 1);
    EXPECT_TRUE(std::isnan(read.picture.discs[0].centre.x));
    EXPECT_EQ(read.picture.discs[0].centre.y, 3);
}

TEST(FrameRecord, IsKeptUpToItsLimits) {
    Picture picture;
    EXPECT_TRUE(is_recordable(1000, picture));
    EXPECT_FALSE(is_recordable(1001, picture));
    picture.labels.resize(1);
    picture.discs.resize(2);
    picture.polylines.resize(2);
    picture.polylines[0].points.resize(9'997);
    picture.polylines[1].points.resize(10'000);
    EXPECT_TRUE(is_recordable(1000, picture));
    picture.discs.emplace_back();
    EXPECT_FALSE(is_recordable(0, picture));
    picture.discs.clear();
    picture.sprites.resize(1);
    picture.polygons = {{.points = {{}}}};
    EXPECT_TRUE(is_recordable(0, picture));
    picture.polygons[0].points.emplace_back();
    EXPECT_FALSE(is_recordable(0, picture));
    picture.polygons.clear();
    picture.sprites.resize(3);
    EXPECT_FALSE(is_recordable(0, picture));
}

void expect_refused(const std::string& lines) {
    const std::string line = line_of_error(
        Exit::usage, [&] { (void)parse_frame_records(lines, "some/frames.jsonl.gz"); });
    EXPECT_TRUE(line.starts_with("some/frames.jsonl.gz: ")) << line;
}

TEST(FrameRecord, DamagedLinesAreRefused) {
    const std::string good = to_json(random_record(0));
    for (std::size_t end = 1; end + 1 < good.size(); end += 3)
        expect_refused(good + good.substr(0, end));
    for (const char* bad : {"\n", "{}", "[]", "3", "{\"frame\":0}", "not json"})
        expect_refused(bad);
    const Json json = Json::parse(good);
    for (const Json& part : {json, json.at("picture"), json.at("picture").at("discs")[0]})
        for (const auto& [field, value] : part.items()) {
            std::string damaged = good;
            const std::string quoted = "\"" + field + "\":";
            damaged.replace(damaged.find(quoted), quoted.size(), "\"other\":");
            expect_refused(damaged);
        }
}

}  // namespace
}  // namespace oiler::test
