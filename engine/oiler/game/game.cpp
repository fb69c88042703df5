// SPDX-License-Identifier: MIT
#include "oiler/game/game.hpp"

#include <chrono>
#include <exception>
#include <new>

#include "oiler/core/error.hpp"

namespace oiler {
namespace {

std::int64_t now_ns() {
    return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

void require_distinct_names(const std::vector<Reading>& readings) {
    for (std::size_t i = 0; i < readings.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (readings[i].name == readings[j].name)
                fail(Exit::usage, "two readings are named {}; rename one", readings[i].name);
}

Stopwatch::Stopwatch(StepTimes* sums, std::int64_t StepTimes::*which)
    : sum_(sums ? &(sums->*which) : nullptr) {
    if (sum_) begin_ = now_ns();
}

Stopwatch::~Stopwatch() {
    if (sum_) *sum_ += now_ns() - begin_;
}

void throw_error_of_game(const std::string& place, bool in_setup) {
    try {
        throw;
    } catch (const Error& error) {
        if (error.exit() != Exit::usage || in_setup) throw;
        fail(Exit::diverged, "{}: {}", place, error.what());
    } catch (const std::bad_alloc&) {
        fail(Exit::io, "{}: not enough memory; take fewer bodies or a shorter time", place);
    } catch (const std::exception& error) {
        fail(Exit::diverged, "{}: {}", place, error.what());
    } catch (...) {
        fail(Exit::diverged, "{}: it threw something that is no std::exception", place);
    }
}

void throw_other_rate(const std::string& place) {
    fail(Exit::diverged, "{}: the new world has another rate; make it with world.settings()",
         place);
}

}  // namespace oiler
