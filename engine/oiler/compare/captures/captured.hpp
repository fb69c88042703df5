// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>

#include "oiler/capture/frame_record.hpp"
#include "oiler/capture/manifest.hpp"
#include "oiler/capture/png.hpp"

namespace oiler {

/// The files of a capture, read back.
class Captured {
public:
    /// Throws Error{usage} if the folder has no capture.
    explicit Captured(std::filesystem::path folder);

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
    [[nodiscard]] const Manifest& manifest() const { return manifest_; }
    /// Null if the frame has no record.
    [[nodiscard]] const FrameRecord* record(std::int64_t index) const;
    /// Returns whether the frame has a PNG on the disk.
    [[nodiscard]] bool has_image(std::int64_t index) const;
    /// Throws Error{usage} if the PNG is damaged or its pixels are not those of the manifest.
    [[nodiscard]] Image image(std::int64_t index) const;
    /// The last digits of the state hash of each tick, by tick; see Manifest::Frame::tick_hashes.
    [[nodiscard]] std::map<std::int64_t, std::string> tick_hashes() const;

private:
    std::filesystem::path folder_;
    Manifest manifest_;
    std::map<std::int64_t, FrameRecord> records_;
};

}  // namespace oiler
