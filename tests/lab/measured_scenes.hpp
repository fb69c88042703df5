// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "oiler/lab/reference/reference.hpp"
#include "oiler/scene/read.hpp"

namespace oiler::test {

using namespace lab;

inline const std::string one_axis = "[scene]\naxes = 1\nrate = 100\n";

/// The article's spring and damper over 10 s.
inline const std::string article_spring =
    one_axis +
    "duration = 10.0\n[[body]]\nname = \"mass\"\nposition = [1000.0]\n[[spring]]\n"
    "body = \"mass\"\nanchor = [0.0]\nstiffness = 15.0\ndamping = 0.1\n";

inline std::vector<const Method*> methods_of(const std::vector<const char*>& names) {
    std::vector<const Method*> all;
    for (const char* name : names) all.push_back(&find_method(name));
    return all;
}

/// A scene and its reference.
struct MeasuredScene {
    explicit MeasuredScene(const std::string& scene_text, const ReferenceEffort& effort = {})
        : text(scene_text),
          scene(parse_scene(text, "test.toml")),
          reference(make_reference(scene, effort)) {}

    std::string text;
    Scene scene;
    Reference reference;
};

/// The article's spring, measured once.
inline const MeasuredScene& spring() {
    static const MeasuredScene measured(article_spring);
    return measured;
}

}  // namespace oiler::test
