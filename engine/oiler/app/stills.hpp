// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <vector>

#include "oiler/core/size.hpp"
#include "oiler/picture/picture.hpp"

namespace oiler {

/// Draws single pictures as PNG files, without a screen.
class Stills {
public:
    /// Throws Error{no_display} if neither OSMesa nor EGL works.
    explicit Stills(Size size);
    ~Stills();
    Stills(const Stills&) = delete;
    Stills& operator=(const Stills&) = delete;

    /// Returns the bytes of a PNG file.
    [[nodiscard]] std::vector<std::byte> png(const Picture& picture);
    /// Writes a PNG file into an output folder and replaces a link of that name. Throws Error{io};
    /// partial files are removed.
    void write(const Picture& picture, const std::filesystem::path& path);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace oiler
