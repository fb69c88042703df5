// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string_view>

namespace oiler::house {

/// A room of engine/oiler, or a floor of a room ("lab/sweep"), and the rooms, floors or files that
/// it may include besides itself, separated by spaces.
struct Row {
    std::string_view place;
    std::string_view may_include;
};

/// The plan. A room may include every floor of a room that it may include. A floor may include what
/// its room may include of other rooms; of its own room only what its row names.
inline constexpr std::array plan{
    Row{"core", ""},
    Row{"math", "core"},
    Row{"physics", "core math"},
    Row{"sim", "core math physics"},
    Row{"stability", "core math physics sim"},
    Row{"world", "core math physics sim stability"},
    Row{"picture", "core math"},
    Row{"plot", "core math picture"},
    Row{"toml", "core"},
    Row{"scene", "core math physics sim stability world picture toml"},
    Row{"certify", "core math physics sim stability picture plot"},
    Row{"lab",
        "core math physics sim stability world picture plot scene"
        " lab/reference lab/sweep lab/advice lab/ledger"},
    Row{"lab/reference", ""},
    Row{"lab/sweep", "lab/reference"},
    Row{"lab/advice", "lab/reference lab/sweep"},
    Row{"lab/ledger", "lab/reference"},
    Row{"input", "core math picture"},
    Row{"platform", "core input"},
    Row{"render", "core math picture"},
    Row{"capture", "core math picture"},
    Row{"compare", "core math picture capture"},
    Row{"inspector", "core math physics sim stability world picture plot scene lab render"},
    Row{"app",
        "core math physics sim stability world picture plot toml scene certify lab input platform"
        " render capture compare inspector"},
    Row{"cli",
        "core math physics sim stability world picture plot toml scene certify lab input platform"
        " render capture compare inspector app"},
    // The one include of a game: no room may include it.
    Row{"oiler.hpp",
        "core math physics sim stability world picture plot toml scene certify lab input platform"
        " render capture compare inspector app"},
};

/// The files that may include headers of windows and of OpenGL's providers.
inline constexpr std::array providers{"platform/sdl2.cpp", "platform/sdl2_events.cpp",
                                      "platform/sdl2_events.hpp", "platform/osmesa.cpp",
                                      "platform/egl.cpp"};

/// Folders whose targets depend on options, presets and installed libraries. CMake's list of
/// compile commands may lack their files; then the CMake files of the folder must name them.
inline constexpr std::array optional_folders{"tests/bench", "tests/bits", "tests/fuzz",
                                             "tests/install"};

}  // namespace oiler::house
