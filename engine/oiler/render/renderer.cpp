// SPDX-License-Identifier: MIT
#include "oiler/render/renderer.hpp"

#include <cstddef>
#include <span>
#include <string_view>
#include <utility>

#include "oiler/core/error.hpp"
#include "oiler/render/embedded.hpp"
#include "oiler/render/gl.hpp"
#include "oiler/render/layout.hpp"
#include "oiler/render/splats.hpp"

namespace oiler {
namespace {

bool says_embedded(const Gl& gl) {
    const auto* const version =
        gl.GetString ? reinterpret_cast<const char*>(gl.GetString(GL_VERSION)) : nullptr;
    return version && std::string_view(version).starts_with("OpenGL ES");
}

Gl load_functions(const Renderer::LoadProcedure& load) {
    Gl gl{};
    const auto call = [](void* user, const char* name) -> GLADapiproc {
        return (*static_cast<const Renderer::LoadProcedure*>(user))(name);
    };
    const auto user = const_cast<Renderer::LoadProcedure*>(&load);
    int version = gladLoadGLContextUserPtr(&gl, call, user);
    const bool is_es = says_embedded(gl);
    if (is_es) version = gladLoadGLES2ContextUserPtr(&(gl = {}), call, user);
    const int least = is_es ? 30 : 33;
    if (GLAD_VERSION_MAJOR(version) * 10 + GLAD_VERSION_MINOR(version) < least)
        fail(Exit::no_display,
             "this surface offers OpenGL {}.{}; Oiler needs 3.3, or ES 3.0; try --headless",
             GLAD_VERSION_MAJOR(version), GLAD_VERSION_MINOR(version));
    return gl;
}

/// Rows of three of the four bytes of each pixel.
std::vector<std::uint8_t> without_alpha(std::span<const std::uint8_t> rgba) {
    std::vector<std::uint8_t> rgb;
    rgb.reserve(rgba.size() / 4 * 3);
    for (std::size_t i = 0; i < rgba.size(); i += 4)
        rgb.insert(rgb.end(), {rgba[i], rgba[i + 1], rgba[i + 2]});
    return rgb;
}

const void* as_pointer(std::size_t offset) { return reinterpret_cast<const void*>(offset); }

/// An attribute of a vertex or an instance.
struct Attribute {
    GLint count;
    GLenum type;  ///< bytes are the channels of a colour
    std::size_t offset;
};

/// The attributes of a vertex, or of an instance if `divisor` is 1, in the order of their
/// locations.
struct Attributes {
    std::size_t stride = 0;
    GLuint divisor = 0;
    std::vector<Attribute> all{};

    void describe(const Gl& gl) const {
        const auto size = static_cast<GLsizei>(stride);
        for (GLuint location = 0; location < all.size(); ++location) {
            const auto& [count, type, offset] = all[location];
            const GLboolean is_colour = type == GL_UNSIGNED_BYTE ? GL_TRUE : GL_FALSE;
            if (type == GL_INT)
                gl.VertexAttribIPointer(location, count, type, size, as_pointer(offset));
            else
                gl.VertexAttribPointer(location, count, type, is_colour, size, as_pointer(offset));
            gl.VertexAttribDivisor(location, divisor);
            gl.EnableVertexAttribArray(location);
        }
    }
};

/// Buffers of vertices and their indices, and the program that draws them.
struct Batch {
    Batch(const Gl& gl, std::string_view vertex, std::string_view fragment,
          const Attributes& attributes)
        : program(gl, vertex, fragment),
          array(gl.GenVertexArrays, gl.DeleteVertexArrays),
          buffer(gl.GenBuffers, gl.DeleteBuffers),
          indices(gl.GenBuffers, gl.DeleteBuffers) {
        gl.BindVertexArray(array);
        gl.BindBuffer(GL_ARRAY_BUFFER, buffer);
        gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices);
        attributes.describe(gl);
    }
    /// Makes it current, for a frame of that size.
    void use(const Gl& gl, Size size) const {
        program.use(size.width, size.height);
        gl.BindVertexArray(array);
        gl.BindBuffer(GL_ARRAY_BUFFER, buffer);
    }

    GlProgram program;
    GlName array;
    GlName buffer;
    GlName indices;
};

template <class Item>
void upload(const Gl& gl, GLenum target, std::span<const Item> items) {
    gl.BufferData(target, static_cast<GLsizeiptr>(items.size_bytes()), items.data(),
                  GL_STREAM_DRAW);
}

}  // namespace

