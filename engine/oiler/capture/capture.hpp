// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "oiler/capture/manifest.hpp"
#include "oiler/core/size.hpp"

namespace oiler {

/// A folder of frames that is always one run's: where an earlier capture's manifest is, its frames
/// are removed first, or a shorter run would leave the longer one's last frames between its own.
/// The manifest is there from the start, so that this holds after a run that was killed, too. Only
/// names of the form frame_000000.png are removed; everything else in the folder stays. Without a
/// frame, nothing is left.
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

    /// Writes manifest.json, which names the frames so far, and never one that is missing. Throws
    /// Error(Exit::io).
    void finish() const;

private:
    std::filesystem::path folder_;
    Manifest manifest_;
    bool made_folder_ = false;
};

}  // namespace oiler
