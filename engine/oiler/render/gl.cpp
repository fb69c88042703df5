// SPDX-License-Identifier: MIT
#include "oiler/render/gl.hpp"

#include <algorithm>
#include <array>

#include "oiler/core/error.hpp"

namespace oiler {
namespace {

/// The first lines of a shader of OpenGL ES, in place of the `#version` of OpenGL.
constexpr std::string_view start_of_embedded =
    "#version 300 es\n"
    "precision highp float;\n"
    "precision highp int;\n"
    "precision highp sampler2D;\n"
    "precision highp usampler2D;\n";

void attach(const Gl& gl, GLuint program, GLenum kind, std::string_view source) {
    const GLuint shader = gl.CreateShader(kind);
    const std::string_view rest = source.substr(source.find('\n') + 1);
    const std::string_view start =
        is_embedded(gl) ? start_of_embedded : source.substr(0, source.size() - rest.size());
    const char* const texts[]{start.data(), rest.data()};
    const GLint lengths[]{static_cast<GLint>(start.size()), static_cast<GLint>(rest.size())};
    gl.ShaderSource(shader, 2, texts, lengths);
    gl.CompileShader(shader);
    gl.AttachShader(program, shader);
    gl.DeleteShader(shader);
}

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

GlProgram::GlProgram(const Gl& gl, std::string_view vertex, std::string_view fragment)
    : gl_(gl), name_(gl.CreateProgram()) {
    attach(gl, name_, GL_VERTEX_SHADER, vertex);
    attach(gl, name_, GL_FRAGMENT_SHADER, fragment);
    gl.LinkProgram(name_);
    GLint linked = GL_FALSE;
    gl.GetProgramiv(name_, GL_LINK_STATUS, &linked);
    if (linked == GL_FALSE) {
        std::array<char, 256> reason{};
        gl.GetProgramInfoLog(name_, reason.size(), nullptr, reason.data());
        gl.DeleteProgram(name_);
        fail(Exit::no_display, "the GL driver refuses Oiler's shaders ({}); try --surface egl",
             reason.data());
    }
}

void GlProgram::use(int width, int height) const {
    gl_.UseProgram(name_);
    gl_.Uniform2f(gl_.GetUniformLocation(name_, "frame"), static_cast<float>(width),
                  static_cast<float>(height));
}

Framebuffer::Framebuffer(const Gl& gl)
    : gl_(gl),
      name_(gl.GenFramebuffers, gl.DeleteFramebuffers),
      colour_(gl.GenRenderbuffers, gl.DeleteRenderbuffers),
      largest_(largest_frame(gl)) {}

void Framebuffer::bind(Size size) {
    if (size.width < 1 || size.height < 1 || size.width > largest_.width ||
        size.height > largest_.height)
        fail(Exit::usage, "cannot draw a frame of {}x{} pixels; choose a --size from 1x1 to {}x{}",
             size.width, size.height, largest_.width, largest_.height);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, name_);
    if (size != size_) resize(size);
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

void Textures::update(const std::vector<Sprite>& sprites) {
    std::erase_if(entries_, [](const auto& entry) { return entry.second.bitmap.expired(); });
    for (const Sprite& sprite : sprites)
        if (sprite.bitmap) remember(sprite.bitmap);
}

void Textures::remember(const std::shared_ptr<const Bitmap>& bitmap) {
    entries_.try_emplace(bitmap.get(), Entry{bitmap});
}

void Textures::bind(const Bitmap& bitmap) {
    std::unique_ptr<GlName>& texture = entries_.at(&bitmap).texture;
    const bool is_new = !texture;
    if (is_new) texture = std::make_unique<GlName>(gl_.GenTextures, gl_.DeleteTextures);
    gl_.ActiveTexture(GL_TEXTURE0);
    gl_.BindTexture(GL_TEXTURE_2D, *texture);
    gl_.BindSampler(0, 0);
    if (!is_new) return;
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, bitmap.size.width, bitmap.size.height, 0, GL_RGBA,
                   GL_UNSIGNED_BYTE, bitmap.rgba.data());
}

}  // namespace oiler
