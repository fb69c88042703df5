// SPDX-License-Identifier: MIT
// The renderer on OpenGL ES 3.0, which is WebGL 2 to a page.
#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>

#include <cstdlib>

#include "oiler/picture/palette.hpp"
#include "oiler/picture/shapes.hpp"
#include "render/drawing.hpp"

namespace oiler::test {
namespace {

/// Mesa's surfaceless platform with a context of OpenGL ES 3.0.
class EmbeddedSurface {
public:
    EmbeddedSurface() : library_(dlopen("libEGL.so.1", RTLD_NOW | RTLD_NODELETE)) {
        if (library_ == nullptr) return;
        const auto get = [&]<class F>(F*, const char* name) {
            return reinterpret_cast<F*>(dlsym(library_, name));
        };
        procedure_ = get(procedure_, "eglGetProcAddress");
        const auto open = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
            procedure_("eglGetPlatformDisplayEXT"));
        display_ = open(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
        if (!get(&eglInitialize, "eglInitialize")(display_, nullptr, nullptr)) return;
        get(&eglBindAPI, "eglBindAPI")(EGL_OPENGL_ES_API);
        constexpr EGLint wanted[]{EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT,
                                  EGL_NONE};
        constexpr EGLint version[]{EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 0,
                                   EGL_NONE};
        EGLConfig config = nullptr;
        EGLint count = 0;
        get(&eglChooseConfig, "eglChooseConfig")(display_, wanted, &config, 1, &count);
        context_ =
            get(&eglCreateContext, "eglCreateContext")(display_, config, EGL_NO_CONTEXT, version);
        make_current_ = get(make_current_, "eglMakeCurrent");
        destroy_ = get(destroy_, "eglDestroyContext");
        is_open_ = make_current_(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_TRUE;
    }
    ~EmbeddedSurface() {
        if (!is_open_) return;
        make_current_(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        destroy_(display_, context_);
    }
    EmbeddedSurface(const EmbeddedSurface&) = delete;
    EmbeddedSurface& operator=(const EmbeddedSurface&) = delete;

    [[nodiscard]] bool is_open() const { return is_open_; }
    [[nodiscard]] Surface::Procedure procedure(const char* name) const { return procedure_(name); }

private:
    void* library_;
    decltype(&eglGetProcAddress) procedure_ = nullptr;
    decltype(&eglMakeCurrent) make_current_ = nullptr;
    decltype(&eglDestroyContext) destroy_ = nullptr;
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
    bool is_open_ = false;
};

/// All that a picture may have, with as many small discs as make splats.
Picture everything() {
    Picture picture{.camera = {.height = 9},
                    .polygons = {{{}, rectangle({-5, -3}, {4, 2}), palette::pale}},
                    .polylines = {{{}, {{-6, -2}, {0, 3}, {6, -2}}, 3, palette::blue}},
                    .discs = {{{}, {0, 0}, 1, {200, 30, 60, 128}}},
                    .labels = {{{}, {12, 12}, "Space kicks: ω·dt = 0.5", 16}}};
    for (int i = 0; i < 20'000; ++i)
        picture.discs.push_back(
            {{},
             {static_cast<float>(i % 200) * 0.07F - 7, static_cast<float>(i / 200) * 0.03F},
             0.03F,
             {30, 90, static_cast<std::uint8_t>(i), 160}});
    auto bitmap = std::make_shared<Bitmap>();
    bitmap->size = {2, 2};
    bitmap->rgba = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 128};
    picture.sprites.push_back({.centre = {4, -2}, .size = {2, 2}, .bitmap = bitmap, .angle = 0.3F});
    return picture;
}

// The same rasteriser: blending rounds each of two or three layers by up to half a step.
TEST(EmbeddedGl, ShowsWhatOpenGlShows) {
    const auto studio = open_studio(Offscreen::egl);
    if (!studio) GTEST_SKIP() << "EGL is not installed";
    const Size size{641, 359};
    const Pixels expected = studio->draw(everything(), size);
    const EmbeddedSurface surface;
    if (!surface.is_open()) GTEST_SKIP() << "EGL has no OpenGL ES 3.0";
    Renderer renderer([&](const char* name) { return surface.procedure(name); });
    EXPECT_NE(renderer.gl_version().find("OpenGL ES 3"), std::string::npos);
    renderer.draw(everything(), size);
    Pixels pixels;
    renderer.read(pixels);
    ASSERT_EQ(pixels.rgb.size(), expected.rgb.size());
    int largest = 0;
    std::size_t different = 0;
    for (std::size_t i = 0; i < pixels.rgb.size(); ++i) {
        const int off = std::abs(pixels.rgb[i] - expected.rgb[i]);
        largest = std::max(largest, off);
        if (off > 0) ++different;
    }
    EXPECT_LE(largest, 2);
    EXPECT_LT(different, pixels.rgb.size() / 100);
}

}  // namespace
}  // namespace oiler::test
