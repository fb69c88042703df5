// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "oiler/sim/body.hpp"
#include "oiler/sim/methods.hpp"

namespace oiler {

/// How a scene is stepped.
struct SceneChoice {
    const Method* method = nullptr;
    std::int64_t rate = 0;  ///< steps per second
    Precision precision = Precision::double_;
    friend bool operator==(const SceneChoice&, const SceneChoice&) = default;
};

/// The text of a scene file with another choice in its table `scene`; all else, comments and
/// spacing too, stays as it was, and so does what says the same already. Throws Error{usage} where
/// the text is no scene, or would be none with that choice: not every method takes every force.
[[nodiscard]] std::string apply(std::string_view text, std::string_view file,
                                const SceneChoice& choice);

}  // namespace oiler
