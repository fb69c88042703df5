// SPDX-License-Identifier: MIT
#include "oiler/compare/setting_changes.hpp"

#include <fmt/core.h>

#include <sstream>

namespace oiler {
namespace {

std::string or_own(const std::string& text) { return text.empty() ? "the method's own" : text; }

/// The text of a line of TOML. A # in quotes starts no comment: it may be of a colour.
std::string without_comment(const std::string& line) {
    char quote = 0;
    std::size_t end = 0;
    for (; end < line.size() && (quote != 0 || line[end] != '#'); ++end)
        if (quote == 0 && (line[end] == '"' || line[end] == '\''))
            quote = line[end];
        else if (line[end] == '\\' && quote == '"')
            ++end;
        else if (line[end] == quote)
            quote = 0;
    std::string text = line.substr(0, end);
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return text;
}

}  // namespace

std::vector<SettingChange> setting_changes(const Manifest& golden, const Manifest& actual) {
    const auto text = [](auto number) { return std::to_string(number); };
    const auto size = [](Size s) { return fmt::format("{}x{}", s.width, s.height); };
    std::vector<SettingChange> all{
        {"scene", golden.scene, actual.scene},
        {"size", size(golden.size), size(actual.size)},
        {"fps", text(golden.fps), text(actual.fps)},
        {"frames", text(golden.planned_frames), text(actual.planned_frames)},
        {"rate", text(golden.rate), text(actual.rate)},
        {"method", golden.method, actual.method},
        {"damping", or_own(golden.damping), or_own(actual.damping)},
        {"precision", golden.precision, actual.precision},
        {"seed", text(golden.seed), text(actual.seed)},
        {"version", golden.version, actual.version},
        {"compiler", golden.compiler, actual.compiler},
        {"surface", golden.provider, actual.provider}};
    std::erase_if(all, [](const SettingChange& change) { return change.golden == change.actual; });
    return all;
}

std::string scene_change(const std::string& golden, const std::string& actual) {
    std::istringstream before(golden);
    std::istringstream after(actual);
    for (int line = 1; before || after; ++line) {
        std::string a;
        std::string b;
        std::getline(before, a);
        std::getline(after, b);
        if (without_comment(a) != without_comment(b))
            return fmt::format("scene file changed, line {}: `{}` → `{}`", line, without_comment(a),
                               without_comment(b));
    }
    return {};
}

}  // namespace oiler
