// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "support/program.hpp"

namespace oiler::test {

/// A row of a trace with two axes.
struct TraceRow {
    int tick = 0;
    int body = 0;
    double x = 0, y = 0, vx = 0, vy = 0;
};

/// The words of a command that plays a text.
inline std::string with_script(const Folder& folder, const std::string& text) {
    put(folder / "script.txt", text);
    return " --quiet --script '" + (folder / "script.txt").string() + "' ";
}

inline std::vector<TraceRow> trace_of(const std::string& command) {
    std::istringstream lines(shell(command + " --trace -").out);
    std::vector<TraceRow> rows;
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
        TraceRow row;
        double time = 0;
        for (char& letter : line)
            if (letter == ',') letter = ' ';
        std::istringstream(line) >> row.tick >> time >> row.body >> row.x >> row.y >> row.vx >>
            row.vy;
        rows.push_back(row);
    }
    return rows;
}

inline nlohmann::json report_of(const std::string& command) {
    return nlohmann::json::parse(shell(command + " --json -").out);
}

/// The pictures of a film at one frame per second.
inline std::vector<nlohmann::json> pictures_of(const std::string& command, int frames) {
    const Folder folder;
    const std::string out = (folder / "film").string();
    const Outcome run =
        shell(command + " --headless --fps 1 --size 16x9 --frames " + std::to_string(frames) +
              " --out '" + out + "' && gzip -dc '" + out + "/frames.jsonl.gz'");
    std::istringstream lines(run.out);
    std::vector<nlohmann::json> pictures;
    for (std::string line; std::getline(lines, line);)
        pictures.push_back(nlohmann::json::parse(line).at("picture"));
    return pictures;
}

/// The texts on each frame of a film at one frame per second, joined.
inline std::vector<std::string> texts_of(const std::string& command, int frames) {
    std::vector<std::string> texts;
    for (const nlohmann::json& picture : pictures_of(command, frames)) {
        std::string joined;
        for (const auto& label : picture.at("labels"))
            joined += label.at("text").get<std::string>() + "\n";
        texts.push_back(joined);
    }
    return texts;
}

}  // namespace oiler::test
