// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/program.hpp"

namespace oiler::test {

using Json = nlohmann::json;

/// Ten seconds of the article's spring, with comments and a budget.
inline std::string spring_scene(const std::string& budget) {
    return "# A remark at the top.\n[scene]\ntitle = \"A <spring> & \\\"damper\\\"\"\naxes = 1\n"
           "rate   = 100      # how often\n"
           "method = \"semi_implicit_euler\"  # how\n"
           "duration = 10.0\n\n"
           "[[body]]          # only one\nname = \"mass\"\nposition = [1000.0]\n\n"
           "[[spring]]\nbody = \"mass\"\nanchor = [0.0]\nstiffness = 15.0\ndamping = 0.1\n"
           "# The end.\n" +
           budget;
}

/// A folder with scene.toml, in which commands are run.
class Desk {
public:
    explicit Desk(const std::string& scene = spring_scene("")) { put("scene.toml", scene); }

    void put(const std::string& name, const std::string& text) const {
        test::put(folder_ / name, text);
    }
    [[nodiscard]] Outcome run(const std::string& line) const {
        return shell("cd '" + folder_.path().string() + "'; " + line);
    }
    /// The same; the command must end with this exit code.
    Outcome run(const std::string& line, int exit) const {
        return shell("cd '" + folder_.path().string() + "'; " + line, exit);
    }
    [[nodiscard]] std::string text(const std::string& name) const {
        return text_of(folder_.path() / name);
    }
    [[nodiscard]] Json json(const std::string& name) const { return Json::parse(text(name)); }
    [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }
    [[nodiscard]] std::vector<std::string> names(const std::string& name = ".") const {
        return names_in(folder_.path() / name);
    }

private:
    Folder folder_;
};

}  // namespace oiler::test
