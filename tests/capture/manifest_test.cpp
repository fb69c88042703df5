// SPDX-License-Identifier: MIT
#include "oiler/capture/manifest.hpp"

#include <nlohmann/json.hpp>

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

void expect_equal(const Manifest& a, const Manifest& b) {
    EXPECT_EQ(to_json(a), to_json(b));
    EXPECT_EQ(a.version, b.version);
    EXPECT_EQ(a.compiler, b.compiler);
    EXPECT_EQ(a.provider, b.provider);
    EXPECT_EQ(a.gl_renderer, b.gl_renderer);
    EXPECT_EQ(a.gl_version, b.gl_version);
    EXPECT_EQ(a.size, b.size);
    EXPECT_EQ(a.fps, b.fps);
    EXPECT_EQ(a.rate, b.rate);
    EXPECT_EQ(a.method, b.method);
    EXPECT_EQ(a.damping, b.damping);
    EXPECT_EQ(a.precision, b.precision);
    EXPECT_EQ(a.scene, b.scene);
    EXPECT_EQ(a.scene_text, b.scene_text);
    EXPECT_EQ(a.seed, b.seed);
    EXPECT_EQ(a.planned_frames, b.planned_frames);
    ASSERT_EQ(a.frames.size(), b.frames.size());
    for (std::size_t i = 0; i < a.frames.size(); ++i) {
        EXPECT_EQ(a.frames[i].index, b.frames[i].index);
        EXPECT_EQ(a.frames[i].file, b.frames[i].file);
        EXPECT_EQ(a.frames[i].tick, b.frames[i].tick);
        EXPECT_EQ(a.frames[i].alpha, b.frames[i].alpha);
        EXPECT_EQ(a.frames[i].state_hash, b.frames[i].state_hash);
        EXPECT_EQ(a.frames[i].picture_hash, b.frames[i].picture_hash);
        EXPECT_EQ(a.frames[i].pixel_hash, b.frames[i].pixel_hash);
        EXPECT_EQ(a.frames[i].tick_hashes, b.frames[i].tick_hashes);
    }
}

/// The message about a damaged manifest, without the name of the file.
std::string refusal_of(const std::string& text) {
    try {
        (void)parse_manifest(text, "some/manifest.json");
    } catch (const Error& error) {
        EXPECT_EQ(error.exit(), Exit::usage) << error.what();
        const std::string line = error.what();
        EXPECT_TRUE(line.starts_with("some/manifest.json: ")) << line;
        EXPECT_TRUE(line.ends_with("; capture again")) << line;
        EXPECT_FALSE(holds(line, "\n"));
        return line.substr(line.find(": ") + 2);
    }
    ADD_FAILURE() << "accepted: " << text;
    return {};
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
    for (const char* none : {"none", "none/manifest.json"}) try {
            (void)read_manifest(folder / none);
            ADD_FAILURE() << none;
        } catch (const Error& error) {
            EXPECT_EQ(error.exit(), Exit::usage);
            EXPECT_TRUE(holds(error.what(), (folder / none).string()));
        }
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

}  // namespace
}  // namespace oiler::test
