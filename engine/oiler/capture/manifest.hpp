// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "oiler/core/size.hpp"

namespace oiler {

/// The settings, tools and hashes of a capture. The hashes of a frame tell the cause if two
/// captures differ: the simulation (state), the contents of the picture (picture) or its drawing
/// (pixels). It has neither times nor paths, so that the same command writes the same bytes. It is
/// enough to reproduce each frame.
struct Manifest {
    struct Frame {
        std::int64_t index = 0;
        std::string file{};  ///< empty if the frame has no PNG
        std::int64_t tick = 0;
        double alpha = 0;
        std::uint64_t state_hash = 0;
        std::uint64_t picture_hash = 0;
        std::uint64_t pixel_hash = 0;
        /// The last four digits of the state hash of each tick after that of the frame before;
        /// empty if the world has more than 1000 bodies.
        std::string tick_hashes{};
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
    std::string damping{};  ///< "kick", "drift", or empty for the method's own
    std::string precision;
    std::string scene;         ///< name of the game or the scene file
    std::string scene_text{};  ///< the scene file; empty for a game
    std::uint64_t seed = 0;
    std::int64_t planned_frames = 0;
    std::vector<Frame> frames{};

    /// False while the capture runs and after it was stopped or killed.
    [[nodiscard]] bool is_finished() const { return std::int64_t(frames.size()) == planned_frames; }
};

/// Writes JSON, one frame per line. Hashes have 16 hexadecimal digits, because many readers hold
/// numbers in a double. Bytes that are not UTF-8 are replaced.
[[nodiscard]] std::string to_json(const Manifest& manifest);

/// Reads the text of to_json(). Throws Error{usage}; `file` is named in the message.
[[nodiscard]] Manifest parse_manifest(std::string_view json, const std::string& file);

/// Reads manifest.json of a folder, or the file itself. Throws Error{usage} if there is none.
[[nodiscard]] Manifest read_manifest(const std::filesystem::path& folder_or_file);

}  // namespace oiler
