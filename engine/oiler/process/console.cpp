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

std::string rough_time(double seconds) {
    constexpr double minute = 60;
    constexpr double hour = 3600;
    constexpr double day = 86400;
    if (seconds < 100) return fmt::format("{:.0f} s", seconds);
    if (seconds < 100 * minute) return fmt::format("{:.0f} min", seconds / minute);
    if (seconds < 100 * hour) return fmt::format("{:.0f} h", seconds / hour);
    return fmt::format("{:.0f} days", seconds / day);
}

void announce(bool quiet, std::string_view what, double steps, double seconds) {
    constexpr double short_time = 10;  // s
    if (seconds > short_time)
        remark(quiet, "{}: {:.3g} steps take about {}; --time-limit S ends earlier", what, steps,
               rough_time(seconds));
}

std::string time_left(double passed, double share) {
    const double left = passed * (1 - share) / share;
    if (share < 0.02 || passed < 1 || left < 1) return "";
    return fmt::format(", {} left", rough_time(left));
}

std::string describe_long_work(std::string_view work, double passed, double share) {
    constexpr double early = 2;        // s
    constexpr double short_time = 10;  // s
    if (passed < early || passed < share * short_time) return "";
    return fmt::format("{:.0f} % {}{}; --time-limit S ends earlier", 100 * share, work,
                       time_left(passed, share));
}

double Progress::passed() const { return seconds_since(start_); }

void Progress::show(std::int64_t done) {
    const double share = total_ > 0 ? static_cast<double>(done) / static_cast<double>(total_) : 1;
    const int percent = static_cast<int>(100 * share);
    if (!visible_ || percent == shown_percent_) return;
    shown_percent_ = percent;
    const std::string filled(static_cast<std::size_t>(percent * 40 / 100), '#');
    std::fputs(fmt::format("\r[{:<40}] {}/{} {}{:<16}", filled, done, total_, what_,
                           time_left(passed(), share))
                   .c_str(),
               stderr);
    std::fflush(stderr);
}

}  // namespace oiler
