// SPDX-License-Identifier: MIT
#include "oiler/capture/manifest.hpp"

#include <nlohmann/json.hpp>

#include "oiler/core/json.hpp"
#include "oiler/core/state_hash.hpp"

namespace oiler {
namespace {

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
            {"precision", manifest.precision},
            {"scene", manifest.scene},
            {"seed", manifest.seed}};
}

Json line(const Manifest::Frame& frame) {
    return {{"index", frame.index},
            {"file", frame.file},
            {"tick", frame.tick},
            {"alpha", frame.alpha},
            {"state_hash", hash_text(frame.state_hash)},
            {"pixel_hash", hash_text(frame.pixel_hash)}};
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

bool is_manifest(std::string_view json) {
    const auto parsed = nlohmann::json::parse(json, nullptr, false);
    return parsed.is_object() && parsed.contains("gl_renderer") && parsed.contains("frames");
}

}  // namespace oiler
