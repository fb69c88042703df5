// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "oiler/capture/manifest.hpp"
#include "oiler/core/size.hpp"

namespace oiler {

/// A folder with the frames of one run. If it has the manifest of an earlier capture, the earlier
/// frames are removed, so that a shorter run does not keep the last frames of a longer one. The
/// manifest exists from the start, so that this also holds after a killed run. Only files named
/// like frame_000000.png are removed; all others stay. A capture without frames leaves no files.
class Capture {
public:
    /// `header` is a manifest without frames. Throws Error(Exit::io), also if the folder has a
    /// manifest.json of another program.
    Capture(std::filesystem::path folder, Manifest header);
    ~Capture();
    Capture(const Capture&) = delete;
    Capture& operator=(const Capture&) = delete;

    /// Writes the next frame. `size` equals the header's. The pixel hash is XXH3 over the rows of
    /// RGB, top row first, as in the PNG. Throws Error(Exit::io).
    void add(std::int64_t tick, double alpha, std::uint64_t state_hash, Size size,
             std::span<const std::uint8_t> rgb_bottom_up);

    /// Writes manifest.json with the frames written so far. Throws Error(Exit::io).
    void finish() const;

private:
    std::filesystem::path folder_;
    Manifest manifest_;
    bool made_folder_ = false;
};

}  // namespace oiler
