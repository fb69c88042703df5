// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include "oiler/app/run_game.hpp"
#include "oiler/cli/arguments.hpp"
#include "oiler/cli/output.hpp"
#include "oiler/cli/startable.hpp"
#include "oiler/game/game.hpp"
#include "oiler/picture/palette.hpp"
#include "oiler/picture/shapes.hpp"
#include "oiler/process/interrupt.hpp"
namespace oiler::cli {
namespace {

constexpr Action up{"up", Key::up, Pad::up};
constexpr Action down{"down", Key::down, Pad::down};
constexpr Action across{"other list", Key::left, Key::right, Key::tab, Pad::left, Pad::right};
constexpr Action start{"start", Key::enter, Key::space, Mouse::left, Pad::south};
constexpr Control controls[] = {up, down, across, start};

/// A row of a list on the canvas.
struct Row {
    Point low;
    Point high;
    [[nodiscard]] bool holds(Point at) const {
        return at.x >= low.x && at.x < high.x && at.y >= low.y && at.y < high.y;
    }
};

/// Two lists side by side, of demos and of scenes.
class DemoMenu final : public AnyGame {
public:
    /// `all` and `chosen` must outlive the menu.
    DemoMenu(const std::vector<Startable>& all, std::size_t selected, const std::string& remark,
             std::optional<std::size_t>& chosen, const Settings& settings)
        : all_(all), remark_(remark), chosen_(chosen), world_(1, settings), selected_(selected) {
        demos_ = static_cast<std::size_t>(std::ranges::count(all, false, &Startable::is_scene));
    }

    std::int64_t step(std::int64_t step, std::int64_t count, InputSource& inputs) override {
        for (std::int64_t taken = 0; taken < count; ++taken) {
            update(inputs.next(step + taken));
            if (loop_.quits()) return taken;
            world_.step();
        }
        return count;
    }
    void restart() override {}
    [[nodiscard]] std::unique_ptr<AnyGame> clone() const override {
        return std::make_unique<DemoMenu>(*this);
    }
    void set_stepping(const Stepping& stepping) override { world_.set_stepping(stepping); }
    void set_threads(int threads) override { world_.set_threads(threads); }
    void assign(const AnyGame& other) override {
        const auto& source = dynamic_cast<const DemoMenu&>(other);
        world_ = source.world_;
        selected_ = source.selected_;
    }
    [[nodiscard]] bool takes_input() const override { return true; }
    [[nodiscard]] const World& world() const override { return world_; }
    [[nodiscard]] Picture picture() const override;

private:
    void update(const Input& input) {
        const bool is_demo = selected_ < demos_;
        const std::size_t first = is_demo ? 0 : demos_;
        const std::size_t last = (is_demo ? demos_ : all_.size()) - 1;
        if (input.pressed(up)) selected_ = std::max(first, selected_ - (selected_ > 0 ? 1 : 0));
        if (input.pressed(down)) selected_ = std::min(last, selected_ + 1);
        if (input.pressed(across) && demos_ > 0 && demos_ < all_.size())
            selected_ = is_demo ? std::min(demos_ + selected_, all_.size() - 1)
                                : std::min(selected_ - demos_, demos_ - 1);
        const std::optional<std::size_t> pointed = row_at(input.pointer_canvas());
        if (input.pointer_moved() && pointed) selected_ = *pointed;
        if (!input.pressed(start) || (input.pressed(Mouse::left) && !pointed)) return;
        chosen_ = selected_;
        loop_.quit();
    }

    [[nodiscard]] Row row_of(std::size_t index) const {
        constexpr float top = 312, bottom = 24, left = 14, width = 300, gap = 12;
        const std::size_t longest = std::max(demos_, all_.size() - demos_);
        const float height =
            std::min(24.0F, (top - bottom) / static_cast<float>(std::max<std::size_t>(longest, 1)));
        const bool is_demo = index < demos_;
        const float x = is_demo ? left : left + width + gap;
        const float y = top - height * static_cast<float>(index - (is_demo ? 0 : demos_));
        return {{x, y - height}, {x + width, y}};
    }
    [[nodiscard]] std::optional<std::size_t> row_at(std::optional<Point> pointer) const {
        for (std::size_t i = 0; pointer && i < all_.size(); ++i)
            if (row_of(i).holds(*pointer)) return i;
        return {};
    }

    const std::vector<Startable>& all_;
    std::string remark_;
    std::optional<std::size_t>& chosen_;
    World world_;  ///< without bodies
    std::size_t demos_ = 0;
    std::size_t selected_;
};

Picture DemoMenu::picture() const {
    Picture picture;
    const auto text = [&](Point at, const std::string& words, float size, Colour colour) {
        picture.labels.push_back({.at = at, .text = words, .size = size, .colour = colour});
    };
    text({14, 338}, "Oiler: a fixed-timestep game loop that tells you what your timestep costs", 12,
         palette::ink);
    for (const auto& [words, index] : {std::pair{"Games", std::size_t{0}}, {"Scenes", demos_}})
        text({row_of(index).low.x + 4, 316}, words, 10, palette::grey);
    for (std::size_t i = 0; i < all_.size(); ++i) {
        const Row row = row_of(i);
        const bool is_marked = i == selected_;
        if (is_marked)
            picture.polygons.push_back(
                {.points = {row.low, {row.high.x, row.low.y}, row.high, {row.low.x, row.high.y}},
                 .colour = palette::blue,
                 .space = Space::canvas});
        const float line = (row.high.y - row.low.y) / 2;
        text({row.low.x + 4, row.high.y - 0.85F * line}, all_[i].name, line * 0.9F,
             is_marked ? palette::paper : palette::ink);
        text({row.low.x + 4, row.low.y + 0.3F * line}, all_[i].sentence, line * 0.75F,
             is_marked ? palette::paper : palette::grey);
    }
    text({14, 8},
         remark_.empty() ? "Click, or choose with the arrows and start with Enter. Escape leaves."
                         : remark_,
         10, remark_.empty() ? palette::ink : palette::vermilion);
    return picture;
}

/// Lists demos and scenes in a window until the user chooses one, with the mouse or the keys, and
/// returns its index; empty if the user left. `remark` is a line at the bottom, `selected` the
/// index that is marked at first. Throws Error{no_display}.
std::optional<std::size_t> choose_in_window(const std::vector<Startable>& all, std::size_t selected,
                                            const std::string& remark) {
    constexpr About about{
        .name = "oiler demos", .title = "Oiler", .rate = 60, .controls = controls};
    Options options;
    options.settings.stepping.rate = {about.rate};
    options.quiet = true;
    std::optional<std::size_t> chosen;
    run_game(options, about, [&](const Settings& settings) {
        return std::make_unique<DemoMenu>(all, selected, remark, chosen, settings);
    });
    return chosen;
}
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
    std::size_t selected = 0;
    std::string remark;
    while (const auto chosen = choose_in_window(all, selected, remark)) {
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
