// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "oiler/picture/picture.hpp"

namespace oiler::certify {

struct Figure {
    std::string name;  ///< a file's, without the extension
    Picture picture;
};

/// The graphs that the article Integration Basics describes, in its order, drawn from runs of this
/// engine over the exact motion. What a caption says of them is computed from the same runs, so
/// that it also holds where the article is loose: RK4 does not keep the frequency, and being
/// symplectic explains nothing of a spring with damping.
[[nodiscard]] std::vector<Figure> article_figures();

}  // namespace oiler::certify
