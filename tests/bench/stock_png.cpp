// SPDX-License-Identifier: MIT
#include "bench/stock_png.hpp"

#include <cstdlib>

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>

namespace oiler::bench {

std::size_t encode_with_stock_stb(int width, int height, const std::vector<std::uint8_t>& rgb) {
    int count = 0;
    unsigned char* const png =
        stbi_write_png_to_mem(rgb.data(), 3 * width, width, height, 3, &count);
    std::free(png);
    return static_cast<std::size_t>(count);
}

}  // namespace oiler::bench
