// SPDX-License-Identifier: MIT
#include "oiler/compare/captures/comparison.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "oiler/compare/captures/captured.hpp"
#include "oiler/compare/captures/changes.hpp"
#include "oiler/core/error.hpp"

namespace oiler {
namespace {

std::string change_of(const std::string& golden, const std::string& actual) {
    return golden == actual ? "" : fmt::format("{} → {}", golden, actual);
}

struct PixelChange {
    std::int64_t differing = 0;
    int largest = 0;
};

PixelChange pixel_change(const Image& golden, const Image& actual) {
    PixelChange change;
    for (std::size_t i = 0; i < golden.rgb_bottom_up.size(); i += 3) {
        int largest = 0;
        for (std::size_t channel = i; channel < i + 3; ++channel)
            largest = std::max(
                largest, std::abs(golden.rgb_bottom_up[channel] - actual.rgb_bottom_up[channel]));
        change.differing += largest > 0 ? 1 : 0;
        change.largest = std::max(change.largest, largest);
    }
    return change;
}

/// Compares two captures frame by frame.
class Comparer {
public:
    Comparer(const Captured& golden, const Captured& actual, const PixelTolerance& tolerance)
        : golden_(golden),
          actual_(actual),
          tolerance_(tolerance),
          golden_ticks_(golden.tick_hashes()),
          actual_ticks_(actual.tick_hashes()) {}

    [[nodiscard]] Comparison compare() {
        const Manifest& before = golden_.manifest();
        const Manifest& after = actual_.manifest();
        Comparison comparison{
            .golden = golden_.folder(), .actual = actual_.folder(), .tolerance = tolerance_};
        comparison.renderer = change_of(before.gl_renderer, after.gl_renderer);
        comparison.settings = setting_changes(before, after);
        if (auto change = scene_change(before.scene_text, after.scene_text); !change.empty())
            comparison.findings.push_back(std::move(change));
        const std::size_t count = std::max(before.frames.size(), after.frames.size());
        for (std::size_t i = 0; i < count; ++i)
            comparison.frames.push_back(compare_frame(static_cast<std::int64_t>(i)));
        comparison.verdict = verdict_of(comparison);
        return comparison;
    }

private:
    [[nodiscard]] const Manifest::Frame& golden(std::int64_t index) const {
        return golden_.manifest().frames[static_cast<std::size_t>(index)];
    }
    [[nodiscard]] const Manifest::Frame& actual(std::int64_t index) const {
        return actual_.manifest().frames[static_cast<std::size_t>(index)];
    }

    [[nodiscard]] FrameComparison compare_frame(std::int64_t index) {
        const bool has_golden = index < std::int64_t(golden_.manifest().frames.size());
        const bool has_actual = index < std::int64_t(actual_.manifest().frames.size());
        const Manifest::Frame& any = has_golden ? golden(index) : actual(index);
        FrameComparison result{.index = index,
                               .tick = any.tick,
                               .time = static_cast<double>(index) / golden_.manifest().fps};
        if (!has_golden || !has_actual) {
            result.cause = Cause::missing;
            result.words =
                has_golden ? "the frame was not captured" : "the golden has no such frame";
            return result;
        }
        result.cause = cause_of(index);
        result.other_tick = golden(index).tick != actual(index).tick;
        if (result.cause == Cause::simulation) result.words = describe_simulation(index);
        if (result.cause == Cause::picture) result.words = describe_picture(index);
        if (result.cause != Cause::none) compare_pixels(result);
        if (result.cause == Cause::none) require_image(golden_, "golden", result);
        if (result.cause == Cause::none) require_image(actual_, "actual capture", result);
        return result;
    }

    /// Whether the states between this frame and the one before differ, as far as both know them.
    [[nodiscard]] static bool has_other_ticks_before(const Manifest::Frame& before,
                                                     const Manifest::Frame& after) {
        return before.tick_hashes.size() == after.tick_hashes.size() &&
               before.tick_hashes != after.tick_hashes;
    }

