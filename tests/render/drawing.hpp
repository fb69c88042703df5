// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/platform/surface.hpp"
#include "oiler/render/renderer.hpp"
#include "support/test.hpp"

namespace oiler::test {

/// A surface with a renderer; null if the provider is not installed.
struct Studio {
    explicit Studio(std::unique_ptr<Surface> on)
        : surface(std::move(on)),
          renderer([this](const char* name) { return surface->procedure(name); }) {}

    Pixels draw(const Picture& picture, Size size = {640, 360}) {
        Pixels pixels;
        renderer.draw(picture, size);
        renderer.read(pixels);
        return pixels;
    }

    std::unique_ptr<Surface> surface;
    Renderer renderer;
};

inline std::unique_ptr<Studio> open_studio(Offscreen which) {
    std::unique_ptr<Surface> surface;
    try {
        surface = open_offscreen(which);
    } catch (const Error&) {
        return nullptr;
    }
    return std::make_unique<Studio>(std::move(surface));
}

inline int red(const Pixels& pixels, int x, int y) {
    return pixels.rgb.at(
        (static_cast<std::size_t>(y) * static_cast<std::size_t>(pixels.size.width) +
         static_cast<std::size_t>(x)) *
        3);
}

/// Coverage of a pixel by black on white, from 0 to 1.
inline double coverage(const Pixels& pixels, int x, int y) {
    return (255 - red(pixels, x, y)) / 255.0;
}

inline double total_coverage(const Pixels& pixels) {
    double sum = 0;
    for (std::size_t i = 0; i < pixels.rgb.size(); i += 3) {
        sum += (255 - pixels.rgb[i]) / 255.0;
    }
    return sum;
}

// Blending in eight bits rounds alpha and both products by up to half a step each.
constexpr double blend_rounding = 1.5 / 255;

class Drawing : public testing::Test {
protected:
    void SetUp() override {
        if (!studio_) GTEST_SKIP() << "neither OSMesa nor EGL is installed";
    }

    Pixels draw(const Picture& picture, Size size = {640, 360}) {
        return studio_->draw(picture, size);
    }

    /// Mean area over sixteen sub-pixel positions. It approximates the integral like samples on a
    /// grid four times as fine.
    template <class PictureAt>
    double mean_coverage(PictureAt picture_at) {
        double sum = 0;
        for (int i = 0; i < 16; ++i) {
            const Point shift{static_cast<float>(i % 4) / 4, static_cast<float>(i / 4) / 4};
            sum += total_coverage(draw(picture_at(shift)));
        }
        return sum / 16;
    }

    std::unique_ptr<Studio> studio_ = open_studio(Offscreen::automatic);
};

/// Bounding box of the pixels that are not white.
struct Ink {
    int left = 1 << 20;
    int right = -1;
    int bottom = 1 << 20;
    int top = -1;
    int darkest = 255;
};

inline Ink ink(const Pixels& pixels) {
    Ink box;
    for (int y = 0; y < pixels.size.height; ++y) {
        for (int x = 0; x < pixels.size.width; ++x) {
            if (red(pixels, x, y) < 250) {
                box.left = std::min(box.left, x);
                box.right = std::max(box.right, x + 1);
                box.bottom = std::min(box.bottom, y);
                box.top = std::max(box.top, y + 1);
            }
            box.darkest = std::min(box.darkest, red(pixels, x, y));
        }
    }
    return box;
}

inline Picture of_line(std::vector<Point> points, float width) {
    Picture picture;
    picture.polylines.push_back({{}, std::move(points), width, {}, Space::canvas});
    return picture;
}

inline Picture of_disc(Point centre, float radius) {
    Picture picture;
    picture.discs.push_back({{}, centre, radius, {}, Space::canvas});
    return picture;
}

inline Picture of_text(std::string text, Point at, float size, Align align = Align::left) {
    Picture picture;
    picture.labels.push_back({{}, at, std::move(text), size, {}, align, Space::canvas});
    return picture;
}

inline double distance_to_segment(double x, double y, Point from, Point to) {
    const double dx = double{to.x} - from.x;
    const double dy = double{to.y} - from.y;
    const double along = ((x - from.x) * dx + (y - from.y) * dy) / (dx * dx + dy * dy);
    const double t = std::fmin(1, std::fmax(0, along));
    return std::hypot(x - (from.x + t * dx), y - (from.y + t * dy));
}

inline double distance_to_line(double x, double y, const std::vector<Point>& points) {
    double least = 1e300;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        least = std::fmin(least, distance_to_segment(x, y, points[i], points[i + 1]));
    }
    return least;
}

/// A picture with all kinds of elements that a game draws.
inline Picture rich_picture() {
    Picture picture;
    picture.background = {250, 250, 252, 255};
    picture.camera = {{1, -2}, 12};
    Polyline coil{{}, {}, 2.5F, {40, 44, 52, 255}, Space::world};
    Polyline curve{{}, {}, 0.7F, {214, 39, 40, 200}, Space::canvas};
    for (int i = 0; i <= 400; ++i) {
        const auto s = static_cast<float>(i) / 400;
        coil.points.push_back({-6 + 9 * s + 0.3F * std::cos(90 * s), 0.6F * std::sin(90 * s)});
        curve.points.push_back({640 * s, 180 + 150 * std::exp(-2 * s) * std::cos(40 * s)});
    }
    picture.polylines = {coil, curve};
    for (int i = 0; i < 40; ++i) {
        const auto s = static_cast<float>(i);
        const auto shade = static_cast<std::uint8_t>(6 * i);
        picture.discs.push_back({{},
                                 {-8 + 0.43F * s, -4 + 0.11F * s},
                                 0.02F * s,
                                 {shade, 100, 200, static_cast<std::uint8_t>(255 - shade)},
                                 Space::world});
        picture.labels.push_back({{},
                                  {15.3F * s, 9.1F * s},
                                  "ω = √(k/m) · ζ² − 10",
                                  9 + s / 10,
                                  {31, shade, 180, 255},
                                  Align::centre,
                                  Space::canvas});
    }
    return picture;
}

}  // namespace oiler::test
