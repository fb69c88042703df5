// SPDX-License-Identifier: MIT
#include "oiler/capture/manifest.hpp"

#include <fmt/core.h>
#include <charconv>
#include <functional>
#include <nlohmann/json.hpp>

#include "oiler/capture/file.hpp"
#include "oiler/core/error.hpp"
#include "oiler/core/json.hpp"
#include "oiler/core/state_hash.hpp"

namespace oiler {
namespace {

namespace fs = std::filesystem;
using Parsed = nlohmann::json;

Json text_or_null(const std::string& text) { return text.empty() ? Json() : Json(text); }

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

[[noreturn]] void fail_member(const Parsed& json, const char* name, std::string_view expected) {
    const auto found = json.find(name);
    fail(Exit::usage, "{}: expected {}, got {}", name, expected,
         found == json.end() ? "nothing" : found->dump());
}

/// Returns a member if `is_valid` holds for it.
template <class IsValid>
const Parsed& member(const Parsed& json, const char* name, std::string_view expected,
                     const IsValid& is_valid) {
    const auto found = json.find(name);
    if (found == json.end() || !std::invoke(is_valid, *found)) fail_member(json, name, expected);
    return *found;
}

std::string to_text(const Parsed& json, const char* name) {
    return member(json, name, "a text", &Parsed::is_string);
}

std::string to_text_or_empty(const Parsed& json, const char* name) {
    const Parsed& value = member(json, name, "a text or null", [](const Parsed& there) {
        return there.is_string() || there.is_null();
    });
    return value.is_null() ? "" : value;
}

std::string to_one_of(const Parsed& json, const char* name, std::string_view first,
                      std::string_view second, bool may_be_null) {
    const Parsed& value = member(
        json, name, fmt::format("\"{}\" or \"{}\"{}", first, second, may_be_null ? " or null" : ""),
        [&](const Parsed& there) {
            return there == first || there == second || (may_be_null && there.is_null());
        });
    return value.is_null() ? "" : value;
}

bool is_hexadecimal(std::string_view digits) {
    return digits.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

std::uint64_t to_hash(const Parsed& json, const char* name) {
    const std::string digits = member(json, name, "16 hexadecimal digits", [](const Parsed& value) {
        return value.is_string() && value.get_ref<const std::string&>().size() == 16 &&
               is_hexadecimal(value.get_ref<const std::string&>());
    });
    std::uint64_t hash = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), hash, 16);
    return hash;
}

/// Four digits for each tick after the frame before, or none.
std::string to_tick_hashes(const Parsed& json, std::int64_t ticks) {
    constexpr const char* name = "tick_hashes";
    if (!json.contains(name)) return {};
    return member(
        json, name, fmt::format("{} hexadecimal digits", 4 * ticks), [&](const Parsed& value) {
            return value.is_string() &&
                   std::int64_t(value.get_ref<const std::string&>().size()) == 4 * ticks &&
                   is_hexadecimal(value.get_ref<const std::string&>());
        });
}

double to_alpha(const Parsed& json) {
    return member(json, "alpha", "a number from 0 to less than 1", [](const Parsed& value) {
        return value.is_number() && value.get<double>() >= 0 && value.get<double>() < 1;
    });
}

/// Returns a whole number within limits, which damaged files exceed.
template <class Whole>
Whole to_whole(const Parsed& json, const char* name, Whole low, Whole high) {
    return member(json, name, fmt::format("a whole number from {} to {}", low, high),
                  [&](const Parsed& value) {
                      if (!value.is_number_integer()) return false;
                      const auto number = value.get<std::int64_t>();
                      return number >= std::int64_t{low} && number <= std::int64_t{high} &&
                             !(value.is_number_unsigned() && number < 0);
                  });
}

std::uint64_t to_seed(const Parsed& json) {
    return member(json, "seed", "a whole number from 0 to 18446744073709551615",
                  &Parsed::is_number_unsigned);
}

/// `earlier_tick` is that of the frame before.
Manifest::Frame to_frame(const Parsed& json, std::int64_t index, std::int64_t earlier_tick) {
    constexpr std::int64_t most_ticks = std::int64_t{1} << 53;
    Manifest::Frame frame{.index = to_whole(json, "index", index, index),
                          .file = to_text_or_empty(json, "file"),
                          .tick = to_whole(json, "tick", earlier_tick, most_ticks),
                          .alpha = to_alpha(json),
                          .state_hash = to_hash(json, "state_hash"),
                          .picture_hash = to_hash(json, "picture_hash"),
                          .pixel_hash = to_hash(json, "pixel_hash")};
    frame.tick_hashes = to_tick_hashes(json, frame.tick - earlier_tick);
    if (frame.file.find('/') != std::string::npos)
        fail_member(json, "file", "the name of a file in the folder");
    return frame;
}

std::vector<Manifest::Frame> to_frames(const Parsed& json) {
    std::vector<Manifest::Frame> frames;
    for (const Parsed& frame : member(json, "frames", "an array", &Parsed::is_array)) try {
            const std::int64_t earlier_tick = frames.empty() ? 0 : frames.back().tick;
            frames.push_back(to_frame(frame, std::int64_t(frames.size()), earlier_tick));
        } catch (const Error& error) {
            fail(error.exit(), "frame {}: {}", frames.size(), error.what());
        }
    return frames;
}

Manifest to_manifest(const Parsed& json) {
    constexpr int most = 1'000'000;
    Manifest manifest{.version = to_text(json, "version"),
                      .compiler = to_text(json, "compiler"),
                      .provider = to_text(json, "provider"),
                      .gl_renderer = to_text(json, "gl_renderer"),
                      .gl_version = to_text(json, "gl_version"),
                      .size = {to_whole(json, "width", 1, most), to_whole(json, "height", 1, most)},
                      .fps = to_whole(json, "fps", 1, most),
                      .rate = to_whole(json, "rate", 1, most),
                      .method = to_text(json, "method"),
                      .damping = to_one_of(json, "damping", "kick", "drift", true),
                      .precision = to_one_of(json, "precision", "float", "double", false),
                      .scene = to_text(json, "scene"),
                      .scene_text = to_text_or_empty(json, "scene_text"),
                      .seed = to_seed(json),
                      .planned_frames = to_whole(json, "planned_frames", 1, most),
                      .frames = to_frames(json)};
    member(json, "finished",
           fmt::format("{}, because {} of {} frames are listed", manifest.is_finished(),
                       manifest.frames.size(), manifest.planned_frames),
           [&](const Parsed& value) { return value == manifest.is_finished(); });
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
    const bool is_file = fs::is_regular_file(path, error);
    if (error && exit_of_open(error.value()) == Exit::io)
        fail(Exit::io, "{}: cannot be read: {}; give a capture that you may read", path.string(),
             error.message());
    if (!is_file)
        fail(Exit::usage, "{}: no capture there: {} cannot be read; capture with --headless --out",
             folder_or_file.string(), path.string());
    return parse_manifest(read_text(path), path.string());
}

}  // namespace oiler
