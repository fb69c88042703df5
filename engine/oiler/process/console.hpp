// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/core.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace oiler {

/// Opens /dev/null in place of closed standard streams. Otherwise the first opened file would take
/// their descriptor, and remarks would be written into the user's data. A closed standard output is
/// opened for reading, so that data for it are a write error.
void fill_closed_streams();

/// Prints a line on standard error, see for_terminal(). Write errors are ignored.
void say(const std::string& line);

/// Prints a line on standard error unless `quiet`.
template <class... Args>
void remark(bool quiet, fmt::format_string<Args...> line, Args&&... args) {
    if (!quiet) say(fmt::format(line, std::forward<Args>(args)...));
}

/// A duration to two or three digits: "12 s", "3 min", "20 h", "12 days".
[[nodiscard]] std::string rough_time(double seconds);

/// The time left after `passed` seconds for this share of the work: ", 12 s left", ", 3 min left".
/// Empty if it is too short to be of interest, or if it is too early for an estimate.
[[nodiscard]] std::string time_left(double passed, double share);

/// Says beforehand that so many steps are about to be taken, if that takes longer than some
/// seconds.
void announce(bool quiet, std::string_view what, double steps, double seconds);

/// The line for work that has no progress bar and will take longer than some seconds, once that is
/// seen: "12 % of the errors, 40 s left; --time-limit S ends earlier". Empty before.
[[nodiscard]] std::string describe_long_work(std::string_view work, double passed, double share);

/// A progress bar with the time left, on standard error if that is a terminal, else invisible.
class Progress {
public:
    Progress(bool quiet, std::string what, std::int64_t total);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void show(std::int64_t done);
    [[nodiscard]] bool is_visible() const { return visible_; }
    /// Real time since its start, s.
    [[nodiscard]] double passed() const;

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    std::string what_;
    std::int64_t total_;
    int shown_percent_ = -1;
    bool visible_;
};

}  // namespace oiler
