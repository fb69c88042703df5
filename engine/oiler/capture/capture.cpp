// SPDX-License-Identifier: MIT
#include "oiler/capture/capture.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cassert>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <utility>

#include "oiler/capture/file.hpp"
#include "oiler/capture/png.hpp"
#include "oiler/core/error.hpp"
#include "oiler/core/state_hash.hpp"

namespace oiler {
namespace {

namespace fs = std::filesystem;

constexpr const char* manifest_name = "manifest.json";

std::string frame_name(std::int64_t index) { return fmt::format("frame_{:06}.png", index); }

/// Returns whether frame_name() may have made the name.
bool is_frame_name(std::string_view name) {
    constexpr std::string_view head = "frame_";
    constexpr std::string_view tail = ".png";
    if (!name.starts_with(head) || !name.ends_with(tail)) return false;
    if (name.size() < head.size() + 6 + tail.size()) return false;
    name.remove_prefix(head.size());
    name.remove_suffix(tail.size());
    return std::ranges::all_of(name, [](char c) { return c >= '0' && c <= '9'; });
}

std::string read_text(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void remove_if_present(const fs::path& path) {
    std::error_code error;
    fs::remove(path, error);
    if (error)
        fail(Exit::io, "cannot remove {} of an earlier capture: {}; choose another folder",
             path.string(), error.message());
}

/// Removes the manifest last: if removal fails half-way, the next run continues it.
void remove_earlier_capture(const fs::path& folder) {
    const fs::path manifest = folder / manifest_name;
    std::error_code unreadable;
    if (!fs::exists(manifest, unreadable)) return;
    if (!fs::is_regular_file(manifest, unreadable) || !is_manifest(read_text(manifest)))
        fail(Exit::io, "{} is not from a capture and would be lost; choose another folder",
             manifest.string());
    for (const auto& entry : fs::directory_iterator(folder, unreadable))
        if (is_frame_name(entry.path().filename().string())) remove_if_present(entry.path());
    remove_if_present(manifest);
}

std::uint64_t hash_top_down(Size size, std::span<const std::uint8_t> rgb_bottom_up) {
    const auto row = static_cast<std::size_t>(size.width) * 3;
    StateHash hash;
    for (std::size_t y = rgb_bottom_up.size() / row; y-- > 0;)
        hash.add(std::as_bytes(rgb_bottom_up.subspan(y * row, row)));
    return hash.value();
}

}  // namespace

Capture::Capture(fs::path folder, Manifest header)
    : folder_(std::move(folder)), manifest_(std::move(header)) {
    assert(manifest_.frames.empty());
    made_folder_ = make_folder(folder_);
    remove_earlier_capture(folder_);
    finish();
}

Capture::~Capture() {
    std::error_code ignored;
    if (manifest_.frames.empty()) fs::remove(folder_ / manifest_name, ignored);
    if (made_folder_) fs::remove(folder_, ignored);
}

void Capture::add(std::int64_t tick, double alpha, std::uint64_t state_hash, Size size,
                  std::span<const std::uint8_t> rgb_bottom_up) {
    assert(size == manifest_.size);
    const auto index = static_cast<std::int64_t>(manifest_.frames.size());
    const std::string name = frame_name(index);
    write_file(folder_ / name, encode_png(size, rgb_bottom_up));
    manifest_.frames.push_back(
        {index, name, tick, alpha, state_hash, hash_top_down(size, rgb_bottom_up)});
}

void Capture::finish() const {
    File file(folder_ / manifest_name);
    file.write(to_json(manifest_));
    file.commit();
}

}  // namespace oiler
