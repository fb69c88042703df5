// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "oiler/capture/capture_folder.hpp"
#include "oiler/capture/file.hpp"
#include "oiler/capture/frame_record.hpp"
#include "oiler/capture/manifest.hpp"
#include "oiler/core/profile.hpp"

namespace oiler {

/// A frame on its way to the disk.
struct Shot {
    std::int64_t tick = 0;
    double alpha = 0;
    std::uint64_t state_hash = 0;
    std::uint64_t picture_hash = 0;
    std::string tick_hashes{};
    bool has_png = true;
    std::optional<FrameRecord> record{};  ///< its index is set by the capture
    std::vector<std::uint8_t> rgb{};      ///< rows of RGB, bottom row first, as GL reads them
};

/// Writes the frames of one run into a folder that it owns meanwhile. Other threads hash, encode
/// and write, while the caller draws the next frame. The manifest exists from the start and says
/// that the capture is not finished, which stays true if the run is killed. A capture without
/// frames leaves no files.
class Capture {
public:
    /// `header` is a manifest without frames. Throws Error{io}, see CaptureFolder.
    Capture(std::filesystem::path folder, Manifest header, Profile* profile = nullptr);
    ~Capture();
    Capture(const Capture&) = delete;
    Capture& operator=(const Capture&) = delete;

    /// Adds the next frame; it waits while too many frames are on their way. The pixel hash is XXH3
    /// over the rows, top row first, as in the PNG. Throws Error{io}, also of an earlier frame.
    void add(Shot shot);
    /// Returns a buffer of pixels that is no longer in use, to be filled again.
    [[nodiscard]] std::vector<std::uint8_t> spare_buffer();

    /// Ends the run with its frames so far, as if no more had been planned.
    void end_here() { manifest_.planned_frames = std::int64_t(manifest_.frames.size()); }
    /// Waits for all frames and writes the manifest with them. Throws Error{io}; the failed frame
    /// and those after it are then removed, and all records.
    void finish();

    /// After finish(): the manifest as written.
    [[nodiscard]] const Manifest& manifest() const { return manifest_; }
    /// See CaptureFolder::dead_owner().
    [[nodiscard]] const std::string& dead_owner() const { return folder_.dead_owner(); }

private:
    struct Job {
        std::size_t index;
        Shot shot;
    };

    void work();
    /// Writes the frame of the first job, without the lock.
    void write_next(std::unique_lock<std::mutex>& lock);
    void write(Job& job);
    /// Appends the records that follow each other without a gap.
    void write_record(std::size_t index, std::vector<std::byte> record);
    void write_manifest() const;
    void stop_workers();
    /// Removes the frames from the first one that is not complete.
    void drop_incomplete();

    CaptureFolder folder_;
    Manifest manifest_;
    Profile* profile_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Job> jobs_;
    std::vector<bool> complete_;  ///< a flag for each frame of the manifest
    std::vector<std::vector<std::uint8_t>> spare_;
    std::map<std::size_t, std::vector<std::byte>> waiting_records_;
    std::size_t next_record_ = 0;
    std::optional<File> records_;
    std::exception_ptr error_;
    bool closed_ = false;
    std::vector<std::thread> workers_;
};

}  // namespace oiler
