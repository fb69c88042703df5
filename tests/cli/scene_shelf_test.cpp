// SPDX-License-Identifier: MIT
// The scenes of a folder, as a window takes them.

#include <fstream>

#include "oiler/cli/scene_game.hpp"
#include "oiler/input/input.hpp"
#include "oiler/scene/read.hpp"
#include "support/folder.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

namespace fs = std::filesystem;

using cli::SceneGame;
using cli::SceneShelf;

class SceneShelfTest : public testing::Test {
protected:
    SceneShelfTest() {
        write("a.toml", "rate = 10");
        write("b.toml", "rate = 20\ntitle = \"The second\"");
        write("c.toml", "rate = 30");
        write("notes.txt", "");
    }
    /// A scene file that is a second younger each time.
    void write(const char* name, const std::string& keys) {
        std::ofstream(folder / name) << "[scene]\naxes = 1\n"
                                     << keys << "\n[[body]]\nposition = [1.0]\n";
        fs::last_write_time(folder / name, time += std::chrono::seconds(1));
    }
    SceneShelf shelf_of(const char* name) {
        return {folder / name, read_scene((folder / name).string())};
    }
    static std::unique_ptr<SceneGame> shown_by(const SceneShelf& shelf) {
        return std::make_unique<SceneGame>(shelf.scene(),
                                           Settings{.stepping = shelf.scene()->stepping}, true);
    }
    /// What the shelf hands out after so many presses of ].
    static std::optional<Shelf::Taken> take(SceneShelf& shelf, int presses) {
        struct Keys final : InputSource {
            InputQueue queue;
            Key key{};
            Input next(std::int64_t step) override {
                queue.set(key, step % 2 == 0);
                return queue.take({});
            }
        } keys;
        keys.key = presses < 0 ? Key::left_bracket : Key::right_bracket;
        const auto game = shown_by(shelf);
        (void)game->step(0, 2 * std::abs(presses), keys);
        return shelf.take(*game, std::nullopt);
    }

    Folder folder;
    fs::file_time_type time = fs::file_time_type::clock::now() - std::chrono::hours(1);
};

TEST_F(SceneShelfTest, BracketsGoThroughTheFolder) {
    SceneShelf shelf = shelf_of("a.toml");
    EXPECT_FALSE(take(shelf, 0));
    const auto second = take(shelf, 1);
    ASSERT_TRUE(second);
    EXPECT_EQ(second->title, "The second – b.toml");
    EXPECT_EQ(second->stepping.rate, Rate{20});
    EXPECT_EQ(shelf.scene()->stepping.rate, Rate{20});
    EXPECT_EQ(take(shelf, 1)->title, "c.toml");
    EXPECT_EQ(take(shelf, 1)->title, "a.toml") << "after the last comes the first";
    EXPECT_EQ(take(shelf, -1)->title, "c.toml");
    EXPECT_EQ(take(shelf, -2)->title, "a.toml");
    EXPECT_EQ(take(shelf, -5)->title, "The second – b.toml")
        << "five places back in a round of three";
}

TEST_F(SceneShelfTest, TakesADroppedFileWhereverItIs) {
    SceneShelf shelf = shelf_of("a.toml");
    const Folder other;
    std::ofstream(other / "far.toml")
        << "[scene]\naxes = 1\nrate = 77\n[[body]]\nposition = [1.0]\n";
    EXPECT_EQ(shelf.take(*shown_by(shelf), (other / "far.toml").string())->stepping.rate, Rate{77});
    EXPECT_EQ(take(shelf, 1)->title, "far.toml") << "its folder has no other";
}

TEST_F(SceneShelfTest, ReadsAChangedFileAgainAndKeepsThePlayersSetting) {
    SceneShelf shelf = shelf_of("a.toml");
    const Stepping of_player{.method = &find_method("rk4"), .rate = {500}};
    const auto game =
        std::make_unique<SceneGame>(shelf.scene(), Settings{.stepping = of_player}, true);
    write("a.toml", "rate = 10\nduration = 3.0");
    const auto taken = shelf.take(*game, std::nullopt);
    ASSERT_TRUE(taken);
    EXPECT_EQ(taken->stepping, of_player);
    EXPECT_EQ(shelf.scene()->duration, 3);
}

TEST_F(SceneShelfTest, AChangedRateIsTaken) {
    SceneShelf shelf = shelf_of("a.toml");
    write("a.toml", "rate = 40");
    EXPECT_EQ(shelf.take(*shown_by(shelf), std::nullopt)->stepping.rate, Rate{40});
}

TEST_F(SceneShelfTest, ABrokenFileIsNamedAndTheOldSceneStays) {
    SceneShelf shelf = shelf_of("a.toml");
    write("a.toml", "rate = \"fast\"");
    const auto old = shelf.scene();
    EXPECT_TRUE(
        holds(line_of_error(Exit::usage, [&] { (void)shelf.take(*shown_by(shelf), std::nullopt); }),
              "a.toml"));
    EXPECT_EQ(shelf.scene(), old);
    EXPECT_THROW((void)shelf.take(*shown_by(shelf), (folder / "none.toml").string()), Error);
    EXPECT_EQ(shelf.scene(), old);
}

TEST_F(SceneShelfTest, ABrokenNeighbourIsTriedOnceAndLeftBehind) {
    SceneShelf shelf = shelf_of("a.toml");
    write("b.toml", "rate = \"fast\"");
    EXPECT_THROW((void)take(shelf, 1), Error);
    EXPECT_FALSE(take(shelf, 1)) << "the same wish in the next frame";
    EXPECT_EQ(take(shelf, 2)->title, "c.toml") << "a second press";
    EXPECT_EQ(take(shelf, 1)->title, "a.toml");
}

TEST_F(SceneShelfTest, AFolderThatIsGoneLeavesTheScene) {
    SceneShelf shelf = shelf_of("a.toml");
    fs::remove_all(folder.path());
    EXPECT_THROW((void)take(shelf, 1), Error);
}

TEST_F(SceneShelfTest, ASceneOfAManifestHasNoFolder) {
    SceneShelf shelf({}, read_scene((folder / "a.toml").string()));
    EXPECT_FALSE(take(shelf, 1));
}

}  // namespace
}  // namespace oiler::test
