// SPDX-License-Identifier: MIT
#include "oiler/core/length_text.hpp"

#include <fmt/core.h>

namespace oiler {

std::string length_text(double metres) {
    if (metres == 0) return "0 m";
    if (metres < 1e-12) return fmt::format("{:.0e} m", metres);
    if (metres < 99e-9) return fmt::format("{:.2g} nm", 1e9 * metres);
    if (metres < 9.95e-5) return fmt::format("{:.2g} µm", 1e6 * metres);
    if (metres < 0.01) return fmt::format("{:.2g} mm", 1000 * metres);
    if (metres < 0.995) return fmt::format("{:.2g} cm", 100 * metres);
    if (metres < 999.5) return fmt::format("{:.3g} m", metres);
    if (metres < 1e6) return fmt::format("{:.0f} m", metres);
    return fmt::format("{:.1e} m", metres);
}

}  // namespace oiler
