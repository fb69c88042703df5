// SPDX-License-Identifier: MIT
#include "oiler/cli/shared_options.hpp"

#include <algorithm>
#include <charconv>
#include <sstream>
#include <variant>

#include "oiler/process/parse_size.hpp"
#include "oiler/scene/read.hpp"

namespace oiler::cli {
namespace {

bool is_in_group(const Method& method, const std::string& group) {
    const bool splits = std::holds_alternative<Splitting>(method.rule);
    if (group == "splitting") return splits;
    if (group == "explicit") return splits || std::holds_alternative<Tableau>(method.rule);
    return group == "all";
}

}  // namespace

void add_json(Arguments& arguments, std::filesystem::path& target, const FileKind& kind) {
    arguments.add_output("--json", target, "write the result as JSON, - for stdout", kind);
}

void add_quiet(Arguments& arguments, bool& target) {
    arguments.add_flag("--quiet", target, "no remarks and no progress on standard error");
}

void add_method_list(Arguments& arguments, std::string& target) {
    arguments.add_option("--methods", target, "LIST",
                         "splitting, explicit, all and method names, with commas");
}

std::vector<const Method*> parse_methods(const std::string& words) {
    std::vector<const Method*> chosen;
    const auto add = [&](const Method& method) {
        if (std::ranges::find(chosen, &method) == chosen.end()) chosen.push_back(&method);
    };
    std::istringstream stream(words);
    for (std::string word; std::getline(stream, word, ',');) {
        bool is_group = false;
        for (const Method& method : methods()) {
            if (!is_in_group(method, word)) continue;
            is_group = true;
            add(method);
        }
        if (!is_group) add(find_method(word));
    }
    if (chosen.empty())
        fail(Exit::usage,
             "--methods: give splitting, explicit, all, and method names, with commas");
    return chosen;
}

std::vector<std::int64_t> usual_rates() { return {20, 30, 50, 60, 100, 120, 144, 240}; }

int parse_integer(const std::string& words) {
    int number = 0;
    const char* const end = words.data() + words.size();
    const auto [last, error] = std::from_chars(words.data(), end, number);
    return error == std::errc() && last == end ? number : 0;
}

void PictureOptions::declare(Arguments& arguments, bool (*writes)(std::string_view name)) {
    arguments.add_output_folder("--out", out, writes, "output folder");
    arguments.add_option("--size", size_words, "WxH",
                         "size of the pictures in pixels; their content is 16:9");
}

Size PictureOptions::size() const { return parse_size(size_words); }

void MethodOptions::declare(Arguments& arguments) {
    arguments.add_words("METHOD", names, "names of methods, all if none is given");
    arguments.add_damping(damping);
}

std::vector<const Method*> MethodOptions::methods() const {
    std::vector<const Method*> chosen;
    for (const std::string& name : names) chosen.push_back(&find_method(name));
    if (chosen.empty())
        for (const Method& method : oiler::methods()) chosen.push_back(&method);
    return chosen;
}

Damping MethodOptions::damping_of(const Method& method) const {
    return find_damping(damping).value_or(method.damping);
}

void SceneOptions::declare(Arguments& arguments, const FileKind& kind_of_json) {
    arguments.add_required("SCENE", file, "scene file");
    arguments.add_positive("--duration", duration, "S",
                           "simulated seconds to measure, the scene's duration if not given");
    add_json(arguments, json, kind_of_json);
    add_quiet(arguments, quiet);
}

Scene SceneOptions::read() const {
    Scene scene = read_scene(file.string());
    scene.duration = duration.value_or(scene.duration);
    return scene;
}

void ToleranceOptions::declare(Arguments& arguments) {
    arguments.add_positive("--position-error", position_error, "M",
                           "tolerance: largest distance of a body from the reference");
    arguments.add_positive("--energy-drift", energy_drift, "X",
                           "tolerance: largest relative drift of the energy");
}

}  // namespace oiler::cli
