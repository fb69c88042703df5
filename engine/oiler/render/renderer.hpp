// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "oiler/core/size.hpp"
#include "oiler/picture/picture.hpp"

namespace oiler {

/// Rows of RGB bytes, the lowest row first, as OpenGL reads them.
struct Pixels {
    Size size;
    std::vector<std::uint8_t> rgb;
};

/// Draws pictures into one framebuffer object of its own, so that a window, OSMesa and EGL show the
/// same pixels. Needs a current GL 3.3 core context for as long as it lives.
class Renderer {
public:
    using LoadProcedure = std::function<void (*(const char*))()>;

    /// Throws Error{no_display} where the context is older than 3.3.
    explicit Renderer(const LoadProcedure& load);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// Throws Error{usage} where `size` exceeds what the provider can draw.
    void draw(const Picture& picture, Size size);
    /// What was drawn last; `pixels` is reused.
    void read(Pixels& pixels) const;
    /// Copies what was drawn last to framebuffer 0, a window's of the same size.
    void blit() const;

    [[nodiscard]] std::string gl_renderer() const;
    [[nodiscard]] std::string gl_version() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace oiler
