// SPDX-License-Identifier: MIT
#include "oiler/app/film.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "oiler/capture/file.hpp"
#include "oiler/capture/png.hpp"
#include "oiler/core/error.hpp"
#include "oiler/overlay/overlays.hpp"
#include "oiler/picture/palette.hpp"
#include "oiler/process/console.hpp"

namespace oiler {
namespace {

constexpr std::int64_t most_tiles = 12;
constexpr int columns = 4;
constexpr Size largest_tile{320, 640};  // px
constexpr int gap = 2;                  // px between tiles

/// The largest size of the same shape that fits into a tile.
Size fit_tile(Size frame) {
    const double scale = std::min(static_cast<double>(largest_tile.width) / frame.width,
                                  static_cast<double>(largest_tile.height) / frame.height);
    return {std::max(1, static_cast<int>(std::lround(scale * frame.width))),
            std::max(1, static_cast<int>(std::lround(scale * frame.height)))};
}

/// A grey picture with room for the tiles.
Pixels blank(Size tile, int tiles) {
    const int across = std::min(tiles, columns);
    const int down = (tiles + columns - 1) / columns;
    const Size size{across * (tile.width + gap) - gap, down * (tile.height + gap) - gap};
    return {size, std::vector<std::uint8_t>(
                      std::size_t{3} * static_cast<std::size_t>(size.width * size.height),
                      palette::grey.r)};
}

/// Copies a tile to its place; tiles run from the upper left, rows of pixels from the bottom.
void place(Pixels& sheet, const Pixels& tile, int index) {
    const int left = index % columns * (tile.size.width + gap);
    const int top = index / columns * (tile.size.height + gap);
    const auto row = static_cast<std::ptrdiff_t>(3 * tile.size.width);
    for (int y = 0; y < tile.size.height; ++y) {
        const int target = sheet.size.height - top - tile.size.height + y;
        std::copy_n(tile.rgb.begin() + row * y, row,
                    sheet.rgb.begin() + 3 * (std::ptrdiff_t{target} * sheet.size.width + left));
    }
}

}  // namespace

Sheet::Sheet(std::int64_t frames, Size size) : tile_(fit_tile(size)) {
    const std::int64_t tiles = std::min(frames, most_tiles);
    for (std::int64_t i = 0; i < tiles; ++i)
        frames_.push_back(tiles > 1 ? i * (frames - 1) / (tiles - 1) : 0);
}

bool Sheet::wants(std::int64_t frame) const {
    return std::binary_search(frames_.begin(), frames_.end(), frame);
}

void Sheet::add(Picture picture, double time, Renderer& renderer) {
    add_status(picture, OverlayArea(tile_), fmt::format("{:.2f} s", time));
    renderer.draw(picture, tile_);
    renderer.read(tiles_.emplace_back());
}

void Sheet::write(const std::filesystem::path& path) const {
    if (tiles_.empty()) return;
    Pixels sheet = blank(tile_, static_cast<int>(tiles_.size()));
    for (std::size_t i = 0; i < tiles_.size(); ++i) place(sheet, tiles_[i], static_cast<int>(i));
    write_file(path, encode_png(sheet.size, sheet.rgb), kinds::png);
}

Film::Film(Renderer& renderer, const Manifest& header, const Options& options, Profile* profile)
    : renderer_(renderer), header_(header), options_(options), profile_(profile) {}

void Film::open() {
    // The video comes first: if it fails, an earlier capture is still there.
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
        shot.record = FrameRecord{
            .bodies = playback.bodies(), .obstacles = playback.obstacles(), .picture = picture};
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
