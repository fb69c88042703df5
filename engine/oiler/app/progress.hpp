// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>

namespace oiler {

/// A line on standard error for whoever runs the program, unless it is to be quiet.
template <class... Args>
void remark(bool quiet, fmt::format_string<Args...> line, Args&&... args) {
    if (!quiet) fmt::print(stderr, "{}\n", fmt::format(line, std::forward<Args>(args)...));
}

/// How far long work has come: a bar on standard error where that is a terminal, nothing elsewhere.
class Progress {
public:
    Progress(bool quiet, std::string what, std::int64_t total);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void show(std::int64_t done);

private:
    std::string what_;
    std::int64_t total_;
    int shown_percent_ = -1;
    bool visible_;
};

}  // namespace oiler
