// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "oiler/input/input.hpp"

namespace oiler {

/// A change of the input between two steps, as recordings keep it.
struct InputEvent {
    enum class What : std::uint8_t {
        edge,
        stick,
        pointer,
        no_pointer,
        camera,
        wheel,
        text,
        restart
    };
    static constexpr std::uint8_t what_count = 8;

    What what = What::edge;
    std::uint16_t button = 0;  ///< of an edge: its id
    bool down = false;
    std::uint8_t stick = 0;
    Deflection deflection = 0;
    Point canvas{};   ///< of the pointer
    Camera camera{};  ///< through which the pointer points
    int notches = 0;  ///< of the wheel
    std::string text{};

    friend bool operator==(const InputEvent&, const InputEvent&) = default;
};

/// The events that lead from the input of a step to that of the next.
[[nodiscard]] std::vector<InputEvent> events_between(const Input& before, const Input& now);

/// Feeds the events of a step to a queue, which then returns the same input again.
class EventPlayer {
public:
    explicit EventPlayer(ChosenControls controls = {}) : queue_(std::move(controls)) {}

    void play(const InputEvent& event);
    [[nodiscard]] Input take() { return queue_.take(camera_); }

private:
    InputQueue queue_;
    Camera camera_{};
};

/// Appends an event to bytes, little-endian, whole numbers in groups of seven bits.
void append(std::string& bytes, const InputEvent& event);
/// Takes an event from the front of bytes; empty if they are not one.
[[nodiscard]] std::optional<InputEvent> take_event(std::string_view& bytes);

void append_number(std::string& bytes, std::uint64_t number);
[[nodiscard]] std::optional<std::uint64_t> take_number(std::string_view& bytes);

}  // namespace oiler
