// SPDX-License-Identifier: MIT
#include "oiler/compare/comparison.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace oiler {

std::string_view name_of(Cause cause) {
    switch (cause) {
        case Cause::missing:
            return "missing";
        case Cause::simulation:
            return "simulation";
        case Cause::picture:
            return "picture";
        case Cause::pixels:
            return "pixels";
        case Cause::none:
            break;
    }
    return "none";
}

bool Comparison::passed() const {
    return std::all_of(frames.begin(), frames.end(),
                       [](const FrameComparison& frame) { return frame.passed(); });
}

std::int64_t Comparison::count(Cause cause) const {
    return std::count_if(frames.begin(), frames.end(),
                         [&](const FrameComparison& frame) { return frame.cause == cause; });
}

namespace {

std::string frames_are(std::int64_t count) {
    return count == 1 ? "1 frame is" : fmt::format("{} frames are", count);
}

}  // namespace

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
    const auto unseen =
        std::count_if(comparison.frames.begin(), comparison.frames.end(), is_unseen);
    const std::int64_t tolerated = comparison.count(Cause::pixels) - unseen;
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
    const auto count_failed = [&](Cause cause) {
        return std::count_if(
            comparison.frames.begin(), comparison.frames.end(),
            [&](const FrameComparison& frame) { return frame.cause == cause && !frame.tolerated; });
    };
    const std::int64_t tolerated = comparison.count(Cause::pixels) - count_failed(Cause::pixels);
    text += fmt::format("{} frames:", comparison.frames.size());
    for (const Cause cause :
         {Cause::none, Cause::simulation, Cause::picture, Cause::pixels, Cause::missing})
        if (const std::int64_t count = count_failed(cause); count > 0)
            text += fmt::format(" {} {};", count, cause == Cause::none ? "equal" : name_of(cause));
    if (tolerated > 0) text += fmt::format(" {} tolerated;", tolerated);
    text.back() = '\n';
    return text;
}

Json json_of(const Comparison& comparison) {
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
                      {"missing", comparison.count(Cause::missing)}};
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

}  // namespace oiler
