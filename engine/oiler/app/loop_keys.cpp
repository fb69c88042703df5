// SPDX-License-Identifier: MIT
#include "oiler/app/loop_keys.hpp"

#include <fmt/core.h>

#include <array>
#include <utility>

namespace oiler {

std::span<const LoopKey> loop_keys() {
    static constexpr std::array keys{
        LoopKey{Key::f1, "inspector", "inspector",
                [](const KeyUse& use) { use.panels.inspector ^= use.toggles(); }},
        LoopKey{Key::f2, "help", "close this help",
                [](const KeyUse& use) { use.panels.help ^= use.toggles(); }},
        LoopKey{Key::f3, "pause", "pause, resume",
                [](const KeyUse& use) { use.requests.pauses |= use.toggles(); }},
        LoopKey{Key::f4, "back", "go back",
                [](const KeyUse& use) {
                    use.requests.goes_back |= use.pressed();
                    use.requests.rewinds |= use.held;
                }},
        LoopKey{Key::f5, "step", "step in a pause",
                [](const KeyUse& use) { use.requests.steps |= use.pressed(); }},
        LoopKey{Key::f6, "errors ×10", "errors ×10",
                [](const KeyUse& use) { use.panels.large_errors ^= use.toggles(); }},
        LoopKey{Key::f7, "slower", "slower",
                [](const KeyUse& use) { use.requests.slower += use.presses; }},
        LoopKey{Key::f8, "faster", "faster",
                [](const KeyUse& use) { use.requests.faster += use.presses; }},
        LoopKey{Key::f9, "restart", "restart",
                [](const KeyUse& use) { use.requests.restarts |= use.pressed(); }},
        LoopKey{Key::f11, "full screen", "full screen",
                [](const KeyUse& use) { use.panels.full_screen ^= use.toggles(); }},
        LoopKey{Key::escape, "quit", "close this, then quit",
                [](const KeyUse& use) {
                    use.requests.quits |= use.pressed() && !std::exchange(use.panels.help, false);
                }},
    };
    return keys;
}

void add_requests(Requests& requests, Panels& panels, const Input& keys) {
    for (const LoopKey& one : loop_keys())
        one.act({requests, panels, keys.presses(one.key), keys.held(one.key)});
}

std::vector<HelpRow> help_on_loop_keys(bool escape_quits) {
    std::vector<HelpRow> rows;
    for (const LoopKey& one : loop_keys())
        rows.push_back({name_of(one.key), std::string(one.text)});
    if (!escape_quits) rows.back().text = "close this help";
    return rows;
}

std::string list_of_loop_keys(std::size_t count) {
    std::string list;
    for (const LoopKey& one : loop_keys().first(count))
        list += fmt::format("{}{} {}", list.empty() ? "" : ", ", name_of(one.key), one.name);
    return list;
}

}  // namespace oiler
