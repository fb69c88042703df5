// SPDX-License-Identifier: MIT
#include "oiler/capture/png.hpp"

#include <libdeflate.h>

#include <cassert>
#include <cstdlib>
#include <memory>
#include <new>
#include <utility>
#include <vector>

#include "oiler/core/error.hpp"
#include "oiler/core/state_hash.hpp"

namespace {

/// Memory that a thread uses again for its next image. A system takes longer to hand out fresh
/// pages than libdeflate takes to compress them.
class Scratch {
public:
    /// Returns null if there is not enough memory.
    void* take(std::size_t size) {
        Block* fitting = nullptr;
        for (Block& block : blocks_)
            if (!block.taken && block.size >= size && (!fitting || block.size < fitting->size))
                fitting = &block;
        if (!fitting) fitting = add(size);
        if (!fitting) return nullptr;
        fitting->taken = true;
        return fitting->bytes.get();
    }
    void give_back(const void* bytes) {
        for (Block& block : blocks_)
            if (block.bytes.get() == bytes) block.taken = false;
    }

private:
    struct Block {
        std::unique_ptr<unsigned char[]> bytes;
        std::size_t size;
        bool taken = false;
    };

    Block* add(std::size_t size) {
        std::erase_if(blocks_, [](const Block& block) { return !block.taken; });
        std::unique_ptr<unsigned char[]> bytes(new (std::nothrow) unsigned char[size]);
        if (!bytes) return nullptr;
        blocks_.push_back({std::move(bytes), size});
        return &blocks_.back();
    }

    std::vector<Block> blocks_;
};

Scratch& scratch() {
    thread_local Scratch own;
    return own;
}

/// stb's compressor. Returns a zlib stream in memory from scratch(), or null.
unsigned char* deflate_fast(unsigned char* bytes, int count, int* compressed_count, int) {
    constexpr int fastest = 1;
    using Compressor =
        std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)>;
    thread_local const Compressor compressor(libdeflate_alloc_compressor(fastest),
                                             libdeflate_free_compressor);
    if (!compressor) return nullptr;
    const auto size = static_cast<std::size_t>(count);
    const std::size_t bound = libdeflate_zlib_compress_bound(compressor.get(), size);
    auto* compressed = static_cast<unsigned char*>(scratch().take(bound));
    if (compressed == nullptr) return nullptr;
    *compressed_count = static_cast<int>(
        libdeflate_zlib_compress(compressor.get(), bytes, size, compressed, bound));
    return compressed;
}

}  // namespace

namespace {

/// The largest piece of memory that the decoder may take: compressed data may have more than the
/// header says.
thread_local std::size_t most_decoded = 0;

void* take_decoded(void* bytes, std::size_t size) {
    return size > most_decoded ? nullptr : std::realloc(bytes, size);
}

}  // namespace

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#define STBIW_ZLIB_COMPRESS deflate_fast
#define STBIW_MALLOC(size) scratch().take(size)
#define STBIW_FREE(bytes) scratch().give_back(bytes)
#define STBIW_REALLOC(bytes, size) nullptr  // only of the compressor that libdeflate replaces
#include <stb/stb_image_write.h>
#define STBI_MALLOC(size) take_decoded(nullptr, size)
#define STBI_REALLOC(bytes, size) take_decoded(bytes, size)
#define STBI_FREE(bytes) std::free(bytes)
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#include <stb/stb_image.h>

namespace oiler {
namespace {

constexpr int channels = 3;

/// Limits a frame to 1 GiB: stb counts in int, and deflate's bound is slightly larger than its
/// input.
void require_encodable(Size size) {
    constexpr std::int64_t limit = 1 << 30;
    const std::int64_t filtered_row = std::int64_t{size.width} * channels + 1;
    if (size.width < 1 || size.height < 1 || filtered_row > limit / size.height)
        fail(Exit::usage,
             "cannot encode a frame of {}x{} pixels; choose a size from 1x1 up to a gigabyte",
             size.width, size.height);
}

const stbi_uc* bytes_of(std::span<const std::byte> png) {
    return reinterpret_cast<const stbi_uc*>(png.data());
}

[[noreturn]] void refuse_png(std::string_view file) {
    fail(Exit::usage, "{}: not a valid PNG ({}); capture again", file, stbi_failure_reason());
}

/// Sets stb's global variable for the filter, once, so that threads may encode.
void choose_filter() {
    constexpr int up = 2;
    [[maybe_unused]] static const int chosen = stbi_write_force_png_filter = up;
}

}  // namespace

std::vector<std::byte> encode_png(Size size, std::span<const std::uint8_t> rgb_bottom_up) {
    require_encodable(size);
    const int row = size.width * channels;
    assert(rgb_bottom_up.size() == static_cast<std::size_t>(row) * size.height);
    choose_filter();
    const std::uint8_t* top = rgb_bottom_up.data() + std::ptrdiff_t{row} * (size.height - 1);
    int count = 0;
    const auto give_back = [](const unsigned char* bytes) { scratch().give_back(bytes); };
    const std::unique_ptr<unsigned char, decltype(give_back)> png(
        stbi_write_png_to_mem(top, -row, size.width, size.height, channels, &count), give_back);
    if (!png) throw std::bad_alloc();
    const auto* first = reinterpret_cast<const std::byte*>(png.get());
    return {first, first + count};
}

Size size_of_png(std::span<const std::byte> png, std::string_view file) {
    most_decoded = std::size_t{1} << 16;
    Size size;
    int channels_there = 0;
    if (stbi_info_from_memory(bytes_of(png), static_cast<int>(png.size()), &size.width,
                              &size.height, &channels_there) == 0)
        refuse_png(file);
    return size;
}

Image decode_png(std::span<const std::byte> png, std::string_view file) {
    Size size = size_of_png(png, file);
    const auto pixel_count =
        static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
    constexpr std::size_t most_bytes_of_pixel = 9;  // four channels of 16 bits, and a filter
    constexpr std::size_t most_tables = std::size_t{1} << 16;
    most_decoded = most_bytes_of_pixel * pixel_count + 2 * png.size() + most_tables;
    int channels_there = 0;
    stbi_set_flip_vertically_on_load_thread(1);
    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
        stbi_load_from_memory(bytes_of(png), static_cast<int>(png.size()), &size.width,
                              &size.height, &channels_there, channels),
        stbi_image_free);
    if (!pixels) refuse_png(file);
    return {size, {pixels.get(), pixels.get() + channels * pixel_count}};
}

std::uint64_t hash_top_down(Size size, std::span<const std::uint8_t> rgb_bottom_up) {
    const auto row = static_cast<std::size_t>(size.width) * channels;
    StateHash hash;
    for (std::size_t y = rgb_bottom_up.size() / row; y-- > 0;)
        hash.add(std::as_bytes(rgb_bottom_up.subspan(y * row, row)));
    return hash.value();
}

}  // namespace oiler
