// SPDX-License-Identifier: MIT
#pragma once

#include "oiler/picture/picture.hpp"

namespace oiler {

/// The contrast of two opaque colours, from 1 to 21 (WCAG 2.2, "contrast ratio"). Text needs 4.5.
[[nodiscard]] double contrast(Colour a, Colour b);

/// The colour for text: itself if its contrast with the ground is at least 4.5, else darker on a
/// light ground and lighter on a dark one.
[[nodiscard]] Colour readable(Colour colour, Colour ground = {255, 255, 255});

/// The colours of the loop's own texts and grounds. Ink and faint ink can be read on each ground;
/// other colours are for marks only.
struct Theme {
    Colour ink;
    Colour faint;  ///< of hints
    Colour paper;  ///< the ground of text over a picture
    Colour panel;  ///< grounds in the inspector, from here on
    Colour field;
    Colour heading;
    Colour button;
    Colour pressed;
    Colour knob;
};

/// Dark on a dark background, where light letters have more contrast than dark ones; else light.
[[nodiscard]] const Theme& theme_of(Colour background);

}  // namespace oiler
