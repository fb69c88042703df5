// SPDX-License-Identifier: MIT
#include "oiler/inspector/inspector.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <variant>
#include <vector>

#include "oiler/inspector/error_plot.hpp"
#include "oiler/inspector/gui.hpp"
#include "oiler/picture/palette.hpp"

namespace oiler {
namespace {

constexpr float panel_width = 390;    // units
constexpr float narrow_panel = 340;   // units; the table of settings fits, but for forces
constexpr float panel_share = 0.42F;  // of the width of a small frame: the game needs the rest
constexpr int lines_of_verdict = 4;
constexpr int lines_of_state = 2;
constexpr double frame_at_60_hz = 1e9 / 60;  // ns

/// The place of the closest rate on the slider.
int place_of(std::int64_t rate) {
    const auto off = [&](std::int64_t one) { return std::abs(one - rate); };
    return static_cast<int>(std::ranges::min_element(offered_rates, {}, off) -
                            offered_rates.begin());
}

void text(const std::string& words) { ImGui::TextUnformatted(words.c_str()); }
void wrapped(const std::string& words) {
    ImGui::PushTextWrapPos(0);
    text(words);
    ImGui::PopTextWrapPos();
}
/// Text after a mark in a colour, which has an edge of ink, because it may be pale.
void marked(Colour colour, const std::string& words) {
    const float side = 0.6F * ImGui::GetFontSize();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 low{corner.x, corner.y + 0.25F * ImGui::GetFontSize()};
    const ImVec2 high{low.x + side, low.y + side};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(low, high, ImGui::ColorConvertFloat4ToU32(gui_colour(colour)));
    list.AddRect(low, high, ImGui::GetColorU32(ImGuiCol_Text));
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + 1.5F * side);
    wrapped(words);
}
float width_of_marked(const std::string& words) {
    return ImGui::CalcTextSize(words.c_str()).x + 0.9F * ImGui::GetFontSize();
}

float width_of_button(const char* widest_name) {
    return ImGui::CalcTextSize(widest_name).x + 2 * ImGui::GetStyle().FramePadding.x;
}

/// A button that is grey unless it has an effect, as wide as the widest of its names.
bool button(const char* name, bool has_effect = true, const char* widest_name = nullptr) {
    ImGui::BeginDisabled(!has_effect);
    const bool pressed =
        ImGui::Button(name, {width_of_button(widest_name ? widest_name : name), 0});
    ImGui::EndDisabled();
    return pressed;
}

/// The next item, of that width, stands beside the last one, from `x` on, if there is room.
void beside(float width, float x = 0) {
    ImGui::SameLine(x);
    if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
}
void beside(const char* button) { beside(width_of_button(button)); }

}  // namespace

std::string time_text(double nanoseconds) {
    if (nanoseconds < 1000) return fmt::format("{:.0f} ns", nanoseconds);
    if (nanoseconds < 1e6) return fmt::format("{:.3g} µs", nanoseconds / 1e3);
    return fmt::format("{:.3g} ms", nanoseconds / 1e6);
}

std::string energy_text(double joules) {
    const double size = std::abs(joules);
    if (size >= 1e9 || (size > 0 && size < 1e-3)) return fmt::format("{:.3g} J", joules);
    if (size >= 1e6) return fmt::format("{:.4g} MJ", joules / 1e6);
    if (size >= 1e3) return fmt::format("{:.4g} kJ", joules / 1e3);
    return fmt::format("{:.4g} J", joules);
}

struct Inspector::Impl {
    explicit Impl(std::span<const char> font) : gui(font) {}

    static void show_verdict(const Inspected& run) {
        // The height is fixed, so that nothing moves under the mouse.
        ImGui::BeginChild("verdict", {0, lines_of_verdict * ImGui::GetTextLineHeightWithSpacing()});
        if (!run.verdict.empty()) marked(run.grade, run.verdict);
        ImGui::EndChild();
        ImGui::Separator();
    }

