// SPDX-License-Identifier: MIT
#include "oiler/compare/captures/comparison.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <span>
#include <sstream>
#include <utility>

namespace oiler {
namespace {

std::string or_own(const std::string& text) { return text.empty() ? "the method's own" : text; }

/// The text of a line of TOML. A # in quotes starts no comment: it may be of a colour.
std::string without_comment(const std::string& line) {
    char quote = 0;
    std::size_t end = 0;
    for (; end < line.size() && (quote != 0 || line[end] != '#'); ++end)
        if (quote == 0 && (line[end] == '"' || line[end] == '\''))
            quote = line[end];
        else if (line[end] == '\\' && quote == '"')
            ++end;
        else if (line[end] == quote)
            quote = 0;
    std::string text = line.substr(0, end);
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return text;
}

struct Line {
    std::size_t number = 0;  ///< from 1
    std::string text;

    [[nodiscard]] bool operator==(const Line& other) const { return text == other.text; }
};

/// The lines without comments, without the line breaks of any system, and without empty lines.
std::vector<Line> lines_of(const std::string& text) {
    std::vector<Line> lines;
    std::istringstream stream(text);
    std::size_t number = 0;
    for (std::string line; std::getline(stream, line);) {
        ++number;
        if (line.ends_with('\r')) line.pop_back();
        if (std::string rest = without_comment(line); !rest.empty())
            lines.push_back({number, std::move(rest)});
    }
    return lines;
}

/// "scene file changed, line 33: added `damping = 0.0`"; of several lines the first one.
std::string describe_block(std::size_t line, std::span<const Line> removed,
                           std::span<const Line> added) {
    const auto words = [](std::string_view verb, std::span<const Line> lines) {
        const std::string more =
            lines.size() > 1 ? fmt::format(" and {} more", lines.size() - 1) : "";
        return lines.empty() ? "" : fmt::format("{} `{}`{}", verb, lines.front().text, more);
    };
    const std::string gone = words("removed", removed);
    const std::string fresh = words("added", added);
    return fmt::format("scene file changed, line {}: {}{}{}", line, gone,
                       gone.empty() || fresh.empty() ? "" : ", ", fresh);
}

std::string frames_are(std::int64_t count) {
    return count == 1 ? "1 frame is" : fmt::format("{} frames are", count);
}

}  // namespace

std::string_view name_of(Cause cause) {
    constexpr std::string_view names[]{"none", "missing", "simulation", "picture", "pixels"};
    return names[static_cast<std::size_t>(cause)];
}

bool Comparison::passed() const { return std::ranges::all_of(frames, &FrameComparison::passed); }

std::int64_t Comparison::count(Cause cause) const {
    return std::ranges::count_if(frames, [&](const FrameComparison& frame) {
        return frame.cause == cause && !frame.tolerated;
    });
}

std::int64_t Comparison::tolerated() const {
    return std::ranges::count(frames, true, &FrameComparison::tolerated);
}

std::string verdict_of(const Comparison& comparison) {
    const auto first = [&](Cause cause) -> const FrameComparison* {
        for (const FrameComparison& frame : comparison.frames)
            if (frame.cause == cause && !frame.passed()) return &frame;
        return nullptr;
    };
    if (const auto* frame = first(Cause::simulation))
        return (frame->other_tick ? "frames show other ticks: " : "simulation changed ") +
               frame->words;
    if (const auto* frame = first(Cause::picture))
        return fmt::format("picture changed at frame {}: {}", frame->index, frame->words);
    if (const auto* frame = first(Cause::pixels))
        return fmt::format("only pixels changed, at frame {}: {}{}", frame->index, frame->words,
                           comparison.renderer.empty() ? "" : "; the renderer differs");
    if (const auto* frame = first(Cause::missing))
        return fmt::format("{} missing, the first is frame {}: {}",
                           frames_are(comparison.count(Cause::missing)), frame->index,
                           frame->words);
    const auto is_unseen = [](const FrameComparison& frame) {
        return frame.tolerated && !frame.has_images;
    };
    const auto unseen = std::ranges::count_if(comparison.frames, is_unseen);
    const std::int64_t tolerated = comparison.tolerated() - unseen;
    const std::string equal = frames_are(std::ssize(comparison.frames)) + " equal";
    std::string text = equal;
    if (tolerated > 0)
        text += fmt::format(", {} of them within the tolerance of the pixels", tolerated);
    if (unseen > 0)
        text += fmt::format(
            ", {} of them but for pixels that could not be compared: another renderer drew them, "
            "and they have no PNG",
            unseen);
    return text;
}

std::string describe(const Comparison& comparison) {
    std::string text;
    if (!comparison.renderer.empty())
        text += fmt::format("renderer differs: {}\n", comparison.renderer);
    text += comparison.verdict + "\n";
    for (const SettingChange& change : comparison.settings)
        text += fmt::format("{}: {} → {}\n", change.name, change.golden, change.actual);
    for (const std::string& finding : comparison.findings) text += finding + "\n";
    if (comparison.passed()) return text;
    text += fmt::format("{} frames:", comparison.frames.size());
    for (const Cause cause :
         {Cause::none, Cause::simulation, Cause::picture, Cause::pixels, Cause::missing})
        if (const std::int64_t count = comparison.count(cause); count > 0)
            text += fmt::format(" {} {};", count, cause == Cause::none ? "equal" : name_of(cause));
    if (comparison.tolerated() > 0) text += fmt::format(" {} tolerated;", comparison.tolerated());
    text.back() = '\n';
    return text;
}

Json to_json(const Comparison& comparison) {
    Json json{{"golden", comparison.golden.string()},
              {"actual", comparison.actual.string()},
              {"passed", comparison.passed()},
              {"verdict", comparison.verdict},
              {"renderer", comparison.renderer.empty() ? Json() : Json(comparison.renderer)},
              {"findings", comparison.findings}};
    Json& settings = json["settings"] = Json::array();
    for (const SettingChange& change : comparison.settings)
        settings.push_back(
            {{"name", change.name}, {"golden", change.golden}, {"actual", change.actual}});
    json["counts"] = {{"frames", comparison.frames.size()},
                      {"equal", comparison.count(Cause::none)},
                      {"simulation", comparison.count(Cause::simulation)},
                      {"picture", comparison.count(Cause::picture)},
                      {"pixels", comparison.count(Cause::pixels)},
                      {"missing", comparison.count(Cause::missing)},
                      {"tolerated", comparison.tolerated()}};
    Json& frames = json["frames"] = Json::array();
    for (const FrameComparison& frame : comparison.frames)
        if (frame.cause != Cause::none)
            frames.push_back({{"index", frame.index},
                              {"tick", frame.tick},
                              {"time", frame.time},
                              {"cause", name_of(frame.cause)},
                              {"tolerated", frame.tolerated},
                              {"text", frame.words},
                              {"differing", frame.differing},
                              {"share", frame.share},
                              {"largest", frame.largest}});
    return json;
}

std::vector<SettingChange> setting_changes(const Manifest& golden, const Manifest& actual) {
    const auto text = [](auto number) { return std::to_string(number); };
    const auto size = [](Size s) { return fmt::format("{}x{}", s.width, s.height); };
    std::vector<SettingChange> all{
        {"scene", golden.scene, actual.scene},
        {"size", size(golden.size), size(actual.size)},
        {"fps", text(golden.fps), text(actual.fps)},
        {"frames", text(golden.planned_frames), text(actual.planned_frames)},
        {"rate", text(golden.rate), text(actual.rate)},
        {"method", golden.method, actual.method},
        {"damping", or_own(golden.damping), or_own(actual.damping)},
        {"precision", golden.precision, actual.precision},
        {"seed", text(golden.seed), text(actual.seed)},
        {"version", golden.version, actual.version},
        {"compiler", golden.compiler, actual.compiler},
        {"surface", golden.provider, actual.provider}};
    std::erase_if(all, [](const SettingChange& change) { return change.golden == change.actual; });
    return all;
}

std::string scene_change(const std::string& golden, const std::string& actual) {
    const std::vector<Line> before = lines_of(golden);
    const std::vector<Line> after = lines_of(actual);
    const std::size_t shorter = std::min(before.size(), after.size());
    std::size_t same = 0;
    while (same < shorter && before[same] == after[same]) ++same;
    if (same == before.size() && same == after.size()) return {};
    std::size_t same_at_end = 0;
    while (same_at_end < shorter - same &&
           before[before.size() - 1 - same_at_end] == after[after.size() - 1 - same_at_end])
        ++same_at_end;
    const std::size_t removed = before.size() - same - same_at_end;
    const std::size_t added = after.size() - same - same_at_end;
    const std::vector<Line>& with_line = added > 0 ? after : before;
    if (removed != added)
        return describe_block(with_line[same].number,
                              {before.begin() + std::ptrdiff_t(same), removed},
                              {after.begin() + std::ptrdiff_t(same), added});
    std::size_t changed = 0;
    for (std::size_t i = same; i < same + removed; ++i) changed += before[i] == after[i] ? 0 : 1;
    const std::string more = changed > 1 ? fmt::format(", and {} more", changed - 1) : "";
    return fmt::format("scene file changed, line {}: `{}` → `{}`{}", after[same].number,
                       before[same].text, after[same].text, more);
}

}  // namespace oiler
