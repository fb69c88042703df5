// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <vector>

#include "oiler/core/size.hpp"
#include "oiler/picture/picture.hpp"

namespace oiler {

/// Draws single pictures into PNG files, without a screen.
class Stills {
public:
    /// Throws Error{no_display} where neither OSMesa nor EGL draws.
    explicit Stills(Size size);
    ~Stills();
    Stills(const Stills&) = delete;
    Stills& operator=(const Stills&) = delete;

    /// The bytes of a PNG file.
    [[nodiscard]] std::vector<std::byte> png(const Picture& picture);
    /// Throws Error{io}; then no part of the file is left.
    void write(const Picture& picture, const std::filesystem::path& path);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace oiler
