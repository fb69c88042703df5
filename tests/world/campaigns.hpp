// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>

namespace oiler::test {

/// The size of a test: a part in the suite, the whole in a campaign, which sets OILER_WHOLE.
[[nodiscard]] inline int whole(int part, int campaign) {
    return std::getenv("OILER_WHOLE") ? campaign : part;
}
/// Prints figures in a campaign.
template <class... Part>
void say(fmt::format_string<Part...> text, Part&&... parts) {
    if (!std::getenv("OILER_WHOLE")) return;
    fmt::vprint(text, fmt::make_format_args(parts...));
    std::putchar('\n');
}

}  // namespace oiler::test
