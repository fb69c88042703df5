// SPDX-License-Identifier: MIT
#pragma once

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace oiler {

/// A plot of errors from 1 µm to 1 km over time, with its units at both sides.
class ErrorPlot {
public:
    enum class Side { left, right };

    /// Takes its room in the panel.
    ErrorPlot() {
        const float margin = ImGui::CalcTextSize("1 mm ").x;
        const ImVec2 corner = ImGui::GetCursorScreenPos();
        const float width = ImGui::GetContentRegionAvail().x;
        const float letter = ImGui::GetFontSize();
        low_ = {corner.x + margin, corner.y + (lines - 0.5F) * letter};
        high_ = {corner.x + width - margin, corner.y + 0.5F * letter};
        ImGui::Dummy({width, lines * letter});
    }

    void line_at(double error, const char* unit, Side side) const {
        const float y = height_of(error);
        list_.AddLine({low_.x, y}, {high_.x, y}, ImGui::GetColorU32(ImGuiCol_TextDisabled, 0.6F));
        const ImVec2 size = ImGui::CalcTextSize(unit);
        const float gap = size.y / 4;
        const float x = side == Side::left ? low_.x - gap - size.x : high_.x + gap;
        list_.AddText({x, y - size.y / 2}, ImGui::GetColorU32(ImGuiCol_Text), unit);
    }
    void curve(const std::vector<float>& errors) const {
        std::vector<ImVec2> points;
        const float step =
            (high_.x - low_.x) / std::max(1.0F, static_cast<float>(errors.size()) - 1);
        for (const float error : errors)
            points.push_back({low_.x + step * static_cast<float>(points.size()), height_of(error)});
        list_.AddPolyline(points.data(), static_cast<int>(points.size()),
                          ImGui::GetColorU32(ImGuiCol_Text), 0, ImGui::GetFontSize() / 10);
    }

private:
    static constexpr float lines = 5;  // of text

    [[nodiscard]] float height_of(double error) const {
        const double share = (std::log10(std::clamp(error, 1e-6, 1e3)) + 6) / 9;
        return low_.y + static_cast<float>(share) * (high_.y - low_.y);
    }

    ImDrawList& list_ = *ImGui::GetWindowDrawList();
    ImVec2 low_;
    ImVec2 high_;
};

}  // namespace oiler
