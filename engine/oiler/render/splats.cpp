// SPDX-License-Identifier: MIT
#include "oiler/render/splats.hpp"

#include <algorithm>
#include <cmath>
#include <thread>

namespace oiler {
namespace {

constexpr float largest_splat = 4;             // pixels of radius
constexpr std::size_t fewest_splats = 10'000;  // in a run
constexpr std::size_t fewest_embedded_splats = 500;
constexpr std::size_t pixels_per_quad = 64;  // of the image, in the time of a quad
constexpr unsigned most_threads = 8;

std::size_t shortest_run(Size frame, bool is_embedded) {
    if (is_embedded) return fewest_embedded_splats;
    return std::max(fewest_splats, static_cast<std::size_t>(frame.width) *
                                       static_cast<std::size_t>(frame.height) / pixels_per_quad);
}

/// The pixels whose centres are within `reach` of a coordinate.
struct Range {
    Range(float at, float reach, int size)
        : begin(static_cast<int>(std::max(at - reach + 0.5F, 0.0F))),
          end(static_cast<int>(std::min(at + reach + 0.5F, static_cast<float>(size)))) {}

    int begin;
    int end;
};

/// A mixture of texels as the disc shader and its blending would make it. Two channels are
/// multiplied at once: no product carries into the next 32 bits.
class Ink {
public:
    explicit Ink(Colour colour)
        : red_and_blue_(wide(colour.r) | wide(colour.b) << 32U),
          green_and_alpha_(wide(colour.g) | wide(255) << 32U) {}

    /// `share` of the colour is of 65536.
    [[nodiscard]] Splats::Texel over(Splats::Texel under, std::uint64_t share) const {
        return mix(red_and_blue_, under & lanes, share) |
               mix(green_and_alpha_, under >> 16U & lanes, share) << 16U;
    }

    static constexpr std::uint64_t whole = 65536;

private:
    static constexpr std::uint64_t lanes = 0x0000'FFFF'0000'FFFF;
    static constexpr std::uint64_t half = 0x0000'8000'0000'8000;

    static std::uint64_t wide(std::uint8_t channel) { return channel * std::uint64_t{257}; }
    static std::uint64_t mix(std::uint64_t over, std::uint64_t under, std::uint64_t share) {
        return (over * share + under * (whole - share) + half) >> 16U & lanes;
    }

    std::uint64_t red_and_blue_;
    std::uint64_t green_and_alpha_;
};

/// Draws the rows `part`, `part` + `parts`, …, so that each thread has its share of any heap.
void splat(const PlacedDisc& disc, Size frame, int part, int parts, Splats::Texel* texels) {
    const float reach = disc.radius + 0.5F;
    const Range rows(disc.centre.y, reach, frame.height);
    const Range columns(disc.centre.x, reach, frame.width);
    const float opacity =
        disc.strength * static_cast<float>(disc.colour.a) * (float{Ink::whole} / 255);
    const Ink ink(disc.colour);
    for (int y = rows.begin + (part + parts - rows.begin % parts) % parts; y < rows.end;
         y += parts) {
        const float dy = static_cast<float>(y) + 0.5F - disc.centre.y;
        Splats::Texel* const row = texels + std::ptrdiff_t{y} * frame.width;
        for (int x = columns.begin; x < columns.end; ++x) {
            const float dx = static_cast<float>(x) + 0.5F - disc.centre.x;
            const float coverage = std::clamp(reach - std::sqrt(dx * dx + dy * dy), 0.0F, 1.0F);
            row[x] = ink.over(row[x], static_cast<std::uint32_t>(coverage * opacity + 0.5F));
        }
    }
}

}  // namespace

std::vector<DiscRun> runs_of(std::span<const PlacedDisc> discs, Size frame, bool is_embedded) {
    const std::size_t shortest = shortest_run(frame, is_embedded);
    std::vector<DiscRun> runs;
    std::size_t done = 0;
    const auto draw_until = [&](std::size_t end, bool is_splatted) {
        if (done < end) runs.push_back({discs.subspan(done, end - done), is_splatted});
        done = end;
    };
    for (std::size_t first = 0; first < discs.size(); ++first) {
        std::size_t end = first;
        while (end < discs.size() && discs[end].radius <= largest_splat) ++end;
        if (end - first >= shortest) {
            draw_until(first, false);
            draw_until(end, true);
        }
        first = end;
    }
    draw_until(discs.size(), false);
    return runs;
}

void Splats::draw(std::span<const PlacedDisc> discs, Size frame) {
    if (!team_)
        team_.emplace(std::clamp(std::thread::hardware_concurrency(), 1U, most_threads), false);
    texels_.assign(static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height),
                   {});
    team_->run([&](std::size_t part) {
        for (const PlacedDisc& disc : discs)
            splat(disc, frame, static_cast<int>(part), static_cast<int>(team_->size()),
                  texels_.data());
    });
}

}  // namespace oiler
