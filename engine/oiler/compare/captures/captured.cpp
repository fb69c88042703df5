// SPDX-License-Identifier: MIT
#include "oiler/compare/captures/captured.hpp"

#include <span>
#include <utility>

#include "oiler/capture/capture_folder.hpp"
#include "oiler/capture/file.hpp"
#include "oiler/capture/frame_record.hpp"
#include "oiler/core/error.hpp"
#include "oiler/core/state_hash.hpp"

namespace oiler {
namespace {

namespace fs = std::filesystem;

/// Both frames/spring and frames/spring/manifest.json name a capture. See require_whole().
fs::path folder_of(fs::path path) {
    std::error_code error;
    const bool is_file = fs::is_regular_file(path, error) && path.filename() == manifest_name;
    if (is_file) path = path.parent_path();
    require_whole(path);
    return path;
}

}  // namespace

Captured::Captured(fs::path folder)
    : folder_(folder_of(std::move(folder))), manifest_(read_manifest(folder_)) {
    const fs::path path = folder_ / records_name;
    std::error_code error;
    if (!fs::exists(path, error)) return;
    const std::string bytes = read_text(path);
    const std::string lines = gunzip(std::as_bytes(std::span(bytes)), path.string());
    for (FrameRecord& record : parse_frame_records(lines, path.string()))
        records_.insert_or_assign(record.index, std::move(record));
}

const FrameRecord* Captured::record(std::int64_t index) const {
    const auto found = records_.find(index);
    return found == records_.end() ? nullptr : &found->second;
}

bool Captured::has_image(std::int64_t index) const {
    const std::string& file = manifest_.frames[static_cast<std::size_t>(index)].file;
    std::error_code error;
    return !file.empty() && fs::is_regular_file(folder_ / file, error);
}

Image Captured::image(std::int64_t index) const {
    const Manifest::Frame& frame = manifest_.frames[static_cast<std::size_t>(index)];
    const fs::path path = folder_ / frame.file;
    const std::string bytes = read_text(path);
    const std::span<const std::byte> png = std::as_bytes(std::span(bytes));
    if (size_of_png(png, path.string()) == manifest_.size) {
        Image image = decode_png(png, path.string());
        if (hash_top_down(image.size, image.rgb_bottom_up) == frame.pixel_hash) return image;
    }
    fail(Exit::usage, "{}: its pixels are not those of manifest.json; capture again",
         path.string());
}

std::map<std::int64_t, std::string> Captured::tick_hashes() const {
    constexpr std::int64_t digits = 4;
    std::map<std::int64_t, std::string> hashes;
    std::int64_t last = 0;
    for (const Manifest::Frame& frame : manifest_.frames) {
        const auto count = static_cast<std::int64_t>(frame.tick_hashes.size()) / digits;
        if (count == frame.tick - last)
            for (std::int64_t i = 0; i < count; ++i)
                hashes[last + 1 + i] = frame.tick_hashes.substr(
                    static_cast<std::size_t>(i * digits), static_cast<std::size_t>(digits));
        last = frame.tick;
    }
    return hashes;
}

}  // namespace oiler
