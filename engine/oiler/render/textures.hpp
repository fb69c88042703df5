// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <unordered_map>

#include "oiler/picture/picture.hpp"
#include "oiler/render/gl.hpp"

namespace oiler {

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
