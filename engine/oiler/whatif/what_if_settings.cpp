// SPDX-License-Identifier: MIT
#include "oiler/whatif/what_if_settings.hpp"

#include <algorithm>
#include <charconv>
#include <sstream>

#include "oiler/core/error.hpp"
#include "oiler/core/step_clock.hpp"

namespace oiler {
namespace {

std::vector<std::string> split(const std::string& words, char separator) {
    std::vector<std::string> parts;
    // getline returns an empty last word only before a separator.
    std::istringstream stream(words + separator);
    for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
    return parts;
}

/// What the words of one setting have named so far.
struct Named {
    bool rate = false;
    bool method = false;
    bool precision = false;
    bool damping = false;
};

void require_first(bool& named, const std::string& word) {
    if (named) fail(Exit::usage, "'{}' is the second of its kind", word);
    named = true;
}

void apply_word(const std::string& word, Stepping& stepping, Named& named) {
    const char* const end = word.data() + word.size();
    if (word.empty()) fail(Exit::usage, "a word is empty");
    std::int64_t rate = 0;
    const auto [last, error] = std::from_chars(word.data(), end, rate);
    if (error == std::errc() && last == end) {
        require_first(named.rate, word);
        if (rate < 1 || rate > StepClock::largest_rate)
            fail(Exit::usage, "a rate is from 1 to {} Hz", StepClock::largest_rate);
        stepping.rate = {rate};
    } else if (word == "float" || word == "double") {
        require_first(named.precision, word);
        stepping.precision = word == "float" ? Precision::single : Precision::double_;
    } else if (word == "kick" || word == "drift") {
        require_first(named.damping, word);
        stepping.damping = word == "kick" ? Damping::in_kick : Damping::in_drift;
    } else {
        require_first(named.method, word);
        stepping.method = &find_method(word);
    }
}

Stepping parse_setting(const std::string& setting, const Stepping& recorded) {
    Stepping stepping = recorded;
    Named named;
    try {
        for (const std::string& word : split(setting, '@')) apply_word(word, stepping, named);
    } catch (const Error& error) {
        fail(Exit::usage,
             "--what-if {}: {}; give settings such as 30,rk4,velocity_verlet@120,float", setting,
             error.what());
    }
    return stepping;
}

bool is_applicable(const Settings& settings, const MakeGame& make) {
    try {
        make(settings)->world().require_applicable();
        return true;
    } catch (const Error& error) {
        if (error.exit() != Exit::usage) throw;
        return false;
    }
}

}  // namespace

std::vector<Stepping> parse_what_if(const std::string& words, const Stepping& recorded) {
    std::vector<Stepping> steppings;
    for (const std::string& setting : split(words, ',')) {
        steppings.push_back(parse_setting(setting, recorded));
        if (std::ranges::count(steppings, steppings.back()) > 1)
            fail(Exit::usage, "--what-if {}: it comes twice; name it once", setting);
    }
    return steppings;
}

std::vector<Stepping> usual_what_if(const Settings& recorded, const MakeGame& make) {
    const Stepping& now = recorded.stepping;
    std::vector<Stepping> steppings;
    const auto add = [&](auto change) {
        Settings settings = recorded;
        change(settings.stepping);
        if (is_applicable(settings, make)) steppings.push_back(settings.stepping);
    };
    if (now.rate.steps % 2 == 0) add([](Stepping& s) { s.rate.steps /= 2; });
    add([](Stepping& s) { s.rate.steps *= 2; });
    for (const char* name : {"semi_implicit_euler", "velocity_verlet", "rk4"})
        if (now.method->name != name) add([&](Stepping& s) { s.method = &find_method(name); });
    add([](Stepping& s) {
        s.precision = s.precision == Precision::single ? Precision::double_ : Precision::single;
    });
    return steppings;
}

std::string describe(const Stepping& stepping) {
    return fmt::format("{}, {} Hz, {}{}{}", stepping.method->name, stepping.rate.steps,
                       name_of(stepping.precision), stepping.damping ? ", " : "",
                       stepping.damping ? name_of(*stepping.damping) : "");
}

}  // namespace oiler
