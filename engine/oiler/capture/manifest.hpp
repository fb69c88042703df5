// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "oiler/core/size.hpp"

namespace oiler {

/// The settings, tools and hashes of a capture. If two captures differ, it shows the cause: the
/// simulation (state hashes), the drawing (pixel hashes) or the rasteriser (gl_renderer). It has
/// neither times nor paths, so that the same command writes the same bytes.
struct Manifest {
    struct Frame {
        std::int64_t index = 0;
        std::string file;
        std::int64_t tick = 0;
        double alpha = 0;
        std::uint64_t state_hash = 0;
        std::uint64_t pixel_hash = 0;
    };

    std::string version;
    std::string compiler;
    std::string provider;
    std::string gl_renderer;
    std::string gl_version;
    Size size;
    int fps = 0;
    int rate = 0;
    std::string method;
    std::string precision;
    std::string scene;
    std::uint64_t seed = 0;
    std::vector<Frame> frames;
};

/// Writes JSON, one frame per line. Hashes have 16 hexadecimal digits, because many readers hold
/// numbers in a double. Bytes that are not UTF-8 are replaced.
[[nodiscard]] std::string to_json(const Manifest& manifest);

/// Returns whether `json` may be a manifest of to_json().
[[nodiscard]] bool is_manifest(std::string_view json);

}  // namespace oiler
