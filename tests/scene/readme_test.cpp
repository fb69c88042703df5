// SPDX-License-Identifier: MIT
// Compares the README of the scenes with the reader, and the scenes of the repository with
// independent references and conservation laws.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>

#include "oiler/scene/keys.hpp"
#include "oiler/scene/make_world.hpp"
#include "oiler/scene/read.hpp"
#include "support/folder.hpp"
#include "support/oscillator.hpp"
#include "support/reference.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

std::string range_text(const ValueRange& range) {
    if (range.high < 1e300)
        return fmt::format(" {}{:.16g} to {:.16g}", range.without_low ? "above " : "", range.low,
                           range.high);
    if (range.low < -1e300) return "";
    return fmt::format(" {} {:g}", range.without_low ? ">" : "≥", range.low);
}

std::string type_text(const SceneKey& key) {
    switch (key.kind) {
        case KeyKind::text:
            return "text";
        case KeyKind::whole:
            return "whole number" + range_text(key.range);
        case KeyKind::number:
            return "number" + range_text(key.range);
        case KeyKind::flag:
            return "true or false";
        case KeyKind::vector:
            return "vector";
        case KeyKind::points:
            return "list of vectors";
        case KeyKind::lines:
            return "list of texts";
        case KeyKind::counts:
            return "one or two whole numbers" + range_text(key.range);
        case KeyKind::colour:
            return "colour";
        case KeyKind::word:
            break;
    }
    return key.name == "method" ? "method" : fmt::format("{}", fmt::join(key.words(), ", "));
}

std::string default_text(const SceneKey& key) {
    if (!key.absent.empty()) return std::string(key.absent);
    return key.kind == KeyKind::vector ? "zeros" : fmt::format("`{}`", key.value);
}

std::string row(const SceneKey& key) {
    const std::string table = scene_table(key.table).is_repeated()
                                  ? fmt::format("[[{}]]", key.table)
                                  : fmt::format("[{}]", key.table);
    const std::string unit = key.unit.empty() ? "" : fmt::format(", {}", key.unit);
    return std::regex_replace(
        fmt::format("| `{}` | `{}` | {}{} | {} | {} |", table, key.name, type_text(key), unit,
                    default_text(key),
                    std::regex_replace(std::string(key.what), std::regex(R"(\|)"), R"(\|)")),
        std::regex("  +"), " ");
}

const std::string root = OILER_SOURCE;
const std::vector<std::string> pages{
    "/README.md",       "/demos/README.md",         "/demos/guide.md",   "/demos/reference.md",
    "/demos/frames.md", "/assets/scenes/README.md", "/engine/README.md", "/tests/README.md"};

/// The matches of the first group of the expression in a text.
std::vector<std::string> found(const std::string& text, const char* expression) {
    const std::regex regex(expression);
    std::vector<std::string> words;
    for (std::sregex_iterator at(text.begin(), text.end(), regex), end; at != end; ++at)
        words.push_back((*at)[1]);
    return words;
}

bool mentions_all_files(const std::string& page, const std::string& folder,
                        const std::string& extension, bool with_extension) {
    const std::string text = text_of(root + page);
    bool all = true;
    for (const auto& entry : std::filesystem::directory_iterator(root + folder)) {
        if (entry.path().extension() != extension) continue;
        const auto name = with_extension ? entry.path().filename() : entry.path().stem();
        all = all && text.find(name.string()) != std::string::npos;
        EXPECT_TRUE(all) << page << " does not mention " << name;
    }
    return all;
}

TEST(Readme, ListsEveryKeyOfASceneAndNoOther) {
    const std::string section = text_of(root + "/assets/scenes/README.md");
    std::string table = "| table | key | value | default | |\n|---|---|---|---|---|\n";
    for (const SceneKey& key : scene_keys()) table += row(key) + "\n";
    EXPECT_TRUE(holds(section, "\n" + table + "\n"))
        << "the table of assets/scenes/README.md should be:\n"
        << table;
}

TEST(Readme, ListsEverySceneAndEveryDemo) {
    EXPECT_TRUE(mentions_all_files("/assets/scenes/README.md", "/assets/scenes", ".toml", true));
    EXPECT_TRUE(mentions_all_files("/demos/README.md", "/demos", ".cpp", false));
}

