// SPDX-License-Identifier: MIT
#pragma once

#include <glad/gl.h>

#include <string_view>

namespace oiler {

/// The functions of one context. A value, not glad's usual globals, so that one process can have a
/// window and an off-screen surface.
using Gl = GladGLContext;

/// The name of a GL object. The destructor deletes the object.
class GlName {
public:
    using Create = void (*)(GLsizei, GLuint*);
    using Delete = void (*)(GLsizei, const GLuint*);

    GlName(Create create, Delete remove) : delete_(remove) { create(1, &name_); }
    ~GlName() { delete_(1, &name_); }
    GlName(const GlName&) = delete;
    GlName& operator=(const GlName&) = delete;

    operator GLuint() const { return name_; }

private:
    Delete delete_;
    GLuint name_ = 0;
};

/// A linked shader program. Throws Error{no_display} if the driver refuses the embedded shaders.
class GlProgram {
public:
    GlProgram(const Gl& gl, std::string_view vertex, std::string_view fragment);
    ~GlProgram() { gl_.DeleteProgram(name_); }
    GlProgram(const GlProgram&) = delete;
    GlProgram& operator=(const GlProgram&) = delete;

    /// Makes it current for a frame of that size in pixels.
    void use(int width, int height) const;

private:
    const Gl& gl_;
    GLuint name_;
};

}  // namespace oiler
