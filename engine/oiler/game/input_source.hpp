// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "oiler/input/input_queue.hpp"

namespace oiler {

/// Where the steps of a game get their input from.
class InputSource {
public:
    virtual ~InputSource() = default;
    InputSource() = default;
    InputSource(const InputSource&) = delete;
    InputSource& operator=(const InputSource&) = delete;

    /// The input of a step of the loop, counted from 0. Steps are asked for in their order.
    [[nodiscard]] virtual Input next(std::int64_t step) = 0;
};

/// A player in the window. Steps see the camera of the picture that was on screen.
class LiveInput final : public InputSource {
public:
    explicit LiveInput(const ChosenControls& controls = {}) : queue(controls) {}

    [[nodiscard]] Input next(std::int64_t) override { return queue.take(shown); }

    InputQueue queue;
    Camera shown{};
};

}  // namespace oiler
