// SPDX-License-Identifier: MIT
// The panel is used as a user does: by clicking on every place of it.
#include "oiler/inspector/inspector.hpp"

#include <functional>

#include "oiler/render/renderer.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

constexpr Size frame{1280, 720};
constexpr float panel_left = 890;

Inspected run_at_60_hz() {
    static const std::vector<const Method*> all{&find_method("semi_implicit_euler"),
                                                &find_method("velocity_verlet")};
    Inspected run{.stepping = {.method = &find_method("semi_implicit_euler"), .rate = {60}},
                  .methods = all,
                  .errors = {0, 0.1F, 0.2F},
                  .bodies = 1};
    Inspected::Setting setting{.stepping = run.stepping, .error = "7.5 cm"};
    run.settings.push_back(setting);
    setting.stepping.rate = {120};
    run.settings.push_back(setting);
    setting.stepping = {.method = &find_method("rk4"), .rate = {60}};
    run.settings.push_back(setting);
    return run;
}

/// All that happens on clicks on places of a grid, each in an inspector that is at rest.
std::vector<Requests> clicks_everywhere(const Inspected& run) {
    std::vector<Requests> all;
    Inspector inspector(Renderer::font());
    for (float y = 22; y < 720; y += 6)
        for (float x = panel_left; x < 1280; x += 12) {
            const Point at{x, y};
            for (const bool down : {false, false, true, false, false}) {
                const Requests requests = inspector.show(run, {at, down}, frame, 1.0 / 60);
                EXPECT_TRUE(inspector.has_mouse() || x < panel_left + 10) << x << ' ' << y;
                all.push_back(requests);
            }
            // A menu that the click opened closes by a click beside it.
            for (const bool down : {false, true, false, false})
                (void)inspector.show(run, {Point{100, 400}, down}, frame, 1.0 / 60);
        }
    return all;
}

bool any(const std::vector<Requests>& all, const std::function<bool(const Requests&)>& is) {
    return std::ranges::any_of(all, is);
}

