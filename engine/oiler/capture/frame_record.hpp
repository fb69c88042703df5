// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "oiler/picture/picture.hpp"

namespace oiler {

/// The state of a body at the tick of a frame.
struct BodyState {
    std::string name;                  ///< "bob", or "body 3"
    std::array<double, 3> position{};  ///< m
    std::array<double, 3> velocity{};  ///< m/s
    friend bool operator==(const BodyState&, const BodyState&) = default;
};

/// An obstacle at the tick of a frame.
struct ObstacleState {
    std::string name;   ///< "lift", or "obstacle 3"
    std::string shape;  ///< "circle"
    /// By their names: place and size (m), angle, velocity, surface. Those that are 0 may be
    /// absent.
    std::map<std::string, double, std::less<>> numbers{};
    friend bool operator==(const ObstacleState&, const ObstacleState&) = default;
};

/// The contents of a frame before OpenGL: hashes tell that two frames differ, records tell where.
struct FrameRecord {
    std::int64_t index = 0;
    std::vector<BodyState> bodies{};
    std::optional<std::vector<ObstacleState>> obstacles{};  ///< absent if they are too many
    Picture picture{};
};

/// Returns whether the record is small enough to be kept: up to 1000 bodies and 20,000 points.
[[nodiscard]] bool is_recordable(std::size_t bodies, const Picture& picture);

/// One line of JSON with a line feed. Finite numbers read back to the same bits, other numbers as
/// NaN.
[[nodiscard]] std::string to_json(const FrameRecord& record);

/// Reads the lines of to_json(). Throws Error{usage}; `file` is named in the message.
[[nodiscard]] std::vector<FrameRecord> parse_frame_records(std::string_view lines,
                                                           std::string_view file);

/// Compresses a text as one member of a gzip file. Members may follow each other in one file; gzip
/// -d and zcat join their texts. The same text always gives the same bytes.
[[nodiscard]] std::vector<std::byte> gzip(std::string_view text);

/// Returns the texts of all members. Throws Error{usage} for damaged bytes and for a member of more
/// than 256 MiB; `file` is named in the message.
[[nodiscard]] std::string gunzip(std::span<const std::byte> bytes, std::string_view file);

}  // namespace oiler
