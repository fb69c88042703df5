// SPDX-License-Identifier: MIT
#include "oiler/inspector/inspector.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "oiler/inspector/gui.hpp"

namespace oiler {
namespace {

constexpr float panel_width = 340;  // units
constexpr int lowest_rate = 10;     // Hz
constexpr int highest_rate = 1000;
constexpr double least_cost = 10'000;  // ns; less is not certain beside a game
constexpr int lines_of_verdict = 4;
constexpr double frame_at_60_hz = 1e9 / 60;  // ns
constexpr float smallest_error = 1e-6F;      // m

ImVec4 gui_colour(Colour colour) {
    return {static_cast<float>(colour.r) / 255, static_cast<float>(colour.g) / 255,
            static_cast<float>(colour.b) / 255, 1};
}

std::string time_text(double nanoseconds) {
    if (nanoseconds < 1000) return fmt::format("{:.0f} ns", nanoseconds);
    if (nanoseconds < 1e6) return fmt::format("{:.3g} µs", nanoseconds / 1e3);
    return fmt::format("{:.3g} ms", nanoseconds / 1e6);
}

void text(const std::string& words) { ImGui::TextUnformatted(words.c_str()); }
void wrapped(const std::string& words) {
    ImGui::PushTextWrapPos(0);
    text(words);
    ImGui::PopTextWrapPos();
}

/// A button that is grey unless it has an effect.
bool button(const char* name, bool has_effect = true) {
    ImGui::BeginDisabled(!has_effect);
    const bool pressed = ImGui::Button(name);
    ImGui::EndDisabled();
    return pressed;
}

}  // namespace

struct Inspector::Impl {
    explicit Impl(std::span<const char> font) : gui(font) {}

    static void show_verdict(const Inspected& run) {
        // Of one height, so that nothing moves under the mouse.
        ImGui::BeginChild("verdict", {0, lines_of_verdict * ImGui::GetTextLineHeightWithSpacing()});
        ImGui::PushStyleColor(ImGuiCol_Text, gui_colour(run.grade));
        wrapped(run.verdict);
        ImGui::PopStyleColor();
        ImGui::EndChild();
        ImGui::Separator();
    }

    void show_setting(const Inspected& run, Wishes& wishes) {
        Stepping chosen = run.stepping;
        ImGui::BeginDisabled(!run.fixed.empty());
        ImGui::SetNextItemWidth(-ImGui::CalcTextSize("precision  ").x);
        if (!is_sliding) rate = static_cast<int>(run.stepping.rate.steps);
        ImGui::SliderInt("rate", &rate, std::min(lowest_rate, rate), std::max(highest_rate, rate),
                         "%d Hz", ImGuiSliderFlags_Logarithmic);
        is_sliding = ImGui::IsItemActive();
        if (ImGui::IsItemDeactivatedAfterEdit()) chosen.rate = {rate};
        ImGui::SetNextItemWidth(-ImGui::CalcTextSize("precision  ").x);
        if (ImGui::BeginCombo("method", run.stepping.method->name.data())) {
            for (const Method* const method : run.methods)
                if (ImGui::Selectable(std::string(method->name).c_str(),
                                      method == run.stepping.method))
                    chosen.method = method;
            ImGui::EndCombo();
        }
        int is_double = run.stepping.precision == Precision::double_ ? 1 : 0;
        ImGui::RadioButton("float", &is_double, 0);
        ImGui::SameLine();
        ImGui::RadioButton("double", &is_double, 1);
        ImGui::EndDisabled();
        chosen.precision = is_double == 1 ? Precision::double_ : Precision::single;
        wrapped(run.fixed.empty() ? "A change restarts the run." : run.fixed);
        if (chosen != run.stepping) wishes.stepping = chosen;
    }

    static void show_controls(const Inspected& run, Wishes& wishes) {
        wishes.pauses = button(run.is_paused ? "Resume" : "Pause");
        ImGui::SameLine();
        wishes.goes_back = button("Back", run.is_paused && run.has_past);
        ImGui::SameLine();
        wishes.steps = button("Step", run.is_paused);
        ImGui::SameLine();
        wishes.restarts = button("Restart");
        ImGui::SameLine();
        if (button("Slower")) --wishes.pace;
        ImGui::SameLine();
        if (button("Faster")) ++wishes.pace;
        text(fmt::format("{:.2f} s, bodies: {}{}{}", run.time, run.bodies,
                         run.pace.empty() ? "" : ", ", run.pace));
    }

