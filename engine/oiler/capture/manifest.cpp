// SPDX-License-Identifier: MIT
#include "oiler/capture/manifest.hpp"

#include <charconv>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "oiler/core/error.hpp"
#include "oiler/core/json.hpp"
#include "oiler/core/state_hash.hpp"

namespace oiler {
namespace {

namespace fs = std::filesystem;
using Parsed = nlohmann::json;

Json text_or_null(const std::string& text) { return text.empty() ? Json() : Json(text); }

std::string text_or_empty(const Parsed& json) { return json.is_null() ? "" : json; }

Json header(const Manifest& manifest) {
    return {{"version", manifest.version},
            {"compiler", manifest.compiler},
            {"provider", manifest.provider},
            {"gl_renderer", manifest.gl_renderer},
            {"gl_version", manifest.gl_version},
            {"width", manifest.size.width},
            {"height", manifest.size.height},
            {"fps", manifest.fps},
            {"rate", manifest.rate},
            {"method", manifest.method},
            {"damping", text_or_null(manifest.damping)},
            {"precision", manifest.precision},
            {"seed", manifest.seed},
            {"scene", manifest.scene},
            {"scene_text", text_or_null(manifest.scene_text)},
            {"planned_frames", manifest.planned_frames},
            {"finished", manifest.is_finished()}};
}

Json line(const Manifest::Frame& frame) {
    Json json{{"index", frame.index},
              {"file", text_or_null(frame.file)},
              {"tick", frame.tick},
              {"alpha", frame.alpha},
              {"state_hash", hash_text(frame.state_hash)},
              {"picture_hash", hash_text(frame.picture_hash)},
              {"pixel_hash", hash_text(frame.pixel_hash)}};
    if (!frame.tick_hashes.empty()) json["tick_hashes"] = frame.tick_hashes;
    return json;
}

std::uint64_t to_hash(const Parsed& json) {
    const std::string digits = json;
    std::uint64_t hash = 0;
    const char* const end = digits.data() + digits.size();
    const auto [last, error] = std::from_chars(digits.data(), end, hash, 16);
    if (digits.size() != 16 || error != std::errc() || last != end)
        fail(Exit::usage, "expected a hash of 16 hexadecimal digits, got {}", digits);
    return hash;
}

/// Returns a whole number within limits, which damaged files exceed.
template <class Whole>
Whole to_whole(const Parsed& json, const char* name, Whole low, Whole high) {
    const Parsed& value = json.at(name);
    const auto number = value.get<std::int64_t>();
    if (!value.is_number_integer() || number < std::int64_t{low} || number > std::int64_t{high})
        fail(Exit::usage, "{}: expected a whole number from {} to {}, got {}", name, low, high,
             value.dump());
    return static_cast<Whole>(number);
}

Manifest::Frame to_frame(const Parsed& json, std::int64_t index) {
    constexpr std::int64_t most_ticks = std::int64_t{1} << 53;
    Manifest::Frame frame{.index = to_whole(json, "index", index, index),
                          .file = text_or_empty(json.at("file")),
                          .tick = to_whole(json, "tick", std::int64_t{0}, most_ticks),
                          .alpha = json.at("alpha"),
                          .state_hash = to_hash(json.at("state_hash")),
                          .picture_hash = to_hash(json.at("picture_hash")),
                          .pixel_hash = to_hash(json.at("pixel_hash")),
                          .tick_hashes = json.value("tick_hashes", "")};
    if (frame.file.find('/') != std::string::npos)
        fail(Exit::usage, "frame {}: expected the name of a file in the folder, got {}", index,
             frame.file);
    return frame;
}

Manifest to_manifest(const Parsed& json) {
    constexpr int most = 1'000'000;
    Manifest manifest{.version = json.at("version"),
                      .compiler = json.at("compiler"),
                      .provider = json.at("provider"),
                      .gl_renderer = json.at("gl_renderer"),
                      .gl_version = json.at("gl_version"),
                      .size = {to_whole(json, "width", 1, most), to_whole(json, "height", 1, most)},
                      .fps = to_whole(json, "fps", 1, most),
                      .rate = to_whole(json, "rate", 1, most),
                      .method = json.at("method"),
                      .damping = text_or_empty(json.at("damping")),
                      .precision = json.at("precision"),
                      .scene = json.at("scene"),
                      .scene_text = text_or_empty(json.at("scene_text")),
                      .seed = json.at("seed"),
                      .planned_frames = to_whole(json, "planned_frames", 1, most)};
    for (const Parsed& frame : json.at("frames"))
        manifest.frames.push_back(to_frame(frame, std::int64_t(manifest.frames.size())));
    if (json.at("finished") != manifest.is_finished())
        fail(Exit::usage, "finished is {}, but {} of {} frames are listed",
             json.at("finished").dump(), manifest.frames.size(), manifest.planned_frames);
    return manifest;
}

}  // namespace

std::string to_json(const Manifest& manifest) {
    std::string text = header(manifest).dump(2);
    text.resize(text.size() - std::string_view("\n}").size());
    text += ",\n  \"frames\": [";
    const char* separator = "\n";
    for (const Manifest::Frame& frame : manifest.frames) {
        text += separator;
        text += "    " + line(frame).dump(-1);
        separator = ",\n";
    }
    text += "\n  ]\n}\n";
    return text;
}

Manifest parse_manifest(std::string_view json, const std::string& file) try {
    return to_manifest(Parsed::parse(json));
} catch (const Parsed::exception& error) {
    fail(Exit::usage, "{}: not the manifest of a capture ({}); capture again", file, error.what());
} catch (const Error& error) {
    fail(error.exit(), "{}: {}; capture again", file, error.what());
}

Manifest read_manifest(const fs::path& folder_or_file) {
    std::error_code error;
    const fs::path path =
        fs::is_directory(folder_or_file, error) ? folder_or_file / "manifest.json" : folder_or_file;
    std::ifstream file(path, std::ios::binary);
    if (!file || !fs::is_regular_file(path, error))
        fail(Exit::usage, "{}: no capture there: {} cannot be read; capture with --headless --out",
             folder_or_file.string(), path.string());
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    return parse_manifest(text, path.string());
}

}  // namespace oiler
