// SPDX-License-Identifier: MIT
#include "oiler/overlay/trails.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "oiler/game/look.hpp"
#include "oiler/picture/palette.hpp"

namespace oiler {
namespace {

constexpr double most_samples = 120;
constexpr int shades = 8;  ///< of a trail that fades

struct Stroke {
    float width;  ///< canvas units
    Colour colour;
    int layer;
};

/// Collects the points of a path, and adds them as lines that fade with their age. They fade to the
/// background, because transparent lines would show where they overlap.
class FadingLine {
public:
    FadingLine(Picture& picture, const Stroke& stroke) : picture_(picture), stroke_(stroke) {}
    ~FadingLine() { end(); }
    FadingLine(const FadingLine&) = delete;
    FadingLine& operator=(const FadingLine&) = delete;

    /// `freshness` is from 0 to 1, and grows.
    void add(Point point, double freshness) {
        const int shade = std::clamp(static_cast<int>(freshness * shades), 0, shades - 1);
        points_.push_back(point);
        if (shade == shade_) return;
        finish_piece();
        points_ = {point};
        shade_ = shade;
    }
    /// The next point begins another line.
    void end() {
        finish_piece();
        points_.clear();
    }

private:
    void finish_piece() {
        if (points_.size() < 2) return;
        const float share = static_cast<float>(shade_ + 1) / shades;
        picture_.polylines.push_back(
            {.points = std::move(points_),
             .width = stroke_.width,
             .colour = palette::mix(picture_.background, stroke_.colour, share),
             .layer = stroke_.layer});
    }

    Picture& picture_;
    Stroke stroke_;
    std::vector<Point> points_;
    int shade_ = 0;
};

}  // namespace

Trails::Trail& Trails::trail_of(Entity body) {
    const auto found = std::ranges::find(trails_, body, &Trail::body);
    return found == trails_.end() ? trails_.emplace_back(Trail{.body = body}) : *found;
}

void Trails::add(const DrawnBodies& drawn, const World& world, const std::vector<Entity>& bodies,
                 const std::vector<Ghost>& ghosts, double time) {
    for (Trail& trail : trails_) {
        while (!trail.samples.empty() && trail.samples.back().time >= time)
            trail.samples.pop_back();
        while (!trail.samples.empty() && trail.samples.front().time < time - duration)
            trail.samples.pop_front();
    }
    for (const Entity body : bodies) {
        const DrawnBodies::Body* const look = drawn.find(body);
        if (!look) continue;
        Trail& trail = trail_of(body);
        trail.look = *look;
        // The last sample is replaced until it is late enough after the one before.
        if (trail.samples.size() > 1 &&
            trail.samples.back().time - std::prev(trail.samples.end(), 2)->time <
                duration / most_samples)
            trail.samples.pop_back();
        const auto ghost = std::ranges::find(ghosts, body, &Ghost::body);
        std::optional<Point> off;
        if (ghost != ghosts.end()) off = to_point(ghost->truth - ghost->at);
        trail.samples.push_back({time, world.jumps(body), look->centre, off});
    }
    std::erase_if(trails_, [](const Trail& trail) { return trail.samples.empty(); });
}

void Trails::draw(Picture& picture, double factor) const {
    const auto scale = static_cast<float>(factor);
    for (const Trail& trail : trails_) {
        FadingLine drawn(picture, {2.5F, trail.look.colour, trail.look.layer});
        FadingLine truth(picture, {1, palette::purple, trail.look.layer});
        const double start = trail.samples.back().time - duration;
        const Sample* before = &trail.samples.front();
        for (const Sample& sample : trail.samples) {
            if (sample.jumps != before->jumps || sample.time - before->time > longest_frame) {
                drawn.end();
                truth.end();
            }
            before = &sample;
            const double freshness = (sample.time - start) / duration;
            drawn.add(sample.at, freshness);
            if (sample.off)
                truth.add(
                    {sample.at.x + scale * sample.off->x, sample.at.y + scale * sample.off->y},
                    freshness);
            else
                truth.end();
        }
    }
}

}  // namespace oiler