struct Renderer::Impl {
    explicit Impl(const LoadProcedure& load)
        : gl(load_functions(load)),
          framebuffer(gl),
          sprites(gl, embedded::sprite_vert(), embedded::sprite_frag(),
                  {sizeof(PlacedSprite),
                   1,
                   {{4, GL_FLOAT, offsetof(PlacedSprite, centre)},
                    {3, GL_FLOAT, offsetof(PlacedSprite, direction)},
                    {4, GL_FLOAT, offsetof(PlacedSprite, start)},
                    {4, GL_UNSIGNED_BYTE, offsetof(PlacedSprite, tint)}}}),
          lines(gl, embedded::line_vert(), embedded::line_frag(),
                {sizeof(LineVertex),
                 0,
                 {{2, GL_FLOAT, offsetof(LineVertex, position)},
                  {2, GL_FLOAT, offsetof(LineVertex, across)},
                  {2, GL_FLOAT, offsetof(LineVertex, half_width)},
                  {4, GL_UNSIGNED_BYTE, offsetof(LineVertex, colour)}}}),
          discs(gl, embedded::disc_vert(), embedded::disc_frag(),
                {sizeof(PlacedDisc),
                 1,
                 {{2, GL_FLOAT, offsetof(PlacedDisc, centre)},
                  {2, GL_FLOAT, offsetof(PlacedDisc, radius)},
                  {4, GL_UNSIGNED_BYTE, offsetof(PlacedDisc, colour)}}}),
          splat_image(gl, embedded::splats_vert(), embedded::splats_frag(), {}),
          text(gl, embedded::text_vert(), embedded::text_frag(),
               {sizeof(PlacedGlyph),
                1,
                {{4, GL_INT, offsetof(PlacedGlyph, box)},
                 {2, GL_INT, offsetof(PlacedGlyph, atlas)},
                 {4, GL_UNSIGNED_BYTE, offsetof(PlacedGlyph, colour)}}}),
          overlays(gl, embedded::overlay_vert(), embedded::overlay_frag(),
                   {sizeof(Overlay::Vertex),
                    0,
                    {{2, GL_FLOAT, offsetof(Overlay::Vertex, at)},
                     {2, GL_FLOAT, offsetof(Overlay::Vertex, texel)},
                     {4, GL_UNSIGNED_BYTE, offsetof(Overlay::Vertex, colour)}}}),
          atlas(gl.GenTextures, gl.DeleteTextures),
          splat_texels(gl.GenTextures, gl.DeleteTextures),
          textures(gl) {
        for (const GLuint texture : {GLuint{atlas}, GLuint{splat_texels}}) {
            gl.BindTexture(GL_TEXTURE_2D, texture);
            gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
            gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        }
    }

    void clear(Colour colour) const {
        const auto share = [](std::uint8_t channel) { return static_cast<float>(channel) / 255; };
        gl.ClearColor(share(colour.r), share(colour.g), share(colour.b), 1);
        gl.Clear(GL_COLOR_BUFFER_BIT);
    }

    /// Clears the bars, and keeps all that follows within the canvas.
    void clear_bars(Size frame) const {
        clear({});
        const CanvasBox box = canvas_box(frame);
        gl.Scissor(box.left, box.bottom, box.size.width, box.size.height);
        gl.Enable(GL_SCISSOR_TEST);
    }

    /// Sets all state that other users of the context (an inspector) may have changed.
    void set_state() const {
        for (const GLenum off :
             {GL_SCISSOR_TEST, GL_DEPTH_TEST, GL_STENCIL_TEST, GL_CULL_FACE, GL_DITHER})
            gl.Disable(off);
        if (!is_embedded(gl)) {
            gl.Disable(GL_FRAMEBUFFER_SRGB);
            gl.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
        }
        gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        gl.Enable(GL_BLEND);
        gl.BlendEquation(GL_FUNC_ADD);
        blend_straight_colours();
    }

    /// Colours that are not multiplied by their alpha.
    void blend_straight_colours() const {
        gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    }

