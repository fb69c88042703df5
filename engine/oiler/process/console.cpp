// SPDX-License-Identifier: MIT
#include "oiler/process/console.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>

#include "oiler/core/timing.hpp"
#include "oiler/core/utf8.hpp"

namespace oiler {

void fill_closed_streams() {
    // open() takes the lowest free descriptor, which is the closed stream itself.
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (fcntl(stream, F_GETFD) < 0)
            (void)open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);
}

void say(const std::string& line) { std::fputs((for_terminal(line) + '\n').c_str(), stderr); }

Progress::Progress(bool quiet, std::string what, std::int64_t total)
    : what_(std::move(what)), total_(total), visible_(!quiet && isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
    if (shown_percent_ >= 0) std::fputc('\n', stderr);
}

std::string time_left(double passed, double share) {
    const double left = passed * (1 - share) / share;
    if (share < 0.02 || passed < 1 || left < 1) return "";
    return left < 100 ? fmt::format(", {:.0f} s left", left)
                      : fmt::format(", {:.0f} min left", left / 60);
}

void Progress::show(std::int64_t done) {
    const double share = total_ > 0 ? static_cast<double>(done) / static_cast<double>(total_) : 1;
    const int percent = static_cast<int>(100 * share);
    if (!visible_ || percent == shown_percent_) return;
    shown_percent_ = percent;
    const std::string filled(static_cast<std::size_t>(percent * 40 / 100), '#');
    std::fputs(fmt::format("\r[{:<40}] {}/{} {}{:<16}", filled, done, total_, what_,
                           time_left(seconds_since(start_), share))
                   .c_str(),
               stderr);
    std::fflush(stderr);
}

}  // namespace oiler
