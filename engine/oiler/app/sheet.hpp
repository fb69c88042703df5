// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "oiler/core/size.hpp"
#include "oiler/picture/picture.hpp"
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

}  // namespace oiler
