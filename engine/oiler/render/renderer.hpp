// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "oiler/core/size.hpp"
#include "oiler/picture/picture.hpp"

namespace oiler {

/// Rows of RGB bytes, bottom row first, as OpenGL reads them.
struct Pixels {
    Size size;
    std::vector<std::uint8_t> rgb;
};

/// Triangles over a picture, such as those of a user interface. Places are in pixels from the upper
/// left corner of the frame.
struct Overlay {
    struct Vertex {
        Point at;
        Point texel;  ///< in the bitmap, from 0 to 1
        Colour colour;
    };
    /// Triangles that are seen within a box.
    struct Part {
        std::size_t first = 0;  ///< index
        std::size_t count = 0;  ///< of indices
        int left = 0;
        int top = 0;
        int right = 0;
        int bottom = 0;
    };

    std::vector<Vertex> vertices{};
    std::vector<std::uint32_t> indices{};
    std::vector<Part> parts{};
    std::shared_ptr<const Bitmap> bitmap{};
};

/// Draws pictures into its own framebuffer object, so that a window, OSMesa and EGL show the same
/// pixels. The context, GL 3.3 core or ES 3.0, must
/// stay current for its lifetime.
class Renderer {
public:
    using LoadProcedure = std::function<void (*(const char*))()>;

    /// Throws Error{no_display} if the context is older.
    explicit Renderer(const LoadProcedure& load);
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// Throws Error{usage} if the provider cannot draw frames of that size.
    void draw(const Picture& picture, Size size) { draw(picture, size, size); }
    /// Draws the picture in `view`, the part at the lower left. The rest has the colour of its
    /// background.
    void draw(const Picture& picture, Size size, Size view);
    /// Draws over the last frame.
    void draw_over(const Overlay& overlay);
    /// Draws a picture over the last frame in `view`, without background, bars and sprites.
    void draw_over(const Picture& picture, Size view);
    /// Reads the last frame. The memory of `pixels` is reused.
    void read(Pixels& pixels) const;
    /// Copies the last frame to framebuffer 0, of a window of the same size.
    void blit() const;

    /// The font of labels, a TrueType file.
    [[nodiscard]] static std::span<const char> font();

    [[nodiscard]] std::string gl_renderer() const;
    [[nodiscard]] std::string gl_version() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace oiler
