// SPDX-License-Identifier: MIT
#include "oiler/core/profile.hpp"

#include <functional>
#include <map>
#include <thread>

#include "oiler/core/json.hpp"

namespace oiler {
namespace {

double microseconds(Profile::Clock::duration time) {
    return std::chrono::duration<double, std::micro>(time).count();
}

}  // namespace

void Profile::add(const char* stage, Clock::time_point begin, Clock::time_point end) {
    const std::size_t thread = std::hash<std::thread::id>{}(std::this_thread::get_id());
    const std::lock_guard lock(mutex_);
    events_.push_back({stage, thread, begin, end});
}

void Profile::count(const char* counter, double value) {
    const std::lock_guard lock(mutex_);
    counts_.push_back({counter, value, Clock::now()});
}

std::string Profile::to_json() const {
    const std::lock_guard lock(mutex_);
    std::map<std::size_t, std::size_t> numbers;  // of threads, from 1
    Json events = Json::array();
    for (const Event& event : events_)
        events.push_back(
            {{"name", event.stage},
             {"ph", "X"},
             {"pid", 1},
             {"tid", numbers.try_emplace(event.thread, numbers.size() + 1).first->second},
             {"ts", microseconds(event.begin - start_)},
             {"dur", microseconds(event.end - event.begin)}});
    for (const Count& count : counts_)
        events.push_back({{"name", count.counter},
                          {"ph", "C"},
                          {"pid", 1},
                          {"ts", microseconds(count.at - start_)},
                          {"args", {{count.counter, count.value}}}});
    const Json json{{"displayTimeUnit", "ms"}, {"traceEvents", events}};
    return json.dump(-1) + "\n";
}

}  // namespace oiler
