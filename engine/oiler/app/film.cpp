// SPDX-License-Identifier: MIT
#include "oiler/app/film.hpp"

#include "oiler/core/error.hpp"
#include "oiler/picture/picture.hpp"
#include "oiler/process/console.hpp"

namespace oiler {

Film::Film(Renderer& renderer, const Manifest& header, const Options& options, Profile* profile)
    : renderer_(renderer), header_(header), options_(options), profile_(profile) {}

void Film::open() {
    // First, because it may fail: an earlier capture is then still there.
    if (!options_.video.empty()) video_.emplace(options_.video, header_.size, header_.fps);
    capture_.emplace(options_.out, header_, profile_);
    if (!capture_->dead_owner().empty())
        remark(options_.quiet, "{} has an unfinished capture of {}; its frames are replaced",
               options_.out.string(), capture_->dead_owner());
    if (!options_.sheet.empty()) sheet_.emplace(header_.planned_frames, header_.size);
}

Shot Film::shot_of(const Picture& picture, const HeadlessFrame& at,
                   const Playback& playback) const {
    const Span span(profile_, "hash");
    Shot shot{.tick = at.step,
              .alpha = at.alpha,
              .state_hash = playback.state_hash(),
              .picture_hash = hash_of(picture),
              .tick_hashes = playback.tick_hashes(last_tick_, at.step),
              .has_png = options_.has_png && frames_ % options_.keyframes == 0};
    if (shot.has_png && is_recordable(playback.bodies().size(), picture))
        shot.record = FrameRecord{.bodies = playback.bodies(), .picture = picture};
    return shot;
}

void Film::add(const Picture& picture, const HeadlessFrame& at, const Playback& playback,
               const Overlay& overlay, Size view) {
    {
        const Span span(profile_, "draw");
        renderer_.draw(picture, header_.size, view);
        renderer_.draw_over(overlay);
    }
    {
        const Span span(profile_, "read");
        renderer_.read(pixels_);
    }
    if (!capture_) open();
    Shot shot = shot_of(picture, at, playback);
    last_tick_ = at.step;
    if (video_) {
        const Span span(profile_, "video");
        video_->add(pixels_.rgb);
    }
    if (sheet_ && sheet_->wants(frames_)) {
        const Span span(profile_, "sheet");
        sheet_->add(picture, static_cast<double>(frames_) / header_.fps, renderer_);
    }
    const Span span(profile_, "hand over");
    shot.rgb = std::exchange(pixels_.rgb, capture_->spare_buffer());
    capture_->add(std::move(shot));
    ++frames_;
}

void Film::finish() {
    if (!capture_) return;
    capture_->finish();
    if (video_) video_->finish();
    if (sheet_) sheet_->write(options_.sheet);
}

void Film::finish_capture_ignoring_errors() {
    try {
        if (capture_) capture_->finish();
    } catch (const Error&) {
    }
}

}  // namespace oiler
