// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "oiler/game/game.hpp"

namespace oiler {

/// Other games that a window can show instead, such as the scenes of a folder. MakeGame makes the
/// game taken last.
class Shelf {
public:
    /// A game that was taken from the shelf.
    struct Taken {
        std::string title;
        Stepping stepping;
    };

    Shelf() = default;
    virtual ~Shelf() = default;
    Shelf(const Shelf&) = delete;
    Shelf& operator=(const Shelf&) = delete;

    /// Takes another game if the shown one asks for it, if a file was dropped on the window, or if
    /// the shown one has changed on disk. Throws Error if it cannot be made; then the shown one
    /// stays.
    [[nodiscard]] virtual std::optional<Taken> take(const AnyGame& shown,
                                                    const std::optional<std::string>& dropped) = 0;
};

}  // namespace oiler
