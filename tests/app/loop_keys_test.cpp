// SPDX-License-Identifier: MIT
// The keys of the loop: their pages and texts name all of them, and each asks for one thing.
#include "oiler/app/loop_keys.hpp"

#include "oiler/input/input.hpp"
#include "support/folder.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

/// What pressing a key once asks for; with `held`, it stays down.
struct Asked {
    explicit Asked(Key key, bool held = true, int presses = 1) {
        InputQueue queue;
        for (int i = 0; i < presses; ++i) {
            queue.set(key, true);
            if (!held || i + 1 < presses) queue.set(key, false);
        }
        add_requests(requests, panels, queue.take({}));
    }
    Requests requests;
    Panels panels;
};

TEST(LoopKeys, EachAsksForOneThing) {
    EXPECT_TRUE(Asked(Key::f1).panels.inspector);
    EXPECT_TRUE(Asked(Key::f2).panels.help);
    EXPECT_TRUE(Asked(Key::f3).requests.pauses);
    EXPECT_TRUE(Asked(Key::f4).requests.goes_back && Asked(Key::f4).requests.rewinds);
    EXPECT_TRUE(Asked(Key::f5).requests.steps);
    EXPECT_TRUE(Asked(Key::f6).panels.large_errors);
    EXPECT_EQ(Asked(Key::f7).requests.slower, 1);
    EXPECT_EQ(Asked(Key::f8).requests.faster, 1);
    EXPECT_TRUE(Asked(Key::f9).requests.restarts);
    EXPECT_TRUE(Asked(Key::f11).panels.full_screen);
    EXPECT_TRUE(Asked(Key::escape).requests.quits);
    EXPECT_FALSE(Asked(Key::f10).requests.quits || Asked(Key::f3).requests.steps);
}

TEST(LoopKeys, TwoPressesInAFrameSwitchOnAndOff) {
    EXPECT_FALSE(Asked(Key::f1, false, 2).panels.inspector);
    EXPECT_FALSE(Asked(Key::f3, false, 2).requests.pauses);
    EXPECT_EQ(Asked(Key::f7, false, 2).requests.slower, 2);
    EXPECT_TRUE(Asked(Key::f4, false).requests.rewinds) << "a tap is held for a frame";
}

TEST(LoopKeys, ListsAndHelpNameAll) {
    EXPECT_EQ(list_of_loop_keys(4), "F1 inspector, F2 help, F3 pause, F4 back");
    EXPECT_EQ(list_of_loop_keys(loop_keys().size()),
              "F1 inspector, F2 help, F3 pause, F4 back, F5 step, F6 errors ×10, F7 slower, "
              "F8 faster, F9 restart, F11 full screen, Escape quit");
    EXPECT_EQ(help_on_loop_keys(true).size(), loop_keys().size());
    EXPECT_EQ(help_on_loop_keys(true).back().name, "Escape");
    EXPECT_EQ(help_on_loop_keys(true).back().text, "close this, then quit");
    EXPECT_EQ(help_on_loop_keys(false).back().text, "close this help") << "the game uses Escape";
}

TEST(LoopKeys, EscapeClosesTheHelpBeforeItQuits) {
    Requests requests;
    Panels panels{.help = true};
    InputQueue queue;
    queue.set(Key::w, true);
    add_requests(requests, panels, queue.take({}));
    EXPECT_TRUE(panels.help) << "another key";
    queue.set(Key::escape, true);
    add_requests(requests, panels, queue.take({}));
    EXPECT_FALSE(panels.help);
    EXPECT_FALSE(requests.quits);
    add_requests(requests, panels, queue.take({}));
    EXPECT_FALSE(requests.quits) << "it is held";
}

/// The first two cells of the rows below "## Keys".
std::vector<HelpRow> rows_of_page(const std::string& page) {
    std::istringstream lines(page.substr(page.find("\n## Keys\n")));
    std::vector<HelpRow> rows;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("|--")) continue;
        if (!line.starts_with("| ")) {
            if (!rows.empty()) break;
            continue;
        }
        const std::size_t end = line.find(" | ");
        rows.push_back({line.substr(2, end - 2), line.substr(end + 3)});
    }
    return {rows.begin() + 1, rows.end()};
}

TEST(LoopKeys, ThePageOfDemosNamesAllInTheirOrder) {
    std::string keys;
    for (const HelpRow& row : rows_of_page(text_of(OILER_SOURCE "/demos/README.md"))) {
        keys += row.name + ", ";
        for (const LoopKey& key : loop_keys()) {
            if ((", " + row.name + ",").find(" " + name_of(key.key) + ",") == std::string::npos)
                continue;
            EXPECT_NE(row.text.find(key.name), std::string::npos) << row.name << ": " << row.text;
        }
    }
    std::string of_table;
    for (const LoopKey& key : loop_keys()) of_table += name_of(key.key) + ", ";
    EXPECT_EQ(keys, of_table);
}

// "F3 pauses, F5 steps once": the verb of a sentence begins with the name of its key.
TEST(LoopKeys, TheReadmeCallsThemByTheirNames) {
    const std::string page = text_of(OILER_SOURCE "/README.md");
    for (const Key key : {Key::f3, Key::f5, Key::f9}) {
        const LoopKey& one = *std::ranges::find(loop_keys(), key, &LoopKey::key);
        EXPECT_TRUE(page.find(name_of(key) + " " + std::string(one.name)) != std::string::npos ||
                    page.find(name_of(key) + "\n" + std::string(one.name)) != std::string::npos)
            << name_of(key);
    }
}

}  // namespace
}  // namespace oiler::test
