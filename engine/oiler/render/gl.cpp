// SPDX-License-Identifier: MIT
#include "oiler/render/gl.hpp"

#include <array>

#include "oiler/core/error.hpp"

namespace oiler {
namespace {

void attach(const Gl& gl, GLuint program, GLenum kind, std::string_view source) {
    const GLuint shader = gl.CreateShader(kind);
    const char* text = source.data();
    const auto length = static_cast<GLint>(source.size());
    gl.ShaderSource(shader, 1, &text, &length);
    gl.CompileShader(shader);
    gl.AttachShader(program, shader);
    gl.DeleteShader(shader);
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
        fail(Exit::no_display, "the GL driver refuses Oiler's shaders ({}); try --surface osmesa",
             reason.data());
    }
}

void GlProgram::use(int width, int height) const {
    gl_.UseProgram(name_);
    gl_.Uniform2f(gl_.GetUniformLocation(name_, "frame"), static_cast<float>(width),
                  static_cast<float>(height));
}

}  // namespace oiler
