// SPDX-License-Identifier: MIT
#pragma once

#include <glad/gl.h>
#include <memory>
#include <string_view>
#include <unordered_map>

#include "oiler/core/size.hpp"
#include "oiler/picture/picture.hpp"

namespace oiler {

/// The functions of one context. A value, not glad's usual globals, so that one process can have a
/// window and an off-screen surface.
using Gl = GladGLContext;

/// Whether the functions are those of OpenGL ES, as in a browser.
[[nodiscard]] inline bool is_embedded(const Gl& gl) { return gl.ES_VERSION_2_0 != 0; }

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

/// The textures of the bitmaps that pictures show. One is kept while a game keeps its bitmap.
class Textures {
public:
    explicit Textures(const Gl& gl) : gl_(gl) {}

    /// Remembers the bitmaps of a picture, and forgets those that are gone.
    void update(const std::vector<Sprite>& sprites);
    void remember(const std::shared_ptr<const Bitmap>& bitmap);
    /// Makes the texture of a remembered bitmap current.
    void bind(const Bitmap& bitmap);

private:
    struct Entry {
        std::weak_ptr<const Bitmap> bitmap;
        std::unique_ptr<GlName> texture{};  ///< null until it is drawn
    };

    const Gl& gl_;
    std::unordered_map<const Bitmap*, Entry> entries_;
};

}  // namespace oiler