    void show_setting(const Inspected& run, bool escapes, Requests& requests) {
        Stepping chosen = run.stepping;
        ImGui::BeginDisabled(!run.fixed.empty());
        ImGui::SetNextItemWidth(-ImGui::CalcTextSize("precision  ").x);
        // The figure is beside the slider, whose knob would cover it.
        if (!is_sliding) place = place_of(run.stepping.rate.steps);
        const std::string hertz =
            fmt::format("{} Hz", is_sliding ? offered_rates[static_cast<std::size_t>(place)]
                                            : run.stepping.rate.steps);
        ImGui::SliderInt("##rate", &place, 0, static_cast<int>(offered_rates.size()) - 1, "",
                         ImGuiSliderFlags_NoInput);
        is_sliding = ImGui::IsItemActive();
        if (ImGui::IsItemDeactivatedAfterEdit())
            chosen.rate = {offered_rates[static_cast<std::size_t>(place)]};
        ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
        text(hertz);
        ImGui::SetNextItemWidth(-ImGui::CalcTextSize("precision  ").x);
        has_menu = ImGui::BeginCombo("method", run.stepping.method->name.data());
        if (has_menu) {
            if (escapes) ImGui::CloseCurrentPopup();
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
        if (run.fixed.empty()) {
            constexpr const char* restart = "changes restart the run";
            beside(ImGui::GetFrameHeightWithSpacing() + ImGui::CalcTextSize(restart).x,
                   ImGui::GetContentRegionAvail().x / 2);
            ImGui::Checkbox(restart, &changes_from_start);
        }
        ImGui::BeginDisabled(!run.fixed.empty());
        show_damping(chosen);
        ImGui::EndDisabled();
        if (chosen != run.stepping) requests.stepping = chosen;
    }

    static void show_threads(const Inspected& run, Requests& requests) {
        if (run.most_threads == 1) return;
        int threads = run.threads;
        ImGui::SetNextItemWidth(-ImGui::CalcTextSize("precision  ").x);
        ImGui::SliderInt("##threads", &threads, 1, run.most_threads, "", ImGuiSliderFlags_NoInput);
        ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
        text(fmt::format("{} thread{}", run.threads, run.threads == 1 ? "" : "s"));
        if (threads != run.threads) requests.threads = threads;
    }

    /// Where a splitting puts damping; other methods have no choice.
    static void show_damping(Stepping& chosen) {
        const Method& method = *chosen.method;
        const Damping now = damping_of(chosen);
        int is_in_drift = now == Damping::in_drift ? 1 : 0;
        ImGui::BeginDisabled(!std::holds_alternative<Splitting>(method.rule));
        ImGui::AlignTextToFramePadding();
        text("damping in the");
        ImGui::SameLine();
        ImGui::RadioButton("kick", &is_in_drift, 0);
        ImGui::SameLine();
        ImGui::RadioButton("drift", &is_in_drift, 1);
        ImGui::EndDisabled();
        const Damping wanted = is_in_drift == 1 ? Damping::in_drift : Damping::in_kick;
        if (wanted == now) return;
        chosen.damping.reset();
        if (wanted != method.damping) chosen.damping = wanted;
    }

    void show_controls(const Inspected& run, Requests& requests) {
        requests.pauses = button(run.is_paused ? "Play" : "Pause", true, "Pause");
        beside("Back");
        requests.goes_back = button("Back", run.is_paused && run.past);
        beside("Step");
        requests.steps = button("Step", run.is_paused);
        beside("Restart");
        requests.restarts = button("Restart");
        beside("Slower");
        if (button("Slower")) ++requests.slower;
        beside("Faster");
        if (button("Faster")) ++requests.faster;
        const std::string bodies = run.bodies > 0 ? fmt::format(", bodies: {}", run.bodies) : "";
        text(fmt::format("{:.2f} s{}", run.time, bodies));
        if (run.past) show_time_line(*run.past, run.stepping.rate, requests);
    }

    /// The state of the loop and the body that the view follows.
    static void show_state(const Inspected& run) {
        ImGui::BeginChild("state", {0, lines_of_state * ImGui::GetTextLineHeightWithSpacing()});
        if (!run.status.empty()) wrapped(run.status);
        if (!run.followed.empty())
            wrapped(run.followed);
        else if (run.bodies > 0)
            wrapped("A double click on a body follows it.");
        ImGui::EndChild();
    }

    void show_time_line(const Inspected::Past& past, const Rate& rate, Requests& requests) {
        if (!is_seeking) seeked = past.now;
        const double ago = rate.time(past.last - seeked);
        const std::string when = ago == 0 ? "now" : fmt::format("{:.2f} s ago", ago);
        ImGui::SetNextItemWidth(-1);
        ImGui::BeginDisabled(past.first == past.last);
        ImGui::SliderScalar("##time line", ImGuiDataType_S64, &seeked, &past.first, &past.last,
                            when.c_str(), ImGuiSliderFlags_NoInput);
        ImGui::EndDisabled();
        is_seeking = ImGui::IsItemActive();
        if (is_seeking) requests.step = seeked;
    }

    struct Column {
        const char* name;
        float width;
    };
    static constexpr std::size_t columns_with_forces = 5;

    /// The columns that fit. The buttons come first, so that nothing pushes them, and the widths
    /// are those of the longest figures, because digits come and go.
    static std::vector<Column> columns_of_settings(const Inspected& run) {
        float widest = 0;
        for (const Inspected::Setting& one : run.settings)
            widest = std::max(
                widest, ImGui::CalcTextSize(difference(one.stepping, run.stepping).c_str()).x);
        std::vector<Column> columns{{"", width_of_button("Apply")},
                                    {"", widest},
                                    {"at most", width_of_marked("other events")},
                                    {"a frame", ImGui::CalcTextSize("99.9 µs").x},
                                    {"forces", ImGui::CalcTextSize("×0.99").x}};
        float whole = 0;
        for (Column& one : columns) {
            one.width = std::max(one.width, ImGui::CalcTextSize(one.name).x);
            whole += one.width + 2 * ImGui::GetStyle().CellPadding.x;
        }
        if (whole > ImGui::GetContentRegionAvail().x) columns.pop_back();
        return columns;
    }

    static void show_settings(const Inspected& run, Requests& requests) {
        if (run.settings.empty()) return;
        ImGui::Separator();
        text("Off the true motion as drawn, " + (run.is_of_round ? "in a round" : since(run)));
        const std::vector<Column> columns = columns_of_settings(run);
        const bool has_forces = columns.size() == columns_with_forces;
        const auto count = static_cast<int>(columns.size());
        if (!ImGui::BeginTable("settings", count, ImGuiTableFlags_SizingFixedFit)) return;
        for (const Column& one : columns)
            ImGui::TableSetupColumn(one.name, ImGuiTableColumnFlags_WidthFixed, one.width);
        ImGui::TableHeadersRow();
        for (std::size_t i = 0; i < run.settings.size(); ++i) {
            const Inspected::Setting& one = run.settings[i];
            ImGui::TableNextColumn();
            ImGui::PushID(static_cast<int>(i));
            if (i > 0 && button("Apply", run.fixed.empty())) requests.stepping = one.stepping;
            ImGui::PopID();
            ImGui::TableNextColumn();
            text(difference(one.stepping, run.stepping));
            ImGui::TableNextColumn();
            marked(one.grade, one.error);
            ImGui::TableNextColumn();
            text(one.cost);
            if (has_forces && ImGui::TableNextColumn()) text(one.forces);
        }
        ImGui::EndTable();
        if (!run.rate_advice.empty()) wrapped(run.rate_advice);
        show_errors(run);
    }

    /// The error in the last steps, on a logarithmic scale, with lines at 1 mm and at a pixel.
    static void show_errors(const Inspected& run) {
        if (run.errors.empty()) return;
        wrapped(fmt::format("This run in the last {:.2g} s, now {}:",
                            run.stepping.rate.time(static_cast<std::int64_t>(run.errors.size())),
                            run.last_error));
        const ErrorPlot plot;
        plot.line_at(1e-6, "1 µm", ErrorPlot::Side::left);
        plot.line_at(1e-3, "1 mm", ErrorPlot::Side::left);
        plot.line_at(1e3, "1 km", ErrorPlot::Side::left);
        if (run.pixel > 0) plot.line_at(run.pixel, "1 px", ErrorPlot::Side::right);
        plot.curve(run.errors);
    }

    /// The overlays over the picture, with their scales.
    void show_overlays(const Inspected& run) {
        const Inspected::Scales& scales = run.scales;
        // Greyed, not gone, when the last body goes, so that the list below stands still.
        ImGui::BeginDisabled(run.bodies == 0);
        const float second = ImGui::GetContentRegionAvail().x / 2;
        ImGui::Separator();
        ImGui::Checkbox("trails", &shown.trails);
        ImGui::SameLine(second);
        ImGui::Checkbox("springs by strain", &shown.springs);
        ImGui::Checkbox("velocity", &shown.velocities);
        ImGui::SameLine(second);
        ImGui::Checkbox("acceleration", &shown.accelerations);
        ImGui::EndDisabled();
        if (shown.springs) show_strains(scales);
        const auto arrow = [](double scale, const char* unit, Colour colour) {
            marked(colour, fmt::format("1 m = {:g} {}", scale, unit));
        };
        if (shown.velocities) arrow(scales.velocity, "m/s", Inspected::Scales::colour_of_velocity);
        if (shown.velocities && shown.accelerations) ImGui::SameLine(second);
        if (shown.accelerations) arrow(scales.acceleration, "m/s²", run.theme.ink);
        const bool has_bodies = shown.trails || shown.velocities || shown.accelerations;
        if (has_bodies && scales.bodies > 0)
            text(fmt::format("trails and arrows: {} bodies", scales.bodies));
    }
    static void show_strains(const Inspected::Scales& scales) {
        const auto row = [](const std::string& full, bool may_be_compressed) {
            if (may_be_compressed) {
                marked(palette::blue, "−" + full);
                ImGui::SameLine();
            }
            marked(palette::grey, "relaxed");
            ImGui::SameLine();
            marked(palette::vermilion, "+" + full);
        };
        if (scales.springs == 0) text("there are no springs");
        if (scales.strain > 0) row(fmt::format("{:g} %", 100 * scales.strain), true);
        if (!scales.stretch.empty()) row(scales.stretch + ", without a rest length", false);
    }

    /// A bar, and its figure beside it, where it can be read whatever the bar's colour.
    static void show_bar(double share, const std::string& figure) {
        const float width = 0.3F * ImGui::GetContentRegionAvail().x;
        ImGui::ProgressBar(static_cast<float>(std::min(share, 1.0)), {width, 0}, "");
        ImGui::SameLine();
        wrapped(figure);
    }

    /// The distance of the stiffest spring or damper from its limit.
    static void show_gauge(const Inspected& run) {
        if (!run.stiffest) return;
        constexpr double near = 0.8;
        const Inspected::Gauge& gauge = *run.stiffest;
        const double share = gauge.measure / gauge.limit;
        ImGui::Separator();
        text("stiffest: " + gauge.name);
        ImGui::PushStyleColor(ImGuiCol_PlotHistogram,
                              gui_colour(share >= 1     ? palette::vermilion
                                         : share > near ? palette::orange
                                                        : palette::sky_blue));
        const std::string of = std::isinf(gauge.limit) ? "stable at any rate"
                               : gauge.limit == 0      ? "unstable at any rate"
                                                       : fmt::format("{}·dt {:.3g}, limit {:.3g}",
                                                                gauge.is_damper ? "c" : "ω",
                                                                     gauge.measure, gauge.limit);
        show_bar(share, of);
        ImGui::PopStyleColor();
        if (share >= 1 && gauge.limit > 0)
            wrapped(
                fmt::format("{} needs {:.0f} Hz here, or it explodes.", run.stepping.method->name,
                            std::floor(share * static_cast<double>(run.stepping.rate.steps)) + 1));
    }

    static void show_costs(const Inspected& run) {
        const double total = run.costs.total();
        if (total == 0) return;
        ImGui::Separator();
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
        show_bar(total / frame_at_60_hz, share);
        if (run.dropped > 0)
            text(fmt::format("dropped because of late frames: {:.2f} s", run.dropped));
    }

    static void show_energy(const Inspected& run) {
        if (run.bodies == 0) return;
        ImGui::Separator();
        if (!std::isfinite(run.energy)) return text("energy: infinite");
        if (!run.first_energy) return text("energy " + energy_text(run.energy));
        const double change = run.energy - *run.first_energy;
        wrapped(fmt::format("energy {}, {}{} {}", energy_text(run.energy), change < 0 ? "" : "+",
                            energy_text(change), since(run)));
        if (!(run.energy_scale > 0)) return;
        const double percent = 100 * change / run.energy_scale;
        const std::string share = std::abs(percent) < 99.5 ? fmt::format("{:+.2g} %", percent)
                                                           : fmt::format("{:+.0f} %", percent);
        wrapped(fmt::format(
            "{} of {}, the {}", share, energy_text(run.energy_scale),
            run.is_scale_kinetic ? "largest kinetic energy" : "range of the potential energy"));
    }

    /// "this", "120 Hz", "rk4", "float".
    static std::string difference(const Stepping& other, const Stepping& run) {
        const std::string words = difference_text(other, run);
        return words.empty() ? "this run" : words;
    }

    static std::string since(const Inspected& run) {
        if (run.begin > run.time) return "since before the restart";
        return run.begin == 0 ? "since the start" : fmt::format("since {:.2f} s", run.begin);
    }

    Gui gui;
    bool has_menu = false;
    bool changes_from_start = false;
    Shown shown;
    int place = 0;  ///< of the rate on the slider
    bool is_sliding = false;
    std::int64_t seeked = 0;  ///< the step of the time line
    bool is_seeking = false;
};

Size Inspector::view(Size frame) {
    const float unit = Gui::unit_of(frame);
    const float share = panel_share * static_cast<float>(frame.width);
    const auto panel = static_cast<int>(std::clamp(share, narrow_panel * unit, panel_width * unit));
    return {frame.width - std::min(panel, 2 * frame.width / 3), frame.height};
}

Inspector::Inspector(std::span<const char> font) : impl_(std::make_unique<Impl>(font)) {}
Inspector::~Inspector() = default;

Requests Inspector::show(const Inspected& run, const Mouse& mouse, Size frame, double seconds) {
    Requests requests;
    impl_->gui.begin(mouse, frame, seconds, run.theme);
    const auto panel = static_cast<float>(frame.width - view(frame).width);
    ImGui::SetNextWindowPos({static_cast<float>(frame.width) - panel, 0});
    ImGui::SetNextWindowSize({panel, static_cast<float>(frame.height)});
    ImGui::Begin("Inspector", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove);
    if (!run.hides_setting) {
        Impl::show_verdict(run);
        impl_->show_setting(run, mouse.escapes, requests);
    }
    if (!run.fixed.empty()) wrapped(run.fixed);
    Impl::show_threads(run, requests);
    impl_->show_controls(run, requests);
    Impl::show_state(run);
    impl_->show_overlays(run);
    if (!run.hides_setting) {
        Impl::show_settings(run, requests);
        Impl::show_gauge(run);
    }
    Impl::show_costs(run);
    Impl::show_energy(run);
    ImGui::End();
    impl_->gui.end();
    requests.changes_from_start = impl_->changes_from_start;
    requests.shown = impl_->shown;
    return requests;
}

const Overlay& Inspector::overlay() const { return impl_->gui.overlay(); }
bool Inspector::has_mouse() const { return impl_->gui.has_mouse(); }
bool Inspector::has_menu() const { return impl_->has_menu; }

}  // namespace oiler
