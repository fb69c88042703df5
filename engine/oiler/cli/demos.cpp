// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <iterator>

#include "oiler/cli/arguments.hpp"
#include "oiler/cli/demo_menu.hpp"
#include "oiler/cli/output.hpp"
#include "oiler/cli/startable.hpp"
#include "oiler/process/interrupt.hpp"

namespace oiler::cli {
namespace {

std::string list_text(const std::vector<Startable>& all) {
    std::size_t width = 0;
    for (const Startable& one : all) width = std::max(width, one.name.size());
    std::string text;
    const auto add = [&](std::string_view heading, bool scenes) {
        text += heading;
        for (const Startable& one : all)
            if (one.is_scene == scenes)
                fmt::format_to(std::back_inserter(text), "  {:<{}}  {}\n", one.name, width,
                               one.sentence);
    };
    add("Games:\n", false);
    add("Scenes:\n", true);
    return text +
           "`oiler demos NAME` starts one. Further words are its options: see "
           "`oiler demos NAME --help`.\n`oiler demos --window` chooses in a window.\n";
}

/// Offers all in a window, again after each that was started, until the user leaves.
Exit offer(const std::vector<Startable>& all) {
    const auto pictures = load_pictures(all);
    std::size_t selected = 0;
    std::string remark;
    while (const auto chosen = choose_in_window(all, pictures, selected, remark)) {
        selected = *chosen;
        const int exit = run_and_wait(all[selected]);
        if (Interrupt::requested()) return Exit::interrupted;
        remark =
            exit == 0 ? "" : fmt::format("{} ended with exit code {}", all[selected].name, exit);
    }
    return Exit::done;
}

}  // namespace

struct DemosCommand {
    static constexpr CommandTexts texts{
        .name = "demos",
        .summary = "List games and scenes, or start one",
        .example = "jump --rate 144",
        .notes = "The first word is the name of a game or a scene, further words are its options.",
        .may_take_long = false};

    bool in_window = false;
    std::vector<std::string> words;

    void declare(Arguments& arguments) {
        arguments.add_flag("--window", in_window, "choose in a window");
        arguments.add_rest(words);
    }

    [[nodiscard]] Exit run() const {
        const std::vector<Startable> all = own_startables();
        if (!words.empty())
            become(find_startable(all, words.front()), {words.begin() + 1, words.end()});
        if (in_window) return offer(all);
        print(list_text(all));
        return Exit::done;
    }
};

template Command make_command<DemosCommand>();

}  // namespace oiler::cli
