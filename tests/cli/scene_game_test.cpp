// SPDX-License-Identifier: MIT
// Scenes that are watched in a window: they repeat, and their bodies can be dragged. The scenes of
// a folder, as a window takes them.

#include <fstream>
#include <functional>

#include "oiler/cli/scene_game.hpp"
#include "oiler/input/input.hpp"
#include "oiler/scene/read.hpp"
#include "oiler/sim/bodies.hpp"
#include "support/folder.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

using cli::SceneGame;
using Watched = SceneGame::Watched;

/// A body without forces in a picture of 10 m, for half a second.
Scene scene_of(double mass = 1) {
    Scene scene = parse_scene(
        "[scene]\naxes = 2\nduration = 0.5\n[camera]\ncentre = [0.0, 0.0]\nheight = 10.0\n"
        "[[body]]\nname = \"ball\"\nposition = [0.0, 0.0]\nvelocity = [0.0, 0.0]\nmass = " +
            std::to_string(mass) + "\n",
        "ball.toml");
    return scene;
}

/// A player whose mouse does in each step what `plays` says.
struct Hand final : InputSource {
    std::function<void(InputQueue&, std::int64_t)> plays = [](InputQueue&, std::int64_t) {};
    InputQueue queue;
    int asked = 0;
    Input next(std::int64_t step) override {
        ++asked;
        plays(queue, step);
        return queue.take({.height = 10});
    }
    /// Where the camera shows a point of the world.
    static Point canvas(float x, float y) { return Camera{.height = 10}.to_canvas({x, y}); }
};

std::shared_ptr<const Scene> held(const Scene& scene) {
    return std::make_shared<const Scene>(scene);
}

Settings at(std::int64_t rate) {
    return {.stepping = {.method = &find_method("semi_implicit_euler"), .rate = {rate}}};
}

TEST(SceneGame, IsOverAfterItsDurationWhileItIsWatched) {
    const Scene scene = scene_of();
    Hand hand;
    SceneGame watched(held(scene), at(10), Watched::among_others);
    EXPECT_EQ(watched.step(0, 4, hand), 4);
    EXPECT_FALSE(watched.is_over());
    EXPECT_EQ(watched.step(4, 2, hand), 2);
    EXPECT_TRUE(watched.is_over());
    EXPECT_EQ(watched.world().tick(), 6) << "until the window makes it anew";
    hand.plays = [](InputQueue& queue, std::int64_t) { queue.restart(); };
    (void)watched.step(6, 1, hand);
    EXPECT_EQ(watched.world().tick(), 1);
    EXPECT_EQ(watched.cuts(), 1);
    EXPECT_FALSE(watched.is_over());
    EXPECT_EQ(hand.asked, 7);
    SceneGame run(held(scene), at(10), Watched::no);
    EXPECT_EQ(run.step(0, 100, hand), 100);
    EXPECT_EQ(run.world().tick(), 100);
    EXPECT_FALSE(run.is_over());
    EXPECT_EQ(hand.asked, 7);
    EXPECT_TRUE(run.picture().labels.size() < watched.picture().labels.size()) << "it says so";
}

/// Presses beside the ball at 0.3 m, and points at 2 m up from the next step on.
void drag(InputQueue& queue, std::int64_t step) {
    queue.point_at(step == 0 ? Hand::canvas(0.3F, 0) : Hand::canvas(0, 2));
    queue.set(Mouse::left, true);
}

