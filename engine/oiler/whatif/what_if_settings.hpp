// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "oiler/game/game.hpp"

namespace oiler {

/// Reads settings such as "30,rk4,velocity_verlet@120,float". The words of a setting, with @
/// between them, are a rate in Hz, a method, a precision and a damping; what a setting does not
/// name is that of the recording. Throws Error{usage}.
[[nodiscard]] std::vector<Stepping> parse_what_if(const std::string& words,
                                                  const Stepping& recorded);

/// The settings that one tries first: half the rate if it is even, twice the rate, three usual
/// methods and the other precision, without methods that cannot step the bodies of the game.
[[nodiscard]] std::vector<Stepping> usual_what_if(const Settings& recorded, const MakeGame& make);

/// "rk4, 60 Hz, double".
[[nodiscard]] std::string describe(const Stepping& stepping);

}  // namespace oiler
