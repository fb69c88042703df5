// SPDX-License-Identifier: MIT
#include "oiler/render/framebuffer.hpp"

#include <algorithm>
#include <array>

#include "oiler/core/error.hpp"

namespace oiler {
namespace {

Size largest_frame(const Gl& gl) {
    GLint texture = 0;
    GLint renderbuffer = 0;
    std::array<GLint, 2> viewport{};
    gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
    gl.GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &renderbuffer);
    gl.GetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
    const int either = std::min(texture, renderbuffer);
    return {std::min(either, viewport[0]), std::min(either, viewport[1])};
}

}  // namespace

Framebuffer::Framebuffer(const Gl& gl)
    : gl_(gl),
      name_(gl.GenFramebuffers, gl.DeleteFramebuffers),
      colour_(gl.GenRenderbuffers, gl.DeleteRenderbuffers),
      largest_(largest_frame(gl)) {}

void Framebuffer::bind(Size size) {
    if (size.width < 1 || size.height < 1 || size.width > largest_.width ||
        size.height > largest_.height) {
        fail(Exit::usage, "cannot draw a frame of {}x{} pixels; choose a --size from 1x1 to {}x{}",
             size.width, size.height, largest_.width, largest_.height);
    }
    gl_.BindFramebuffer(GL_FRAMEBUFFER, name_);
    if (size != size_) {
        resize(size);
    }
    gl_.Viewport(0, 0, size.width, size.height);
}

void Framebuffer::resize(Size size) {
    gl_.BindRenderbuffer(GL_RENDERBUFFER, colour_);
    gl_.RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, size.width, size.height);
    gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_);
    if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        size_ = {};
        fail(Exit::usage, "no memory for a frame of {}x{} pixels; choose a smaller --size",
             size.width, size.height);
    }
    size_ = size;
}

}  // namespace oiler
