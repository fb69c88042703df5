// SPDX-License-Identifier: MIT
#include "oiler/picture/bitmap.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "oiler/core/error.hpp"
#include "oiler/core/state_hash.hpp"

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#include <stb/stb_image.h>

namespace oiler {
namespace {

namespace fs = std::filesystem;

constexpr int channels = 4;
constexpr int longest_side = 8192;  // texels; every OpenGL 3.3 driver in use takes as many

std::size_t bytes_of(Size size) {
    return static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height) * channels;
}

/// The folders in which a relative path is looked for, in this order.
std::vector<fs::path> folders_of(const char* source) {
    std::error_code unknown;
    const fs::path program = fs::read_symlink("/proc/self/exe", unknown);
    const fs::path here = fs::current_path(unknown);
    std::vector<fs::path> folders;
    for (const fs::path& folder : {program.parent_path(), (here / source).parent_path(), here})
        if (std::ranges::find(folders, folder) == folders.end()) folders.push_back(folder);
    return folders;
}

/// The first file that exists; the path itself if none does.
fs::path find_file(const fs::path& path, const std::vector<fs::path>& folders) {
    for (const fs::path& folder : folders)
        if (std::error_code none; fs::exists(folder / path, none)) return folder / path;
    return path;
}

/// "; looked in /games/bin, /home/me" after a relative path.
std::string searched(const std::vector<fs::path>& folders) {
    std::vector<std::string> names;
    for (const fs::path& folder : folders) names.push_back(folder.string());
    return fmt::format("; looked in {}", fmt::join(names, ", "));
}

std::vector<std::byte> read_image(const fs::path& path, const std::string& places) {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(path, error);
    std::ifstream file(path, std::ios::binary);
    if (error || !file) {
        const int reason = error ? error.value() : errno;
        fail(exit_of_open(reason), "{}: cannot read the image: {}{}", path.string(),
             system_reason(reason), places);
    }
    std::vector<std::byte> bytes(size);
    file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    return bytes;
}

}  // namespace

std::shared_ptr<const Bitmap> make_bitmap(Size size, std::vector<std::uint8_t> rgba) {
    if (size.width < 1 || size.height < 1 || size.width > longest_side ||
        size.height > longest_side)
        fail(Exit::usage, "a bitmap has sides of 1 to {} texels, not {}x{}", longest_side,
             size.width, size.height);
    if (rgba.size() != bytes_of(size))
        fail(Exit::usage, "a bitmap of {}x{} texels has {} bytes, four per texel, not {}",
             size.width, size.height, bytes_of(size), rgba.size());
    StateHash hash;
    hash.add(static_cast<std::uint64_t>(size.width));
    hash.add(static_cast<std::uint64_t>(size.height));
    hash.add(std::as_bytes(std::span(rgba)));
    return std::make_shared<const Bitmap>(Bitmap{size, std::move(rgba), hash.value()});
}

std::shared_ptr<const Bitmap> decode_bitmap(std::span<const std::byte> file,
                                            std::string_view name) {
    Size size;
    int channels_there = 0;
    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> texels(
        stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(file.data()),
                              static_cast<int>(file.size()), &size.width, &size.height,
                              &channels_there, channels),
        stbi_image_free);
    if (!texels) fail(Exit::usage, "{}: not a PNG or JPEG image: {}", name, stbi_failure_reason());
    return make_bitmap(size, {texels.get(), texels.get() + bytes_of(size)});
}

std::shared_ptr<const Bitmap> load_bitmap(const std::string& path, const char* source) {
    const std::vector<fs::path> folders = folders_of(source);
    const fs::path file = find_file(path, folders);
    return decode_bitmap(read_image(file, file.is_relative() ? searched(folders) : ""),
                         file.string());
}

}  // namespace oiler
