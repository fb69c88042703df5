// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <memory>

#include "oiler/core/size.hpp"
#include "oiler/platform/surface.hpp"
#include "oiler/render/renderer.hpp"

namespace oiler {

/// Draws pictures off screen to measure how long that takes.
class DrawTimer {
public:
    /// Throws Error{no_display} without a provider of OpenGL.
    DrawTimer(Offscreen which, Size size)
        : surface_(open_offscreen(which)),
          renderer_([this](const char* name) { return surface_->procedure(name); }),
          size_(size) {}

    /// The time to draw a picture and to read its pixels: only then drawing has surely ended.
    [[nodiscard]] std::chrono::nanoseconds time(const Picture& picture) {
        const auto start = std::chrono::steady_clock::now();
        renderer_.draw(picture, size_);
        renderer_.read(pixels_);
        return std::chrono::steady_clock::now() - start;
    }

private:
    std::unique_ptr<Surface> surface_;
    Renderer renderer_;
    Size size_;
    Pixels pixels_;
};

}  // namespace oiler
