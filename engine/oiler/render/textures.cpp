// SPDX-License-Identifier: MIT
#include "oiler/render/textures.hpp"

namespace oiler {

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
