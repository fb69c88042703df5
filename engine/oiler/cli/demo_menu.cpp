// SPDX-License-Identifier: MIT
#include "oiler/cli/demo_menu.hpp"

#include <algorithm>
#include <cmath>

#include "oiler/app/run_game.hpp"
#include "oiler/cli/gallery.hpp"
#include "oiler/game/game.hpp"
#include "oiler/picture/palette.hpp"
#include "oiler/picture/shapes.hpp"
#include "oiler/picture/text.hpp"

namespace oiler::cli {
namespace {

constexpr Action up{"up", Key::up, Pad::up};
constexpr Action down{"down", Key::down, Pad::down};
constexpr Action left{"left", Key::left, Pad::left};
constexpr Action right{"right", Key::right, Key::tab, Pad::right};
constexpr Action start{"start", Key::enter, Key::space, Mouse::left, Pad::south};
constexpr Control controls[] = {up, down, left, right, start};

/// What the menu shows, while its window is open.
struct Shown {
    const std::vector<Startable>& all;
    const std::vector<std::shared_ptr<const Bitmap>>& pictures;
    const std::string& remark;
    std::optional<std::size_t>& chosen;
    Gallery gallery;
};

/// Two galleries, of demos and of scenes.
class DemoMenu final : public AnyGame {
public:
    /// `shown` must outlive the menu.
    DemoMenu(Shown& shown, std::size_t selected, const Settings& settings)
        : shown_(shown), world_(1, settings), selected_(selected) {}

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
        const Gallery& gallery = shown_.gallery;
        if (input.pressed(up)) selected_ = gallery.above(selected_);
        if (input.pressed(down)) selected_ = gallery.below(selected_);
        if (input.pressed(left)) selected_ -= selected_ > 0 ? 1 : 0;
        if (input.pressed(right)) selected_ = std::min(selected_ + 1, shown_.all.size() - 1);
        const auto pointer = input.pointer_canvas();
        const std::optional<std::size_t> pointed =
            pointer ? gallery.card_at(*pointer) : std::nullopt;
        if (input.pointer_moved() && pointed) selected_ = *pointed;
        if (!input.pressed(start) || (input.pressed(Mouse::left) && !pointed)) return;
        shown_.chosen = selected_;
        loop_.quit();
    }
    void draw_card(std::size_t index, Picture& picture) const;

    Shown& shown_;
    World world_;  ///< without bodies
    std::size_t selected_;
};

/// A name without ".toml", and shorter if it is wider than a card.
std::string shortened(const Startable& one, float width, float size) {
    std::string name = one.name.substr(0, one.name.find('.'));
    const float room = 0.94F * width;  // letters may be wider than estimated
    if (text_width(name, size) <= room) return name;
    while (!name.empty() && text_width(name + "…", size) > room) name.pop_back();
    return name + "…";
}

void DemoMenu::draw_card(std::size_t index, Picture& picture) const {
    const Gallery& gallery = shown_.gallery;
    const Gallery::Card card = gallery.card(index);
    const bool is_marked = index == selected_;
    const Point size{gallery.width(), gallery.picture_height()};
    const Point centre{card.low.x + size.x / 2, card.high.y - size.y / 2};
    const auto& bitmap = shown_.pictures[index];
    if (bitmap)
        picture.sprites.push_back(
            {.centre = centre, .size = size, .bitmap = bitmap, .space = Space::canvas});
    picture.polygons.push_back({.points = rectangle(centre, size),
                                .colour = palette::faded(palette::pale, bitmap ? 0 : 255),
                                .outline = is_marked ? 2.5F : 0.75F,
                                .outline_colour = is_marked ? palette::blue : palette::pale,
                                .space = Space::canvas});
    constexpr float letters = 9;
    add_text(picture, {centre.x, card.low.y + 4}, shortened(shown_.all[index], size.x, letters),
             letters, is_marked ? palette::blue : palette::ink, Align::centre);
}

Picture DemoMenu::picture() const {
    Picture picture;
    const Gallery& gallery = shown_.gallery;
    add_text(picture, {Gallery::left, 342},
             "Oiler: a fixed-timestep game loop that tells you what your timestep costs", 12,
             palette::ink);
    for (const auto& [words, y] :
         {std::pair{"Games", gallery.heading(false)}, {"Scenes", gallery.heading(true)}})
        if (y) add_text(picture, {Gallery::left, *y}, words, 11, palette::grey);
    for (std::size_t i = 0; i < shown_.all.size(); ++i) draw_card(i, picture);

    const Startable& one = shown_.all[selected_];
    add_text(picture, {Gallery::left, 43}, one.name, 14, palette::blue);
    add_text(picture, {Gallery::left, 27}, one.sentence, 11, palette::ink);
    const bool has_remark = !shown_.remark.empty();
    add_text(picture, {Gallery::left, 8},
             has_remark ? shown_.remark
                        : "Click, or choose with the arrows and start with Enter. Escape leaves.",
             10, has_remark ? palette::vermilion : palette::grey);
    return picture;
}

}  // namespace

std::vector<std::shared_ptr<const Bitmap>> load_pictures(const std::vector<Startable>& all) {
    std::vector<std::shared_ptr<const Bitmap>> pictures;
    for (const Startable& one : all) {
        pictures.emplace_back();
        try {
            // its path is whole; an installed program names no folder of its source
            if (!one.picture.empty()) pictures.back() = load_bitmap(one.picture, "");
        } catch (const Error&) {  // the menu works without it
        }
    }
    return pictures;
}

std::optional<std::size_t> choose_in_window(
    const std::vector<Startable>& all, const std::vector<std::shared_ptr<const Bitmap>>& pictures,
    std::size_t selected, const std::string& remark) {
    constexpr About about{
        .name = "oiler demos", .title = "Oiler", .rate = 60, .controls = controls};
    Options options;
    options.settings.stepping.rate = {about.rate};
    options.quiet = true;
    std::optional<std::size_t> chosen;
    const auto games =
        static_cast<std::size_t>(std::ranges::count(all, false, &Startable::is_scene));
    Shown shown{all, pictures, remark, chosen, Gallery(games, all.size() - games)};
    run_game(options, about, [&](const Settings& settings) {
        return std::make_unique<DemoMenu>(shown, selected, settings);
    });
    return chosen;
}

}  // namespace oiler::cli