    void draw_lines(Size size) const {
        if (layout.lines.indices.empty()) return;
        lines.use(gl, size);
        upload(gl, GL_ARRAY_BUFFER, std::span(std::as_const(layout.lines.vertices)));
        upload(gl, GL_ELEMENT_ARRAY_BUFFER, std::span(std::as_const(layout.lines.indices)));
        gl.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(layout.lines.indices.size()),
                        GL_UNSIGNED_INT, nullptr);
    }

    template <class Item>
    void draw_quads(const Batch& batch, std::span<const Item> items, Size size) const {
        if (items.empty()) return;
        batch.use(gl, size);
        upload(gl, GL_ARRAY_BUFFER, items);
        gl.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(items.size()));
    }

    /// Neighbours with the same bitmap are drawn in one call.
    void draw_sprites(Size size) {
        const std::span<const PlacedSprite> all(layout.sprites);
        for (std::size_t first = 0; first < all.size();) {
            std::size_t end = first + 1;
            while (end < all.size() && layout.bitmaps[end] == layout.bitmaps[first]) ++end;
            textures.bind(*layout.bitmaps[first]);
            draw_quads(sprites, all.subspan(first, end - first), size);
            first = end;
        }
    }

    void draw_discs(Size size) {
        for (const DiscRun& run : runs_of(layout.discs, size, is_embedded(gl)))
            run.is_splatted ? draw_splats(run.discs, size) : draw_quads(discs, run.discs, size);
    }

    void draw_splats(std::span<const PlacedDisc> run, Size size) {
        splats.draw(run, size);
        gl.ActiveTexture(GL_TEXTURE0);
        gl.BindTexture(GL_TEXTURE_2D, splat_texels);
        gl.BindSampler(0, 0);
        gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
        if (std::exchange(splat_size, size) != size)
            gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA16UI, size.width, size.height, 0,
                          GL_RGBA_INTEGER, GL_UNSIGNED_SHORT, nullptr);
        gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, size.width, size.height, GL_RGBA_INTEGER,
                         GL_UNSIGNED_SHORT, splats.texels().data());
        splat_image.use(gl, size);
        gl.BlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
        gl.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
        blend_straight_colours();
    }

    void draw_layer(const Picture& picture, int layer, Size size) {
        lay_out(picture, layer, size, glyphs, layout);
        draw_sprites(size);
        draw_lines(size);
        draw_discs(size);
        bind_atlas();
        draw_quads(text, std::span<const PlacedGlyph>(layout.glyphs), size);
    }

    void draw_over(const Overlay& overlay) {
        const Size size = framebuffer.size();
        framebuffer.bind(size);
        set_state();
        overlays.use(gl, size);
        upload(gl, GL_ARRAY_BUFFER, std::span(overlay.vertices));
        upload(gl, GL_ELEMENT_ARRAY_BUFFER, std::span(overlay.indices));
        textures.remember(overlay.bitmap);
        textures.bind(*overlay.bitmap);
        gl.Enable(GL_SCISSOR_TEST);
        for (const Overlay::Part& part : overlay.parts) {
            gl.Scissor(part.left, size.height - part.bottom, part.right - part.left,
                       part.bottom - part.top);
            gl.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(part.count), GL_UNSIGNED_INT,
                            as_pointer(part.first * sizeof(std::uint32_t)));
        }
    }

    void bind_atlas() {
        gl.ActiveTexture(GL_TEXTURE0);
        gl.BindTexture(GL_TEXTURE_2D, atlas);
        gl.BindSampler(0, 0);
        if (atlas_revision == glyphs.revision()) return;
        atlas_revision = glyphs.revision();
        gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
        gl.TexImage2D(GL_TEXTURE_2D, 0, GL_R8, Glyphs::atlas_width, glyphs.atlas_height(), 0,
                      GL_RED, GL_UNSIGNED_BYTE, glyphs.atlas().data());
    }

    Gl gl;
    Framebuffer framebuffer;
    Batch sprites;
    Batch lines;
    Batch discs;
    Batch splat_image;
    Batch text;
    Batch overlays;
    GlName atlas;
    GlName splat_texels;
    Size splat_size{};  ///< of splat_texels
    Textures textures;
    Glyphs glyphs;
    Splats splats;
    std::uint64_t atlas_revision = 0;
    Layout layout;
};

Renderer::Renderer(const LoadProcedure& load) : impl_(std::make_unique<Impl>(load)) {}
Renderer::~Renderer() = default;

void Renderer::draw(const Picture& picture, Size size, Size view) {
    impl_->framebuffer.bind(size);
    impl_->set_state();
    if (picture.has_bars) impl_->clear_bars(view);
    impl_->clear(picture.background);
    impl_->gl.Viewport(0, 0, view.width, view.height);
    impl_->textures.update(picture.sprites);
    for (const int layer : layers_of(picture)) impl_->draw_layer(picture, layer, view);
}

void Renderer::draw_over(const Overlay& overlay) {
    if (!overlay.parts.empty()) impl_->draw_over(overlay);
}

void Renderer::draw_over(const Picture& picture, Size view) {
    impl_->framebuffer.bind(impl_->framebuffer.size());
    impl_->set_state();
    impl_->gl.Viewport(0, 0, view.width, view.height);
    for (const int layer : layers_of(picture)) impl_->draw_layer(picture, layer, view);
}

std::span<const char> Renderer::font() { return embedded::font(); }

void Renderer::read(Pixels& pixels) const {
    const Size size = impl_->framebuffer.size();
    const Gl& gl = impl_->gl;
    const bool has_alpha = is_embedded(gl);  // OpenGL ES reads no three channels
    pixels.size = size;
    pixels.rgb.resize((has_alpha ? std::size_t{4} : std::size_t{3}) *
                      static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, impl_->framebuffer.name());
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.ReadPixels(0, 0, size.width, size.height, has_alpha ? GL_RGBA : GL_RGB, GL_UNSIGNED_BYTE,
                  pixels.rgb.data());
    if (has_alpha) pixels.rgb = without_alpha(pixels.rgb);
}

void Renderer::blit() const {
    const Size size = impl_->framebuffer.size();
    const Gl& gl = impl_->gl;
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, impl_->framebuffer.name());
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    gl.Disable(GL_SCISSOR_TEST);  // it would cut the copy, too
    gl.BlitFramebuffer(0, 0, size.width, size.height, 0, 0, size.width, size.height,
                       GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

std::string Renderer::gl_renderer() const {
    return reinterpret_cast<const char*>(impl_->gl.GetString(GL_RENDERER));
}

std::string Renderer::gl_version() const {
    return reinterpret_cast<const char*>(impl_->gl.GetString(GL_VERSION));
}

}  // namespace oiler
