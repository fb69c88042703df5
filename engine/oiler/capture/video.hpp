// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "oiler/capture/file.hpp"
#include "oiler/core/size.hpp"

namespace oiler {

/// A video that ffmpeg encodes from raw frames while they are drawn. The ending of the path chooses
/// the format: .mp4 (H.264), .gif or .apng. ffmpeg ends with this process. The file gets its name
/// when it is complete.
class Video {
public:
    /// Throws Error{usage} unless the path's ending names a format.
    static void require_format(const std::filesystem::path& path);
    /// Starts ffmpeg. Throws Error{usage} for another ending, and Error{io} if ffmpeg is missing.
    Video(const std::filesystem::path& path, Size size, int fps);
    /// Without finish(), ffmpeg is stopped and no file is left.
    ~Video();
    Video(const Video&) = delete;
    Video& operator=(const Video&) = delete;

    /// Rows of RGB, bottom row first. Throws Error{io} with the words of ffmpeg if it has failed.
    void add(std::span<const std::uint8_t> rgb_bottom_up);
    /// Waits for ffmpeg and names the file. Throws Error{io}.
    void finish();

private:
    [[noreturn]] void fail_to_start(int error_number) const;
    void start(const std::vector<std::string>& words);
    /// Stops ffmpeg, unless the video is finished.
    void stop();
    [[noreturn]] void fail_with_reason(int status);
    /// Closes the pipe and returns the status of ffmpeg's end.
    int wait();

    std::filesystem::path path_;
    File file_;
    int frames_ = -1;  ///< descriptor of the pipe to ffmpeg
    int errors_ = -1;  ///< descriptor of the memory that takes ffmpeg's messages
    pid_t process_ = -1;
};

}  // namespace oiler
