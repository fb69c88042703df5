// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <span>

#include "oiler/core/size.hpp"
#include "oiler/inspector/inspector.hpp"

namespace oiler {

[[nodiscard]] ImVec4 gui_colour(Colour colour);

/// Dear ImGui without a window: it takes mouse input and returns triangles.
class Gui {
public:
    explicit Gui(std::span<const char> font);
    ~Gui();
    Gui(const Gui&) = delete;
    Gui& operator=(const Gui&) = delete;

    /// Sizes grow with the frame: a unit is a pixel at 720 lines and below, and less in a narrow
    /// frame, as far as letters can be read.
    [[nodiscard]] static float unit_of(Size frame);

    /// Widgets may be called until `end`.
    void begin(const Inspector::Mouse& mouse, Size frame, double seconds, const Theme& theme);
    void end();
    [[nodiscard]] const Overlay& overlay() const { return overlay_; }
    [[nodiscard]] bool has_mouse() const;

private:
    void set_scale(float unit);

    ImGuiContext* context_;
    std::span<const char> font_;
    float unit_ = 0;
    Overlay overlay_;
};

}  // namespace oiler
