// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "oiler/app/options.hpp"
#include "oiler/app/playback.hpp"
#include "oiler/capture/capture.hpp"
#include "oiler/capture/video.hpp"
#include "oiler/core/step_clock.hpp"
#include "oiler/render/renderer.hpp"

namespace oiler {

/// One picture of a whole run: up to twelve frames, evenly spaced in time, each with its time.
class Sheet {
public:
    /// `size` is that of the run's frames; the tiles have the same shape.
    Sheet(std::int64_t frames, Size size);

    /// Returns whether the sheet shows the frame.
    [[nodiscard]] bool wants(std::int64_t frame) const;
    /// Draws the picture at `time` in s as the next tile.
    void add(Picture picture, double time, Renderer& renderer);
    /// Writes the PNG with the tiles so far. Throws Error{io}.
    void write(const std::filesystem::path& path) const;

private:
    std::vector<std::int64_t> frames_;
    Size tile_;
    std::vector<Pixels> tiles_;
};

/// The outputs of a headless run: a capture and, on request, a video and a sheet. They are opened
/// with the first frame, so a failure to draw leaves no folder.
class Film {
public:
    /// `header` is the manifest without frames.
    Film(Renderer& renderer, const Manifest& header, const Options& options, Profile* profile);

    /// Draws the picture as the next frame, in the part `view`, under an overlay. Throws Error{io}.
    void add(const Picture& picture, const HeadlessFrame& at, const Playback& playback,
             const Overlay& overlay, Size view);
    /// Marks a capture with fewer frames than planned as complete: the game has quit.
    void end_here() {
        if (capture_) capture_->end_here();
    }
    /// Completes the files with the frames so far. Throws Error{io}.
    void finish();
    /// Completes the capture after an error and ignores further errors: the first one is reported.
    void finish_capture_ignoring_errors();

    [[nodiscard]] std::int64_t frames() const { return frames_; }

private:
    void open();
    [[nodiscard]] Shot shot_of(const Picture& picture, const HeadlessFrame& at,
                               const Playback& playback) const;

    Renderer& renderer_;
    const Manifest& header_;
    const Options& options_;
    Profile* profile_;
    std::int64_t frames_ = 0;
    std::int64_t last_tick_ = 0;
    Pixels pixels_;
    std::optional<Capture> capture_;
    std::optional<Video> video_;
    std::optional<Sheet> sheet_;
};

}  // namespace oiler