    [[nodiscard]] Cause cause_of(std::int64_t index) const {
        const Manifest::Frame& before = golden(index);
        const Manifest::Frame& after = actual(index);
        if (before.state_hash != after.state_hash || before.tick != after.tick ||
            has_other_ticks_before(before, after))
            return Cause::simulation;
        if (before.picture_hash != after.picture_hash || before.alpha != after.alpha)
            return Cause::picture;
        const bool same_size = golden_.manifest().size == actual_.manifest().size;
        return before.pixel_hash == after.pixel_hash && same_size ? Cause::none : Cause::pixels;
    }

    /// Hashes are of the manifests; the files may be gone or hold something else.
    void require_image(const Captured& capture, const char* owner, FrameComparison& result) const {
        const Manifest::Frame& frame =
            capture.manifest().frames[static_cast<std::size_t>(result.index)];
        if (frame.file.empty()) return;
        if (capture.has_image(result.index)) {
            static_cast<void>(capture.image(result.index));
            return;
        }
        result.cause = Cause::missing;
        result.words = fmt::format("{} of the {} is missing", frame.file, owner);
    }

    /// The first tick whose state differs, in words.
    [[nodiscard]] std::string describe_tick(std::int64_t index) const {
        const std::int64_t tick = golden(index).tick;
        if (tick != actual(index).tick)
            return fmt::format("frame {} shows tick {} instead of {}", index, actual(index).tick,
                               tick);
        const std::int64_t last = index > 0 ? golden(index - 1).tick : 0;
        for (std::int64_t t = last + 1; t <= tick; ++t) {
            if (!golden_ticks_.contains(t) || !actual_ticks_.contains(t))
                return fmt::format("between ticks {} and {}", last, tick);
            if (golden_ticks_.at(t) != actual_ticks_.at(t)) return fmt::format("at tick {}", t);
        }
        return fmt::format("at tick {}", tick);
    }

    /// Obstacles come first: they move bodies, and not the other way round.
    [[nodiscard]] std::string describe_states(const FrameRecord& before,
                                              const FrameRecord& after) const {
        const std::string obstacles =
            before.obstacles && after.obstacles
                ? describe_obstacle_change(*before.obstacles, *after.obstacles)
                : "";
        const std::string bodies =
            describe_state_change(before.bodies, after.bodies, golden_.manifest().precision);
        return obstacles + (obstacles.empty() || bodies.empty() ? "" : "; ") + bodies;
    }

    [[nodiscard]] std::string describe_simulation(std::int64_t index) const {
        const std::string where = describe_tick(index);
        const FrameRecord* const before = golden_.record(index);
        const FrameRecord* const after = actual_.record(index);
        if (!before || !after) return where + ": no bodies of this frame are recorded";
        const std::string shift = describe_shift(index, [&](std::int64_t a, std::int64_t b) {
            const FrameRecord* const moved = actual_.record(a);
            const FrameRecord* const other = golden_.record(b);
            return moved && other && !other->bodies.empty() && moved->bodies == other->bodies;
        });
        if (!shift.empty()) return fmt::format("{}: frame {} {}", where, index, shift);
        if (golden(index).tick != actual(index).tick) return where;
        const std::string change = describe_states(*before, *after);
        if (change.empty()) return where + "; this frame shows the same bodies";
        if (where == fmt::format("at tick {}", golden(index).tick))
            return fmt::format("{}: {}", where, change);
        return fmt::format("{}; frame {} (tick {}) shows {}", where, index, golden(index).tick,
                           change);
    }

    [[nodiscard]] std::string describe_picture(std::int64_t index) const {
        const std::string shift = describe_shift(index, [&](std::int64_t a, std::int64_t b) {
            return actual(a).picture_hash == golden(b).picture_hash;
        });
        if (!shift.empty()) return "it " + shift;
        const FrameRecord* const before = golden_.record(index);
        const FrameRecord* const after = actual_.record(index);
        if (!before || !after) return "no records of this frame";
        const std::string change =
            describe_picture_change(before->picture, after->picture, golden_.manifest().size);
        if (!change.empty()) return change;
        const double alpha = golden(index).alpha;
        return alpha == actual(index).alpha
                   ? "numbers of other bits that are equal, such as 0 and -0"
                   : fmt::format("alpha {} → {}", alpha, actual(index).alpha);
    }

