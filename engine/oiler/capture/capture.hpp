// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "oiler/capture/manifest.hpp"
#include "oiler/core/size.hpp"

namespace oiler {

/// A folder of frames that is always one run's: what an earlier capture's manifest names there is
/// removed first, or a shorter run would leave the longer one's last frames between its own. Only
/// names of the form frame_000000.png are removed, and the manifest itself; everything else in the
/// folder stays. A folder that it made and that stayed empty is removed again.
class Capture {
public:
    /// `header` is a manifest without frames. Throws Error(Exit::io), also when the folder holds a
    /// manifest.json that no capture wrote.
    Capture(std::filesystem::path folder, Manifest header);
    ~Capture();
    Capture(const Capture&) = delete;
    Capture& operator=(const Capture&) = delete;

    /// Writes the next frame; the size is the header's. The pixel hash is XXH3 over the rows of
    /// RGB, top row first, as a reader of the PNG sees them. Throws Error(Exit::io).
    void add(std::int64_t tick, double alpha, std::uint64_t state_hash, Size size,
             std::span<const std::uint8_t> rgb_bottom_up);

    /// Writes manifest.json, which names the frames so far: last, so that a manifest never names
    /// a frame that is missing. Throws Error(Exit::io).
    void finish() const;

private:
    std::filesystem::path folder_;
    Manifest manifest_;
    bool made_folder_ = false;
};

}  // namespace oiler