TEST(Readme, ShowsValidScenes) {
    const Folder folder;
    int scenes = 0;
    for (const std::string& page : pages)
        for (const std::string& block : found(text_of(root + page), "\n```toml\n([^`]*)\n```")) {
            const auto file = folder / "scene.toml";
            std::ofstream(file) << block;
            EXPECT_NO_THROW((void)read_scene(file.string())) << page;
            ++scenes;
        }
    EXPECT_GE(scenes, 2);
}

TEST(Readme, ShowsHelloAsItIs) {
    std::string hello = text_of(root + "/demos/hello.cpp");
    hello.erase(0, hello.find('\n') + 1);  // the licence
    EXPECT_TRUE(holds(text_of(root + "/README.md"), "\n```cpp\n" + hello + "```\n"))
        << "README.md should show demos/hello.cpp";
}

TEST(Readme, LinksLeadToFiles) {
    const std::regex code("```[^`]*```");
    for (const std::string& page : pages) {
        const std::string prose = std::regex_replace(text_of(root + page), code, "");
        for (const std::string& link : found(prose, R"(\]\(([^)#:]+)[)#])")) {
            const auto folder = std::filesystem::path(root + page).parent_path();
            EXPECT_TRUE(std::filesystem::exists(folder / link)) << page << ": " << link;
        }
    }
}

TEST(Readme, TheFirstPageIsShort) {
    const std::string text = text_of(root + "/README.md");
    EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 200);
    std::istringstream words(text);
    EXPECT_LE(std::distance(std::istream_iterator<std::string>(words), {}), 1200);
}

Scene scene_named(const std::string& name) {
    return read_scene(OILER_SOURCE "/assets/scenes/" + name + ".toml");
}

World world_at(const Scene& scene, std::int64_t rate) {
    Settings settings = Settings{scene.stepping};
    settings.stepping.rate = {rate};
    return make_world(scene, settings);
}

/// The largest error at the reference's times 1, 5 and 10 s, in the units of the state.
template <class StateOf>
double largest_error(const Scene& scene, std::int64_t rate, const nlohmann::json& states,
                     StateOf state_of) {
    World world = world_at(scene, rate);
    double largest = 0;
    for (const std::int64_t t : {1, 5, 10}) {
        world.step(t * rate - world.tick());
        const std::array<double, 4> state = state_of(world.bodies());
        for (std::size_t i = 0; i < 4; ++i)
            largest = std::max(largest,
                               std::abs(state.at(i) - number(states.at(std::to_string(t)).at(i))));
    }
    return largest;
}

/// Expects convergence of order 4 from the rate `coarse` to twice that. At the scene's own rate the
/// error is as small as order 4 predicts, and below 1e-7.
template <class StateOf>
void expect_order_four(const Scene& scene, std::int64_t coarse, const nlohmann::json& states,
                       double most, StateOf state_of) {
    const double before = largest_error(scene, coarse, states, state_of);
    const double halved = largest_error(scene, 2 * coarse, states, state_of);
    EXPECT_NEAR(std::log2(before / halved), 4, 0.15);
    const double ratio =
        static_cast<double>(coarse) / static_cast<double>(scene.stepping.rate.steps);
    const double own = largest_error(scene, scene.stepping.rate.steps, states, state_of);
    EXPECT_LT(own, 1.2 * before * std::pow(ratio, 4) + most);
    EXPECT_LT(own, 1e-7);
}

// The reference has displacements from the equilibria at −2 m and 2 m. Round-off: a step rounds
// numbers of up to 6 m about 30 times, ω scales it to velocities, 10⁴ steps are a random walk.
TEST(Scenes, ChainFollowsTheNormalModes) {
    const double round_off = 6 * 4.2 * 1.2e-16 * std::sqrt(30 * 1e4);
    const auto states = reference("coupled_and_kepler").at("two_coupled_equal").at("states");
    expect_order_four(scene_named("chain"), 40, states, round_off, [](const Bodies& bodies) {
        return std::array{bodies.position(0)[0] + 2, bodies.velocity(0)[0],
                          bodies.position(1)[0] - 2, bodies.velocity(1)[0]};
    });
}

