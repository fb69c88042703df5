// SPDX-License-Identifier: MIT
#include "oiler/app/progress.hpp"

#include <unistd.h>

namespace oiler {

Progress::Progress(bool quiet, std::string what, std::int64_t total)
    : what_(std::move(what)), total_(total), visible_(!quiet && isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
    if (shown_percent_ >= 0) fmt::print(stderr, "\n");
}

void Progress::show(std::int64_t done) {
    const int percent = static_cast<int>(
        total_ > 0 ? 100.0 * static_cast<double>(done) / static_cast<double>(total_) : 100.0);
    if (!visible_ || percent == shown_percent_) return;
    shown_percent_ = percent;
    const auto filled = static_cast<std::size_t>(percent * 40 / 100);
    fmt::print(stderr, "\r[{:<40}] {}/{} {}", std::string(filled, '#'), done, total_, what_);
    std::fflush(stderr);
}

}  // namespace oiler
