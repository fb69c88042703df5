// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "lab/advice/made_up_clock.hpp"
#include "lab/measured_scenes.hpp"
#include "oiler/lab/advice/advise.hpp"

namespace oiler::test {

inline std::vector<const Method*> all_methods() {
    std::vector<const Method*> all;
    for (const Method& method : methods()) all.push_back(&method);
    return all;
}

inline std::vector<const Method*> splittings() {
    std::vector<const Method*> all;
    for (const Method& method : methods())
        if (std::holds_alternative<Splitting>(method.rule)) all.push_back(&method);
    return all;
}

/// The scene, with a reference accurate enough for the requirements.
inline MeasuredScene measured_for(const std::string& text, const Requirements& requirements) {
    return MeasuredScene(text, {.wanted = required_reference_error(requirements) / 2});
}

/// The advice by a clock that counts evaluations.
inline Advice advice_on(const std::string& text, const Requirements& requirements) {
    const MeasuredScene measured = measured_for(text, requirements);
    return advise(measured.scene, measured.reference, requirements, clock_by_evaluations());
}

}  // namespace oiler::test