TEST(Inspector, WritesTimesAndEnergiesWithUnits) {
    EXPECT_EQ(time_text(999), "999 ns");
    EXPECT_EQ(time_text(123'400), "123 µs");
    EXPECT_EQ(time_text(4.5e6), "4.5 ms");
    EXPECT_EQ(energy_text(0), "0 J");
    EXPECT_EQ(energy_text(-12.3456), "-12.35 J");
    EXPECT_EQ(energy_text(4.23537e6), "4.235 MJ");
    EXPECT_EQ(energy_text(-1234.56), "-1.235 kJ");
    EXPECT_EQ(energy_text(2.5e-7), "2.5e-07 J");
    EXPECT_EQ(energy_text(1.8e18), "1.8e+18 J");
}

TEST(Inspector, AsksForWhatIsClicked) {
    const std::vector<Requests> all = clicks_everywhere(run_at_60_hz());
    EXPECT_TRUE(any(all, [](const Requests& one) { return one.pauses; }));
    EXPECT_TRUE(any(all, [](const Requests& one) { return one.restarts; }));
    EXPECT_TRUE(any(all, [](const Requests& one) { return one.slower == 1; }));
    EXPECT_TRUE(any(all, [](const Requests& one) { return one.faster == 1; }));
    EXPECT_FALSE(any(all, [](const Requests& one) { return one.steps || one.goes_back; }))
        << "not paused";
    EXPECT_TRUE(any(all, [](const Requests& one) { return one.shown.trails; }));
    EXPECT_TRUE(any(all, [](const Requests& one) { return one.shown.springs; }));
    EXPECT_TRUE(any(all, [](const Requests& one) { return one.shown.velocities; }));
    EXPECT_TRUE(any(all, [](const Requests& one) { return one.shown.accelerations; }));
    EXPECT_EQ(all.front().shown, Shown{});
    std::set<std::int64_t> rates;
    std::set<std::string_view> methods;
    std::set<Precision> precisions;
    for (const Requests& one : all) {
        if (!one.stepping) continue;
        rates.insert(one.stepping->rate.steps);
        methods.insert(one.stepping->method->name);
        precisions.insert(one.stepping->precision);
    }
    EXPECT_GT(rates.size(), 10U) << "the slider";
    EXPECT_TRUE(std::ranges::all_of(rates, [](std::int64_t rate) { return rate % 2 == 0; }));
    EXPECT_GE(*rates.begin(), 10);
    EXPECT_LE(*rates.rbegin(), 1000);
    EXPECT_TRUE(rates.contains(120)) << "applied";
    EXPECT_TRUE(methods.contains("rk4")) << "applied";
    EXPECT_TRUE(precisions.contains(Precision::single));
}

// The method's own choice is written as none.
TEST(Inspector, OffersTheDampingOfASplitting) {
    const auto asked = [](const Stepping& now) {
        Inspected run = run_at_60_hz();
        run.stepping = now;
        std::set<std::optional<Damping>> dampings;
        for (const Requests& one : clicks_everywhere(run))
            if (one.stepping && one.stepping->damping != now.damping)
                dampings.insert(one.stepping->damping);
        return dampings;
    };
    Stepping now = run_at_60_hz().stepping;
    ASSERT_EQ(now.method->damping, Damping::in_kick);
    EXPECT_EQ(asked(now), (std::set<std::optional<Damping>>{Damping::in_drift}));
    now.damping = Damping::in_drift;
    EXPECT_EQ(asked(now), (std::set<std::optional<Damping>>{std::nullopt}));
    now = {.method = &find_method("rk4"), .rate = {60}};
    EXPECT_TRUE(asked(now).empty()) << "it has no choice";
}

// Wherever the box is: after a click on it, a click on a button at the left of the list restarts.
TEST(Inspector, AChangeGoesOnUnlessItShallRestart) {
    const Inspected run = run_at_60_hz();
    const auto click = [&](Inspector& inspector, Point at) {
        bool restarts = false;
        for (const bool down : {false, false, true, false, false}) {
            const Requests requests = inspector.show(run, {at, down}, frame, 1.0 / 60);
            restarts = restarts || (requests.stepping && requests.changes_from_start);
        }
        return restarts;
    };
    constexpr float step = 12;
    int boxes = 0;
    for (float y = 124; y < 148; y += step) {
        Inspector inspector(Renderer::font());
        EXPECT_FALSE(click(inspector, {1081, y}));
        bool restarts = false;
        for (float of_button = 280; of_button < 500; of_button += step)
            for (float x = 903; x < 936; x += 15)
                restarts = click(inspector, {x, of_button}) || restarts;
        boxes += restarts ? 1 : 0;
    }
    EXPECT_GE(boxes, 1);
    EXPECT_LE(boxes, 2);
}

// A click on the method opens the menu; with Escape it is gone in the next frame.
TEST(Inspector, OffersThreadsWhereMoreThanOneChangeSomething) {
    Inspected run = run_at_60_hz();
    EXPECT_FALSE(
        any(clicks_everywhere(run), [](const Requests& one) { return one.threads.has_value(); }));
    run.most_threads = 4;
    run.threads = 2;
    std::set<int> offered;
    for (const Requests& one : clicks_everywhere(run))
        if (one.threads) offered.insert(*one.threads);
    EXPECT_EQ(offered, (std::set<int>{1, 3, 4}));
}

TEST(Inspector, EscapeClosesAnOpenMenu) {
    const Inspected run = run_at_60_hz();
    Inspector inspector(Renderer::font());
    const Point method{1000, 113};
    for (const bool down : {false, false, true, false, false}) {
        EXPECT_FALSE(inspector.has_menu() && down);
        (void)inspector.show(run, {method, down}, frame, 1.0 / 60);
    }
    ASSERT_TRUE(inspector.has_menu());
    (void)inspector.show(run, {.at = method, .escapes = true}, frame, 1.0 / 60);
    (void)inspector.show(run, {.at = method}, frame, 1.0 / 60);
    EXPECT_FALSE(inspector.has_menu());
}

TEST(Inspector, ChangesOneThingOfASetting) {
    for (const Requests& one : clicks_everywhere(run_at_60_hz())) {
        if (!one.stepping) continue;
        const Stepping now = run_at_60_hz().stepping;
        EXPECT_EQ(int{one.stepping->rate != now.rate} + int{one.stepping->method != now.method} +
                      int{one.stepping->precision != now.precision} +
                      int{one.stepping->damping != now.damping},
                  1);
    }
}

TEST(Inspector, StepsInAPauseAndKeepsAFixedSetting) {
    Inspected run = run_at_60_hz();
    run.is_paused = true;
    run.past = {{0, 600, 600}};
    run.fixed = "--record keeps this setting.";
    const std::vector<Requests> all = clicks_everywhere(run);
    EXPECT_TRUE(any(all, [](const Requests& one) { return one.steps; }));
    EXPECT_TRUE(any(all, [](const Requests& one) { return one.goes_back; }));
    EXPECT_FALSE(any(all, [](const Requests& one) { return one.stepping.has_value(); }));
}

// A game with settings of its own: no other one is shown.
TEST(Inspector, HidesASettingThatIsNotThatOfThePicture) {
    const auto points = [](const char* method, std::int64_t rate, bool hides_setting) {
        Inspected run = run_at_60_hz();
        run.stepping = {.method = &find_method(method), .rate = {rate}};
        run.verdict = "7.5 cm off at " + std::to_string(rate) + " Hz";
        run.fixed = "The slider in the picture sets the rate of all lanes.";
        run.hides_setting = hides_setting;
        Inspector inspector(Renderer::font());
        for (int i = 0; i < 3; ++i) (void)inspector.show(run, {}, frame, 1.0 / 60);
        return inspector.overlay().vertices.size();
    };
    EXPECT_NE(points("rk4", 60, false), points("semi_implicit_euler", 240, false));
    EXPECT_EQ(points("rk4", 60, true), points("semi_implicit_euler", 240, true));
    EXPECT_LT(points("rk4", 60, true), points("rk4", 60, false));
}

// A drag along the time line asks for each step in turn, as long as it is held.
TEST(Inspector, GoesToStepsOfThePast) {
    Inspected run = run_at_60_hz();
    run.past = {{100, 500, 600}};
    std::set<std::int64_t> seeked;
    for (float y = 150; y < 230; y += 6) {
        Inspector inspector(Renderer::font());
        const auto drag = [&](float x, bool down) {
            return inspector.show(run, {Point{x, y}, down}, frame, 1.0 / 60).step;
        };
        (void)drag(1270, false);
        (void)drag(1270, false);
        for (float x = 1270; x > panel_left; x -= 8)
            if (const auto step = drag(x, true)) seeked.insert(*step);
        EXPECT_FALSE(drag(panel_left, false));
    }
    EXPECT_GT(seeked.size(), 30U);
    EXPECT_EQ(*seeked.begin(), 100);
    EXPECT_EQ(*seeked.rbegin(), 600);
    run.past = {{5, 5, 5}};
    EXPECT_FALSE(
        any(clicks_everywhere(run), [](const Requests& one) { return one.step.has_value(); }));
}

TEST(Inspector, LeavesTheMouseBesideItToTheGame) {
    Inspector inspector(Renderer::font());
    for (const bool down : {false, false, true, true})
        EXPECT_FALSE(inspector.show(run_at_60_hz(), {Point{400, 300}, down}, frame, 0.01).stepping);
    EXPECT_FALSE(inspector.has_mouse());
    (void)inspector.show(run_at_60_hz(), {std::nullopt, false}, frame, 0.01);
    EXPECT_FALSE(inspector.has_mouse());
}

// At least 11/14 pixels a unit: 340 of them are 267 pixels.
TEST(Inspector, LeavesMostOfASmallWindowToTheGame) {
    EXPECT_EQ(Inspector::view({1280, 720}).width, 1280 - 390);
    EXPECT_EQ(Inspector::view({640, 360}).width, 640 - 268) << "0.42 of 640";
    EXPECT_EQ(Inspector::view({480, 360}).width, 480 - 267);
    EXPECT_EQ(Inspector::view({300, 360}).width, 100) << "a third";
}

/// Where clicks apply another setting, in pixels of a frame of that size.
std::vector<Point> places_of_apply(const Inspected& run, Size size) {
    std::vector<Point> places;
    Inspector inspector(Renderer::font());
    const auto left = static_cast<float>(Inspector::view(size).width);
    for (float y = 240; y < 600; y += 6)
        for (float x = left + 2; x < left + 90; x += 6) {
            bool applies = false;
            for (const bool down : {false, false, true, false, false})
                applies = applies || inspector.show(run, {Point{x, y}, down}, size, 0.02).stepping;
            if (applies) places.push_back({x, y});
        }
    return places;
}

TEST(Inspector, ButtonsStandStillWhileFiguresChange) {
    Inspected run = run_at_60_hz();
    const std::vector<Point> before = places_of_apply(run, frame);
    ASSERT_GT(before.size(), 10U);
    run.status = "paused: F3 resumes, F4 steps back, F5 steps";
    run.followed = "planet: 1.234 m/s at (0.1234, -12.34) m";
    run.rate_advice = "About 600 Hz of this method would be within a pixel so far.";
    run.verdict = std::string(150, 'x');
    run.bodies = 0;
    for (Inspected::Setting& one : run.settings) {
        one.error = "other events";
        one.cost = "< 10 µs";
        one.forces = "×0.99";
    }
    EXPECT_EQ(places_of_apply(run, frame), before);
    // Half as many units: the same buttons can be clicked, though other columns are cut.
    EXPECT_GT(places_of_apply(run, {420, 720}).size(), 10U);
}

// 320 x 180 shows only the upper part; the wheel brings the rest into view.
TEST(Inspector, ScrollsWhereItDoesNotFit) {
    constexpr Size small{320, 180};
    Inspector inspector(Renderer::font());
    const auto applies = [&] {
        bool found = false;
        for (float y = 4; y < 180; y += 6)
            for (const bool down : {false, false, true, false, false}) {
                const Requests one =
                    inspector.show(run_at_60_hz(), {Point{128, y}, down}, small, 0.02);
                found = found || (one.stepping && one.stepping->method->name == "rk4");
            }
        return found;
    };
    EXPECT_FALSE(applies());
    bool found = false;
    for (int turn = 0; turn < 20 && !found; ++turn) {
        (void)inspector.show(run_at_60_hz(), {.at = Point{312, 60}, .wheel = -1}, small, 0.02);
        found = applies();
    }
    EXPECT_TRUE(found);
}

TEST(Inspector, DrawsWithinTheFrame) {
    Inspector resized(Renderer::font());
    for (const Size size : {Size{1280, 720}, Size{640, 360}, Size{3840, 2160}}) {
        Inspector inspector(Renderer::font());
        for (int i = 0; i < 3; ++i)
            (void)inspector.show(run_at_60_hz(), {Point{1, 1}, false}, size, 0.01);
        const Overlay& overlay = inspector.overlay();
        ASSERT_TRUE(overlay.bitmap);
        (void)resized.show(run_at_60_hz(), {}, size, 0.01);
        EXPECT_EQ(resized.overlay().bitmap->hash, overlay.bitmap->hash) << "its letters";
        std::size_t indices = 0;
        for (const Overlay::Part& part : overlay.parts) {
            EXPECT_EQ(part.first, indices);
            indices += part.count;
            EXPECT_GE(part.left, 0);
            EXPECT_LE(part.right, size.width);
            EXPECT_LE(part.bottom, size.height);
        }
        EXPECT_EQ(indices, overlay.indices.size());
        EXPECT_LT(*std::ranges::max_element(overlay.indices), overlay.vertices.size());
    }
}

}  // namespace
}  // namespace oiler::test
