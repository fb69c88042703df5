// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "oiler/picture/picture.hpp"

namespace oiler::certify {

struct Figure {
    std::string name;  ///< file name without extension
    Picture picture;
};

/// Draws the graphs that the article Integration Basics describes, in its order, from runs of this
/// engine over the exact motion. Numbers in captions are computed from the same runs. They correct
/// the article twice: RK4 does not keep the frequency, and being symplectic does not explain the
/// stability of a damped spring.
[[nodiscard]] std::vector<Figure> article_figures();

}  // namespace oiler::certify
