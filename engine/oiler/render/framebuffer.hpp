// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "oiler/core/size.hpp"
#include "oiler/render/gl.hpp"

namespace oiler {

/// The framebuffer of a renderer, the same for every surface: EGL without a surface has no default
/// framebuffer, and OSMesa fills its own only at glFinish.
class Framebuffer {
public:
    explicit Framebuffer(const Gl& gl);

    /// Makes it current with that size.
    /// Throws Error{usage} if the provider cannot draw such a large frame.
    void bind(Size size);
    [[nodiscard]] Size size() const { return size_; }
    [[nodiscard]] GLuint name() const { return name_; }

private:
    void resize(Size size);

    const Gl& gl_;
    GlName name_;
    GlName colour_;
    Size largest_;
    Size size_;
};

}  // namespace oiler
