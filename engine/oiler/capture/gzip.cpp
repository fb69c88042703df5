// SPDX-License-Identifier: MIT
#include "oiler/capture/gzip.hpp"

#include <libdeflate.h>

#include <memory>
#include <new>

#include "oiler/core/error.hpp"

namespace oiler {
namespace {

constexpr std::size_t largest_member = std::size_t{1} << 28;

}  // namespace

std::vector<std::byte> gzip(std::string_view text) {
    constexpr int level = 6;
    const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
        libdeflate_alloc_compressor(level), libdeflate_free_compressor);
    if (!compressor) throw std::bad_alloc();
    std::vector<std::byte> bytes(libdeflate_gzip_compress_bound(compressor.get(), text.size()));
    bytes.resize(libdeflate_gzip_compress(compressor.get(), text.data(), text.size(), bytes.data(),
                                          bytes.size()));
    return bytes;
}

std::string gunzip(std::span<const std::byte> bytes, std::string_view file) {
    const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)>
        decompressor(libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
    if (!decompressor) throw std::bad_alloc();
    std::string text;
    std::string member(1 << 16, '\0');
    while (!bytes.empty()) {
        std::size_t read = 0;
        std::size_t written = 0;
        const auto result =
            libdeflate_gzip_decompress_ex(decompressor.get(), bytes.data(), bytes.size(),
                                          member.data(), member.size(), &read, &written);
        if (result == LIBDEFLATE_INSUFFICIENT_SPACE && member.size() < largest_member) {
            member.resize(4 * member.size());
            continue;
        }
        if (result != LIBDEFLATE_SUCCESS)
            fail(Exit::usage, "{}: damaged gzip file; capture again", file);
        text.append(member, 0, written);
        bytes = bytes.subspan(read);
    }
    return text;
}

}  // namespace oiler