// A critically damped spring of 10 Hz: y = 2 m·(1 - (1 + ωt)·e^(-ωt)). A force that is held over
// steps of 0.1 ms and semi-implicit Euler change it by some ω·dt = 0.6 % of the way.
TEST(SceneGame, BodiesFollowTheMouseOnASpring) {
    for (const double mass : {1.0, 50.0}) {
        Scene scene = scene_of(mass);
        scene.duration = 100;
        SceneGame game(held(scene), at(10'000), Watched::among_others);
        Hand hand;
        hand.plays = drag;
        (void)game.step(0, 1, hand);
        (void)game.step(1, 300, hand);
        const double omega = 2 * std::numbers::pi * 10;
        const double expected = 2 * (1 - (1 + omega * 0.03) * std::exp(-omega * 0.03));
        EXPECT_NEAR(game.world().bodies().position(0)[1], expected, 0.006 * 2);
        EXPECT_GT(game.picture().polylines.size(), 0U) << "a line to the mouse";
        hand.plays = [](InputQueue& queue, std::int64_t) { queue.set(Mouse::left, false); };
        (void)game.step(301, 2, hand);
        const Vec3 speed = game.world().bodies().velocity(0);
        (void)game.step(303, 50, hand);
        EXPECT_EQ(game.world().bodies().velocity(0), speed) << "let go";
        EXPECT_EQ(game.picture().polylines.size(), 0U);
    }
}

// 360 canvas units are 10 m.
TEST(SceneGame, AClickLeavesABodyAlone) {
    const Scene scene = scene_of();
    SceneGame game(held(scene), at(60), Watched::among_others);
    Hand hand;
    float aside = 0;
    hand.plays = [&](InputQueue& queue, std::int64_t) {
        Point at = Hand::canvas(0.3F, 0);
        at.x += aside;
        queue.point_at(at);
        queue.set(Mouse::left, true);
    };
    (void)game.step(0, 6, hand);
    aside = 2;
    (void)game.step(6, 6, hand);
    EXPECT_EQ(game.world().bodies().velocity(0), Vec3{});
    EXPECT_EQ(game.picture().polylines.size(), 0U);
    aside = 4;
    (void)game.step(12, 1, hand);
    EXPECT_GT(game.world().bodies().velocity(0)[0], 0) << "a drag";
    const double speed = game.world().bodies().velocity(0)[0];
    aside = 0;
    (void)game.step(13, 1, hand);
    EXPECT_NE(game.world().bodies().velocity(0)[0], speed) << "goes on where it began";
}

TEST(SceneGame, ADragIsStableAtAnyRate) {
    for (const std::int64_t rate : {1, 5, 20, 60}) {
        Scene scene = scene_of();
        scene.duration = 1e6;
        SceneGame game(held(scene), at(rate), Watched::among_others);
        Hand hand;
        hand.plays = drag;
        double furthest = 0;
        for (std::int64_t step = 0; step < 100; ++step) {
            (void)game.step(step, 1, hand);
            furthest = std::max(furthest, game.world().bodies().position(0)[1]);
        }
        EXPECT_LT(furthest, 2.1) << rate;
        EXPECT_NEAR(game.world().bodies().position(0)[1], 2, 0.01) << rate;
    }
}

TEST(SceneGame, InOneAxisABodyFollowsTheMouseAlongIt) {
    const Scene scene =
        parse_scene("[scene]\naxes = 1\nduration = 100.0\n[[body]]\nposition = [0.0]\n", "a.toml");
    SceneGame game(held(scene), at(60), Watched::among_others);
    Hand hand;
    hand.plays = [](InputQueue& queue, std::int64_t step) {
        queue.point_at(step == 0 ? Hand::canvas(0, 0) : Hand::canvas(1, 2));
        queue.set(Mouse::left, true);
    };
    (void)game.step(0, 120, hand);
    EXPECT_NEAR(game.world().bodies().position(0)[0], 1, 0.01);
}

TEST(SceneGame, AMouseThatIsFarAwayDragsNothing) {
    const Scene scene = scene_of();
    SceneGame game(held(scene), at(10), Watched::among_others);
    Hand hand;
    hand.plays = [](InputQueue& queue, std::int64_t) {
        queue.point_at(Hand::canvas(0.7F, 0));
        queue.set(Mouse::left, true);
    };
    (void)game.step(0, 4, hand);
    EXPECT_EQ(game.world().bodies().velocity(0), Vec3{});
}

TEST(SceneGame, TheMouseZoomsAndMovesThePicture) {
    Scene scene = scene_of();
    scene.duration = 100;
    const auto shared = held(scene);
    SceneGame game(shared, at(60), Watched::among_others);
    Hand hand;
    hand.plays = [](InputQueue& queue, std::int64_t step) {
        queue.point_at(Hand::canvas(2, 1));
        if (step == 0) queue.turn_wheel(2);
    };
    (void)game.step(0, 2, hand);
    const Camera zoomed = game.picture().camera;
    EXPECT_FLOAT_EQ(zoomed.height, 10 * 0.81F);
    EXPECT_NEAR(zoomed.to_canvas({2, 1}).x, Hand::canvas(2, 1).x, 1e-3);
    EXPECT_NEAR(zoomed.to_canvas({2, 1}).y, Hand::canvas(2, 1).y, 1e-3);
    hand.plays = [](InputQueue& queue, std::int64_t step) {
        queue.point_at(step == 2 ? Hand::canvas(2, 1) : Hand::canvas(-1, 3));
        queue.set(Mouse::right, step < 4);
    };
    (void)game.step(2, 3, hand);
    const Camera moved = game.picture().camera;
    EXPECT_NEAR(moved.to_canvas({2, 1}).x, Hand::canvas(-1, 3).x, 1e-3) << "held";
    EXPECT_NEAR(moved.to_canvas({2, 1}).y, Hand::canvas(-1, 3).y, 1e-3);
    hand.plays = [](InputQueue& queue, std::int64_t) { queue.point_at(Hand::canvas(0, 0)); };
    (void)game.step(5, 2, hand);
    EXPECT_EQ(game.picture().camera, moved) << "let go";
    hand.plays = [](InputQueue& queue, std::int64_t) { queue.set(Key::r, true); };
    EXPECT_FALSE(game.is_over());
    (void)game.step(7, 1, hand);
    EXPECT_TRUE(game.is_over()) << "R restarts";
    game.restart();
    EXPECT_FALSE(game.is_over());
    EXPECT_EQ(game.picture().camera, moved);
    game.assign(SceneGame(shared, at(30), Watched::among_others));
    EXPECT_EQ(game.picture().camera, moved) << "with another setting, too";
}

TEST(SceneGame, BracketsAskForOtherScenesOnce) {
    const Scene scene = scene_of();
    SceneGame game(held(scene), at(10), Watched::among_others);
    Hand hand;
    hand.plays = [](InputQueue& queue, std::int64_t step) {
        queue.set(Key::right_bracket, step == 0 || step == 2);
    };
    (void)game.step(0, 3, hand);
    EXPECT_EQ(game.places_to_go(), 2);
    hand.plays = [](InputQueue& queue, std::int64_t) { queue.set(Key::left_bracket, true); };
    (void)game.step(3, 2, hand);
    EXPECT_EQ(game.places_to_go(), 1);
    Scene other = scene;
    other.camera.height = 20;
    game.assign(SceneGame(held(other), at(10), Watched::among_others));
    EXPECT_EQ(game.places_to_go(), 0);
    EXPECT_EQ(game.picture().camera.height, 20) << "another scene has its own camera";
}

TEST(SceneGame, ACopyDragsOn) {
    Scene scene = scene_of();
    scene.duration = 100;
    SceneGame game(held(scene), at(100), Watched::among_others);
    Hand hand;
    hand.plays = drag;
    (void)game.step(0, 10, hand);
    const std::unique_ptr<AnyGame> copy = game.clone();
    SceneGame assigned(held(scene), at(100), Watched::among_others);
    assigned.assign(game);
    Hand other;
    other.queue = hand.queue;
    other.plays = hand.plays;
    Hand third;
    third.queue = hand.queue;
    third.plays = hand.plays;
    (void)game.step(10, 20, hand);
    (void)copy->step(10, 20, other);
    (void)assigned.step(10, 20, third);
    EXPECT_EQ(copy->state_hash(), game.state_hash());
    EXPECT_EQ(assigned.state_hash(), game.state_hash());
}

std::vector<Point> path_of(const AnyGame& game) {
    std::vector<Point> points;
    for (const Polyline& line : game.picture().polylines)
        points.insert(points.end(), line.points.begin(), line.points.end());
    return points;
}

// At 1,000 Hz, a path of 2 s has a sample in every eighth step.
TEST(SceneGame, TrailsDoNotChangeTheMotion) {
    const auto hash_after_50 = [](const std::string& view) {
        const Scene scene = parse_scene(
            "[scene]\naxes = 2\nduration = 100.0\n[[body]]\nvelocity = [2.0, 0.0]\n" + view,
            "view.toml");
        Hand hand;
        SceneGame run(held(scene), at(1000), Watched::no);
        (void)run.step(0, 50, hand);
        EXPECT_EQ(run.world().tick(), 50);
        return run.state_hash();
    };
    EXPECT_EQ(hash_after_50("[view]\ntrails = 2.0\nfastest = 2.0\n"), hash_after_50(""));
}

// A ball of 2 m/s is at 4 m after 2 s; the path of the last second begins at 2 m.
TEST(SceneGame, DrawsTrailsHoweverItIsStepped) {
    const Scene scene = parse_scene(
        "[scene]\naxes = 2\nduration = 100.0\n[[body]]\nvelocity = [2.0, 0.0]\n"
        "[view]\ntrails = 1.0\n",
        "trails.toml");
    Hand hand;
    SceneGame run(held(scene), at(10), Watched::no);
    SceneGame watched(held(scene), at(10), Watched::among_others);
    (void)run.step(0, 20, hand);
    (void)watched.step(0, 20, hand);
    ASSERT_FALSE(path_of(run).empty());
    EXPECT_EQ(path_of(run), path_of(watched));
    const auto [left, right] = std::ranges::minmax(path_of(run), {}, &Point::x);
    EXPECT_NEAR(left.x, 2, 1e-6);
    EXPECT_NEAR(right.x, 4, 1e-6);
    const std::unique_ptr<AnyGame> copy = run.clone();
    (void)run.step(20, 5, hand);
    (void)copy->step(20, 5, hand);
    EXPECT_EQ(path_of(*copy), path_of(run)) << "a window goes back to a copy";
    run.restart();
    for (const Point& point : path_of(run)) EXPECT_EQ(point, Point{});
}

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
        return std::make_unique<SceneGame>(
            shelf.scene(), Settings{.stepping = shelf.scene()->stepping}, Watched::among_others);
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

TEST_F(SceneShelfTest, TheBracketsAreNamedWhereThereAreOtherScenes) {
    EXPECT_TRUE(shelf_of("a.toml").has_neighbours());
    for (const char* other : {"b.toml", "c.toml"}) fs::remove(folder / other);
    EXPECT_FALSE(shelf_of("a.toml").has_neighbours());
    EXPECT_FALSE(SceneShelf("", scene_of()).has_neighbours()) << "a scene of a manifest";
    const auto hint = [&](Watched watched) {
        return SceneGame(held(scene_of()), at(10), watched).picture().labels.back().text;
    };
    EXPECT_EQ(hint(Watched::alone), "repeats after 0.5 s; drag bodies, R restarts");
    EXPECT_EQ(hint(Watched::among_others), hint(Watched::alone) + ", [ ] change the scene");
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
    const auto game = std::make_unique<SceneGame>(shelf.scene(), Settings{.stepping = of_player},
                                                  Watched::among_others);
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