    /// Words if this frame and the next are later or earlier frames of the golden. `is_same`
    /// compares an actual frame with a golden one.
    template <class IsSame>
    [[nodiscard]] std::string describe_shift(std::int64_t index, const IsSame& is_same) const {
        constexpr std::int64_t most_shift = 8;  // frames
        const auto golden_count = std::int64_t(golden_.manifest().frames.size());
        const auto actual_count = std::int64_t(actual_.manifest().frames.size());
        const auto fits = [&](std::int64_t frame, std::int64_t shift) {
            const std::int64_t other = frame + shift;
            return other >= 0 && other < golden_count && is_same(frame, other);
        };
        for (std::int64_t distance = 1; distance <= most_shift; ++distance)
            for (const std::int64_t shift : {distance, -distance}) {
                const bool has_next = index + 1 < actual_count && index + 1 + shift < golden_count;
                if (fits(index, shift) && (!has_next || fits(index + 1, shift)))
                    return fmt::format(
                        "shows frame {} of the golden (tick {}): shifted by {} "
                        "frame{}",
                        index + shift, golden(index + shift).tick, shift, distance == 1 ? "" : "s");
            }
        return {};
    }

    /// Decoding is slow: besides frames of which only pixels differ, only those of the page are
    /// decoded.
    void compare_pixels(FrameComparison& result) {
        const bool pixels_only = result.cause == Cause::pixels;
        if (!pixels_only && images_ == most_shown_frames) return;
        if (golden_.manifest().size != actual_.manifest().size) {
            if (pixels_only) result.words = "frames of another size";
            return;
        }
        if (!golden_.has_image(result.index) || !actual_.has_image(result.index)) {
            if (pixels_only) judge_without_images(result);
            return;
        }
        const PixelChange change =
            pixel_change(golden_.image(result.index), actual_.image(result.index));
        const Size size = golden_.manifest().size;
        result.has_images = true;
        ++images_;
        result.differing = change.differing;
        result.largest = change.largest;
        result.share = static_cast<double>(change.differing) / size.width / size.height;
        if (!pixels_only) return;
        result.tolerated = change.largest <= tolerance_.channel && result.share <= tolerance_.share;
        result.words =
            fmt::format("{} of {} pixels differ ({:.3g} %), by at most {}", change.differing,
                        size.width * size.height, 100 * result.share, change.largest);
        if (!result.tolerated)
            result.words += fmt::format("; tolerated are {:g} %, by at most {}",
                                        100 * tolerance_.share, tolerance_.channel);
    }

    /// Without a PNG, pixels can only be equal. Another renderer may draw other ones.
    void judge_without_images(FrameComparison& result) const {
        result.tolerated = golden_.manifest().gl_renderer != actual_.manifest().gl_renderer &&
                           golden(result.index).file.empty();
        result.words = result.tolerated ? "pixels of another renderer, not compared without a PNG"
                                        : "pixels differ, but a PNG is missing";
    }

    const Captured& golden_;
    const Captured& actual_;
    const PixelTolerance& tolerance_;
    std::map<std::int64_t, std::string> golden_ticks_;
    std::map<std::int64_t, std::string> actual_ticks_;
    std::int64_t images_ = 0;  ///< pairs of images compared so far
};

}  // namespace

Comparison compare_captures(const std::filesystem::path& golden,
                            const std::filesystem::path& actual, const PixelTolerance& tolerance) {
    const Captured before(golden);
    const Captured after(actual);
    if (!before.manifest().is_finished())
        fail(Exit::usage, "{}: the capture was not finished ({} of {} frames); write it again",
             golden.string(), before.manifest().frames.size(), before.manifest().planned_frames);
    return Comparer(before, after, tolerance).compare();
}

}  // namespace oiler
