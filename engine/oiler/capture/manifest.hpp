// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "oiler/core/size.hpp"

namespace oiler {

/// What a folder of frames was made by and from: enough to tell, when two captures differ, whether
/// the simulation (state hashes), the drawing (pixel hashes) or the rasteriser (gl_renderer) did.
/// Neither a clock nor a path of the machine is in it, so that the same command gives the same
/// bytes.
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

/// JSON, one frame to a line; hashes as 16 hexadecimal digits, since many readers keep numbers in
/// a double. Text that is not UTF-8 is replaced, not refused.
[[nodiscard]] std::string to_json(const Manifest& manifest);

/// Whether `json` is a manifest that to_json() could have made.
[[nodiscard]] bool is_manifest(std::string_view json);

}  // namespace oiler
