// SPDX-License-Identifier: MIT
#include "oiler/app/stills.hpp"

#include "oiler/capture/file.hpp"
#include "oiler/capture/png.hpp"
#include "oiler/platform/surface.hpp"
#include "oiler/render/renderer.hpp"

namespace oiler {

struct Stills::Impl {
    explicit Impl(Size wanted)
        : size(wanted),
          surface(open_offscreen(Offscreen::automatic)),
          renderer([this](const char* name) { return surface->procedure(name); }) {}

    Size size;
    std::unique_ptr<Surface> surface;
    Renderer renderer;
    Pixels pixels;
};

Stills::Stills(Size size) : impl_(std::make_unique<Impl>(size)) {}

Stills::~Stills() = default;

std::vector<std::byte> Stills::png(const Picture& picture) {
    impl_->renderer.draw(picture, impl_->size);
    impl_->renderer.read(impl_->pixels);
    return encode_png(impl_->pixels.size, impl_->pixels.rgb);
}

void Stills::write(const Picture& picture, const std::filesystem::path& path) {
    write_file(path, png(picture), kinds::png, Links::replaced);
}

}  // namespace oiler