    static void show_settings(const Inspected& run, Wishes& wishes) {
        if (run.settings.empty()) return;
        ImGui::Separator();
        text("The true motion and other settings");
        if (!ImGui::BeginTable("settings", 4, ImGuiTableFlags_SizingFixedFit)) return;
        for (const char* name : {"", "off by", "steps a frame", ""}) ImGui::TableSetupColumn(name);
        ImGui::TableHeadersRow();
        for (std::size_t i = 0; i < run.settings.size(); ++i) {
            const Inspected::Setting& one = run.settings[i];
            ImGui::TableNextColumn();
            text(difference(one.stepping, run.stepping));
            ImGui::TableNextColumn();
            ImGui::TextColored(gui_colour(one.grade), "%s", one.error.c_str());
            ImGui::TableNextColumn();
            text(one.cost < least_cost ? "< 10 µs" : time_text(one.cost));
            ImGui::TableNextColumn();
            ImGui::PushID(static_cast<int>(i));
            if (i > 0 && button("Apply", run.fixed.empty())) wishes.stepping = one.stepping;
            ImGui::PopID();
        }
        ImGui::EndTable();
        show_errors(run);
    }

    /// The error over time, on a logarithmic scale.
    static void show_errors(const Inspected& run) {
        if (run.errors.empty()) return;
        std::vector<float> logarithms;
        for (const float error : run.errors)
            logarithms.push_back(std::log10(std::max(error, smallest_error)));
        const std::string now = fmt::format("now {:.2g} m", run.errors.back());
        text("this run is off by (1 µm to 1 km, logarithmic)");
        ImGui::PlotLines("##errors", logarithms.data(), static_cast<int>(logarithms.size()), 0,
                         now.c_str(), -6, 3,
                         {ImGui::GetContentRegionAvail().x, 4 * ImGui::GetFontSize()});
    }

    static void show_costs(const Inspected& run) {
        const double total = run.costs.update + run.costs.step + run.costs.picture + run.costs.draw;
        if (total == 0) return;
        ImGui::Separator();
        text("A frame");
        const auto row = [&](const char* name, double cost) {
            text(fmt::format("{}  {}", name, time_text(cost)));
        };
        row("update", run.costs.update);
        ImGui::SameLine();
        row("step", run.costs.step);
        row("picture", run.costs.picture);
        ImGui::SameLine();
        row("draw", run.costs.draw);
        const std::string share =
            fmt::format("{:.0f} % of a frame at 60 Hz", 100 * total / frame_at_60_hz);
        ImGui::ProgressBar(static_cast<float>(total / frame_at_60_hz), {-1, 0}, share.c_str());
        if (run.dropped > 0)
            text(fmt::format("dropped because of late frames: {:.2f} s", run.dropped));
    }

    static void show_energy(const Inspected& run) {
        if (run.bodies == 0) return;
        ImGui::Separator();
        const double change = run.energy - run.first_energy;
        text(fmt::format("energy {:.6g} J", run.energy));
        text(run.first_energy == 0 ? fmt::format("since the start {:+.3g} J", change)
                                   : fmt::format("since the start {:+.3g} J, {:+.3g} %", change,
                                                 100 * change / std::abs(run.first_energy)));
    }

    /// "this", "120 Hz", "rk4", "float".
    static std::string difference(const Stepping& other, const Stepping& run) {
        std::string words;
        const auto add = [&](const std::string& word) {
            words += (words.empty() ? "" : ", ") + word;
        };
        if (other.method != run.method) add(std::string(other.method->name));
        if (other.rate != run.rate) add(fmt::format("{} Hz", other.rate.steps));
        if (other.precision != run.precision) add(std::string(name_of(other.precision)));
        return words.empty() ? "this run" : words;
    }

    Gui gui;
    int rate = 0;
    bool is_sliding = false;
};

Size Inspector::view(Size frame) {
    const int panel = static_cast<int>(panel_width * Gui::unit_of(frame));
    return {frame.width - std::min(panel, frame.width / 2), frame.height};
}

Inspector::Inspector(std::span<const char> font) : impl_(std::make_unique<Impl>(font)) {}
Inspector::~Inspector() = default;

Wishes Inspector::show(const Inspected& run, const Mouse& mouse, Size frame, double seconds) {
    Wishes wishes;
    impl_->gui.begin(mouse, frame, seconds);
    const auto panel = static_cast<float>(frame.width - view(frame).width);
    ImGui::SetNextWindowPos({static_cast<float>(frame.width) - panel, 0});
    ImGui::SetNextWindowSize({panel, static_cast<float>(frame.height)});
    ImGui::Begin("Inspector", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove);
    Impl::show_verdict(run);
    impl_->show_setting(run, wishes);
    Impl::show_controls(run, wishes);
    Impl::show_settings(run, wishes);
    Impl::show_costs(run);
    Impl::show_energy(run);
    ImGui::End();
    impl_->gui.end();
    return wishes;
}

const Overlay& Inspector::overlay() const { return impl_->gui.overlay(); }
bool Inspector::has_mouse() const { return impl_->gui.has_mouse(); }

}  // namespace oiler
