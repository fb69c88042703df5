// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "oiler/core/size.hpp"
#include "oiler/core/team.hpp"
#include "oiler/render/layout.hpp"

namespace oiler {

/// Consecutive discs that are drawn in the same way.
struct DiscRun {
    std::span<const PlacedDisc> discs;
    bool is_splatted = false;  ///< false: a quad each
};

/// Decides how each disc of a layer is drawn, in the order of the list. Long runs of small discs
/// are splatted: a rasteriser on a CPU sets up a quad in the time of fifty pixels. Short runs would
/// not pay for the image. With OpenGL ES, a browser may set up a quad in the time of 10,000 pixels.
[[nodiscard]] std::vector<DiscRun> runs_of(std::span<const PlacedDisc> discs, Size frame,
                                           bool is_embedded);

/// Draws discs into an image on the CPU. They have the coverage of the disc shader; sixteen bits
/// per channel lose less than the eight of a frame. Results do not depend on the number of threads.
class Splats {
public:
    /// Red, green, blue, each multiplied by alpha, and alpha; red in the lowest sixteen bits.
    using Texel = std::uint64_t;

    /// Draws the discs over a transparent image, in their order.
    void draw(std::span<const PlacedDisc> discs, Size frame);
    /// Bottom row first.
    [[nodiscard]] const std::vector<Texel>& texels() const { return texels_; }

private:
    std::optional<Team> team_;  ///< none before the first image
    std::vector<Texel> texels_;
};

}  // namespace oiler
