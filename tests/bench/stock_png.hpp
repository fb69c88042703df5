// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace oiler::bench {

/// Encodes RGB rows with stb_image_write as it comes. Returns the number of bytes.
[[nodiscard]] std::size_t encode_with_stock_stb(int width, int height,
                                                const std::vector<std::uint8_t>& rgb);

}  // namespace oiler::bench
