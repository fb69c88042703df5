// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/core.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <utility>

namespace oiler {

/// Where standard input, output or error is closed, puts nothing in its place: the first file
/// opened would take it, and remarks would land in a user's data.
void fill_closed_streams();

/// A line on standard error. One that nobody can read is no reason to stop.
void say(const std::string& line);

/// A line for whoever runs the program, unless it is to be quiet.
template <class... Args>
void remark(bool quiet, fmt::format_string<Args...> line, Args&&... args) {
    if (!quiet) say(fmt::format(line, std::forward<Args>(args)...));
}

/// How far long work has come and how long it will take: a bar on standard error where that is a
/// terminal, nothing elsewhere.
class Progress {
public:
    Progress(bool quiet, std::string what, std::int64_t total);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void show(std::int64_t done);

private:
    [[nodiscard]] std::string time_left(double share) const;

    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    std::string what_;
    std::int64_t total_;
    int shown_percent_ = -1;
    bool visible_;
};

}  // namespace oiler