// Round-off of the energy in 5000 steps shifts the phase, proportional to the time since then.
TEST(Scenes, OrbitFollowsKepler) {
    const auto states = reference("coupled_and_kepler")
                            .at("kepler_GM1_a1")
                            .at("values")
                            .at("e=0.6")
                            .at("states (x,y,vx,vy)");
    const double round_off = 1e-10;
    expect_order_four(scene_named("orbit"), 125, states, round_off, [](const Bodies& bodies) {
        const Vec3 x = bodies.position(0);
        const Vec3 v = bodies.velocity(0);
        return std::array{x[0], x[1], v[0], v[1]};
    });
}

Vec3 momentum(const Bodies& bodies) {
    Vec3 sum{};
    for (std::size_t row = 0; row < bodies.size(); ++row)
        sum = sum + bodies.velocity(row) * bodies.mass(row);
    return sum;
}

// Only round-off changes the momentum: a spring adds to one body and subtracts from another the
// same number. Two kicks per step add up to eight springs to velocities of at most 3 m/s, and round
// each.
TEST(Scenes, FreeClothConservesItsMomentumToRoundOff) {
    const Scene scene = scene_named("free_cloth");
    World world = make_world(scene, Settings{scene.stepping});
    const Vec3 before = momentum(world.bodies());
    EXPECT_NEAR(before[0], 96 * 0.05 * 0.5, 1e-14);
    constexpr std::int64_t steps = 2000;
    world.step(steps);
    const double mass = 96 * 0.05;
    const double most = mass * steps * 2 * 9 * 3 * round_off_of(Precision::double_);
    const Vec3 after = momentum(world.bodies());
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(after[i], before[i], most);
    // The net has oscillated, and its centre has moved at the speed of its momentum.
    double centre = 0;
    double speed = 0;
    for (std::size_t row = 0; row < world.bodies().size(); ++row) {
        centre += world.bodies().position(row)[0] / 96;
        speed = std::max(speed, std::abs(world.bodies().velocity(row)[1]));
    }
    EXPECT_NEAR(centre, -3 + 11 * 0.2 / 2 + 0.5 * 4, 1e-10);
    EXPECT_GT(speed, 0.1);
}

/// The largest change of the energy in a second, relative to that of the springs at the start.
double energy_drift(const Scene& scene, std::int64_t rate) {
    World world = world_at(scene, rate);
    const Energy first = world.bodies().energy();
    EXPECT_GT(first.potential, 0.1);
    double largest = 0;
    for (std::int64_t i = 0; i < rate; ++i) {
        world.step();
        largest = std::max(largest, std::abs(world.bodies().energy().total() - first.total()));
    }
    return largest / first.potential;
}

// The energy of a symplectic method of order 2 oscillates by O(dt²).
TEST(Scenes, FreeClothKeepsItsEnergyWithinOrderTwo) {
    const Scene scene = scene_named("free_cloth");
    const double drift = energy_drift(scene, scene.stepping.rate.steps);
    EXPECT_GT(drift, 1e-6);
    EXPECT_LT(drift, 0.02);
    EXPECT_NEAR(drift / energy_drift(scene, 2 * scene.stepping.rate.steps), 4, 0.3);
}

// The amplitude of the energy is ω·dt/2 = 1.9 %, as in the comment of the scene.
TEST(Scenes, TheUndampedSpringKeepsItsBudget) {
    const Scene scene = scene_named("article_spring_undamped");
    World world = make_world(scene, Settings{scene.stepping});
    const double first = world.bodies().energy().total();
    double largest = 0;
    for (int i = 0; i < 2000; ++i) {
        world.step();
        largest = std::max(largest, std::abs(world.bodies().energy().total() / first - 1));
    }
    EXPECT_LT(largest, *scene.budget.energy_drift);
    EXPECT_NEAR(largest, std::sqrt(15) * 0.01 / 2, 0.1 * std::sqrt(15) * 0.01 / 2);
}

}  // namespace
}  // namespace oiler::test
