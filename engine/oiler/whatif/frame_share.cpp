// SPDX-License-Identifier: MIT
#include "oiler/whatif/frame_share.hpp"

#include <algorithm>

namespace oiler {

void FrameShare::begin_frame(Clock::time_point now) {
    if (++frames_ == frames_of_window) {
        constexpr double late = 1.07;  // so two frames of a window
        constexpr double growth = 1.05;
        constexpr double forgetting = 1.005;  // a display may become slower
        const Milliseconds time = now - window_;
        share_ =
            time > late * shortest_ ? std::max(share_ / 2, least) : std::min(growth * share_, most);
        shortest_ = std::min(forgetting * shortest_, time);
        window_ = now;
        frames_ = 0;
    }
    left_ = std::min(left_ + share_, share_);
}

}  // namespace oiler
