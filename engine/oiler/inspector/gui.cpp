// SPDX-License-Identifier: MIT
#include "oiler/inspector/gui.hpp"

#include <algorithm>
#include <utility>

namespace oiler {
namespace {

constexpr float usual_height = 720;
constexpr float usual_width = 930;  // below, letters are smaller
constexpr float font_size = 14;
constexpr float least_font_size = 11;  // pixels

Colour colour_of(ImU32 packed) {
    const auto part = [&](int shift) { return static_cast<std::uint8_t>(packed >> shift & 0xFFU); };
    return {part(IM_COL32_R_SHIFT), part(IM_COL32_G_SHIFT), part(IM_COL32_B_SHIFT),
            part(IM_COL32_A_SHIFT)};
}

void set_colours(const Theme& theme) {
    const std::pair<ImGuiCol, Colour> colours[] = {
        {ImGuiCol_Text, theme.ink},
        {ImGuiCol_TextDisabled, theme.faint},
        {ImGuiCol_WindowBg, theme.panel},
        {ImGuiCol_ChildBg, theme.panel},
        {ImGuiCol_PopupBg, theme.paper},
        {ImGuiCol_Border, theme.faint},
        {ImGuiCol_Separator, theme.faint},
        {ImGuiCol_FrameBg, theme.field},
        {ImGuiCol_FrameBgHovered, theme.heading},
        {ImGuiCol_FrameBgActive, theme.heading},
        {ImGuiCol_ScrollbarBg, theme.panel},
        {ImGuiCol_ScrollbarGrab, theme.button},
        {ImGuiCol_ScrollbarGrabHovered, theme.pressed},
        {ImGuiCol_ScrollbarGrabActive, theme.pressed},
        {ImGuiCol_CheckMark, theme.ink},
        {ImGuiCol_SliderGrab, theme.knob},
        {ImGuiCol_SliderGrabActive, theme.knob},
        {ImGuiCol_Button, theme.button},
        {ImGuiCol_ButtonHovered, theme.pressed},
        {ImGuiCol_ButtonActive, theme.pressed},
        {ImGuiCol_Header, theme.button},
        {ImGuiCol_HeaderHovered, theme.pressed},
        {ImGuiCol_HeaderActive, theme.pressed},
        {ImGuiCol_TableHeaderBg, theme.heading},
    };
    for (const auto& [index, colour] : colours)
        ImGui::GetStyle().Colors[index] = gui_colour(colour);
}

void append(const ImDrawList& list, Overlay& overlay) {
    const std::size_t first_vertex = overlay.vertices.size();
    for (const ImDrawVert& vertex : list.VtxBuffer)
        overlay.vertices.push_back(
            {{vertex.pos.x, vertex.pos.y}, {vertex.uv.x, vertex.uv.y}, colour_of(vertex.col)});
    for (const ImDrawCmd& command : list.CmdBuffer) {
        for (unsigned i = 0; i < command.ElemCount; ++i)
            overlay.indices.push_back(static_cast<std::uint32_t>(
                first_vertex + command.VtxOffset +
                list.IdxBuffer[static_cast<int>(command.IdxOffset + i)]));
        const std::size_t begin = overlay.indices.size() - command.ElemCount;
        overlay.parts.push_back({begin, command.ElemCount, static_cast<int>(command.ClipRect.x),
                                 static_cast<int>(command.ClipRect.y),
                                 static_cast<int>(command.ClipRect.z),
                                 static_cast<int>(command.ClipRect.w)});
    }
}

}  // namespace

ImVec4 gui_colour(Colour colour) {
    return {static_cast<float>(colour.r) / 255, static_cast<float>(colour.g) / 255,
            static_cast<float>(colour.b) / 255, 1};
}

Gui::Gui(std::span<const char> font) : context_(ImGui::CreateContext()), font_(font) {
    ImGui::SetCurrentContext(context_);
    ImGui::GetIO().IniFilename = nullptr;  // no file in the user's folder
}

Gui::~Gui() { ImGui::DestroyContext(context_); }

float Gui::unit_of(Size frame) {
    const float of_height = static_cast<float>(frame.height) / usual_height;
    const float of_width = static_cast<float>(frame.width) / usual_width;
    return std::max(least_font_size / font_size, std::min(std::max(1.0F, of_height), of_width));
}

void Gui::set_scale(float unit) {
    unit_ = unit;
    ImGuiIO& io = ImGui::GetIO();
    ImFontConfig config;
    config.FontDataOwnedByAtlas = false;
    // Latin, Greek, and the signs of the texts.
    static constexpr ImWchar letters[] = {0x20,   0xFF,   0x391,  0x3C9,  0x2010, 0x2027, 0x207B,
                                          0x207B, 0x2212, 0x2212, 0x2265, 0x2265, 0};
    io.Fonts->Clear();
    io.Fonts->AddFontFromMemoryTTF(const_cast<char*>(font_.data()), static_cast<int>(font_.size()),
                                   font_size * unit, &config, letters);
    unsigned char* pixels = nullptr;
    Size size;
    io.Fonts->GetTexDataAsRGBA32(&pixels, &size.width, &size.height);
    const std::size_t bytes = std::size_t{4} * static_cast<std::size_t>(size.width) *
                              static_cast<std::size_t>(size.height);
    overlay_.bitmap = make_bitmap(size, {pixels, pixels + bytes});

    ImGuiStyle style;
    style.DisabledAlpha = 0.7F;
    style.AntiAliasedLinesUseTex = false;  // texels are not blended
    style.WindowRounding = 0;
    style.FrameBorderSize = 1;
    style.FramePadding = {3, 2};  // many rows
    style.ItemSpacing.y = 3;
    style.CellPadding = {3, 1};
    style.ScrollbarSize = 10;
    style.ScaleAllSizes(unit);
    ImGui::GetStyle() = style;
}

void Gui::begin(const Inspector::Mouse& mouse, Size frame, double seconds, const Theme& theme) {
    ImGui::SetCurrentContext(context_);
    const float unit = unit_of(frame);
    if (unit != unit_) set_scale(unit);
    set_colours(theme);
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(frame.width), static_cast<float>(frame.height)};
    io.DeltaTime = static_cast<float>(std::max(seconds, 1e-4));
    constexpr float outside = -1e6F;
    io.MousePos = mouse.at ? ImVec2(mouse.at->x, mouse.at->y) : ImVec2(outside, outside);
    io.MouseDown[0] = mouse.is_down;
    io.MouseWheel = static_cast<float>(mouse.wheel);
    ImGui::NewFrame();
}

void Gui::end() {
    ImGui::Render();
    const ImDrawData& drawn = *ImGui::GetDrawData();
    overlay_.vertices.clear();
    overlay_.indices.clear();
    overlay_.parts.clear();
    for (int i = 0; i < drawn.CmdListsCount; ++i) append(*drawn.CmdLists[i], overlay_);
}

bool Gui::has_mouse() const {
    ImGui::SetCurrentContext(context_);
    return ImGui::GetIO().WantCaptureMouse;
}

}  // namespace oiler
