// SPDX-License-Identifier: MIT
#include "oiler/scene/read.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "oiler/core/error.hpp"
#include "oiler/core/nearest.hpp"
#include "oiler/core/require.hpp"
#include "oiler/scene/read_obstacles.hpp"
#include "oiler/scene/section.hpp"
#include "oiler/toml/document.hpp"

namespace oiler {
namespace {

class Descriptor {
public:
    /// O_NONBLOCK: opening a pipe without a writer does not wait.
    explicit Descriptor(const std::string& path)
        : number_(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {}
    ~Descriptor() {
        if (number_ >= 0) close(number_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    [[nodiscard]] int number() const { return number_; }

private:
    int number_;
};

void require_file(int descriptor, const std::string& path) {
    struct stat status {};
    if (fstat(descriptor, &status) != 0) fail(Exit::io, "{}: {}", path, system_reason(errno));
    if (!S_ISREG(status.st_mode))
        fail(Exit::usage, "{}: not a file; give a scene file such as assets/scenes/cloth.toml",
             path);
}

void read_matter(const Scene& scene, const Section& section, SceneMatter& matter) {
    section.read("mass", matter.mass);
    section.read("linear_drag", matter.linear_drag);
    section.read("quadratic_drag", matter.quadratic_drag);
    section.read("colour", matter.colour);
    section.read("contact", matter.contact);
    matter.meets = read_meets(scene, section);
    section.read("radius", matter.radius);
}

Hang hang_of(const std::string& word) {
    if (word == "corners") return Hang::corners;
    return word == "top" ? Hang::top : Hang::none;
}

/// Makes a scene from a document, table by table.
class Reader {
public:
    Reader(const Value& document, std::string_view file) : document_(document), file_(file) {
        refuse_unknown_tables();
        refuse_unknown_keys();
    }

    Scene run() {
        read_settings();
        each("gravity", [&](const Section& section) { read_gravity(section); });
        add_obstacles("plane", scene_.planes, read_plane);
        add_obstacles("obstacle", scene_.obstacles, read_obstacle);
        add_obstacles("chain", scene_.chains, read_chain);
        add_obstacles("tiles", scene_.tiles, read_tiles);
        each("body", [&](const Section& section) { read_body(section); });
        each("spring", [&](const Section& section) { read_spring(section); });
        each("attractor", [&](const Section& section) { read_attractor(section); });
        read_forces();
        each("grid", [&](const Section& section) { read_grid(section); });
        each("scatter", [&](const Section& section) { read_scatter(section); });
        each("camera", [&](const Section& section) { read_camera(section); });
        each("view", [&](const Section& section) { read_view(section); });
        each("budget", [&](const Section& section) { read_budget(section); });
        if (scene_.body_count() == 0)
            refuse({file_, 1}, "body: missing; a scene needs a [[body]], [[grid]] or [[scatter]]");
        check_forces(scene_, force_place_);
        check_method(scene_, method_place_);
        return std::move(scene_);
    }

private:
    void refuse_unknown_tables() const {
        std::vector<std::string_view> tables;
        for (const SceneTable& table : scene_tables()) tables.push_back(table.name);
        for (const Value& member : document_.items)
            if (std::ranges::find(tables, member.key) == tables.end())
                refuse({file_, member.line}, "{}: a scene has no such table{}",
                       printable(member.key), remedy_for(member.key, tables));
    }
    static std::string remedy_for(const std::string& key,
                                  const std::vector<std::string_view>& tables) {
        std::string owners;
        for (const SceneKey& known : scene_keys())
            if (known.name == key) owners += fmt::format(" [{}]", known.table);
        if (!owners.empty()) return "; it is a key of" + owners + "; write it below that header";
        const std::string near = did_you_mean(key, tables);
        return near.empty() ? fmt::format("; it has {}", fmt::join(tables, ", ")) : near;
    }
    /// Runs before any value is read, so that a misspelt key is not reported as missing.
    void refuse_unknown_keys() const {
        for (const SceneTable& table : scene_tables()) each(table.name, [](const Section&) {});
    }

    /// Calls `f` with each table of that name.
    template <class F>
    void each(std::string_view table, F f) const {
        const Value* const value = document_.find(table);
        if (!value) return;
        if (!scene_table(table).is_repeated()) return f(section(table, *value));
        if (value->kind != ValueKind::list)
            refuse({file_, value->line}, "{}: expected a list of tables, got {}; write [[{}]]",
                   table, value->shown(), table);
        for (const Value& item : value->items) f(section(table, item));
    }
    [[nodiscard]] Section section(std::string_view table, const Value& value) const {
        Section section(file_, table, value);
        section.set_axes(scene_.axes);
        return section;
    }

    void read_settings() {
        const Value* const value = document_.find("scene");
        if (!value) refuse({file_, 1}, "scene: missing; start with [scene] and axes = 1, 2 or 3");
        const Section section(file_, "scene", *value);
        std::int64_t axes = 0;
        section.read("title", scene_.title);
        section.read("axes", axes);
        scene_.axes = static_cast<int>(axes);
        section.read("rate", scene_.stepping.rate.steps);
        section.read("duration", scene_.duration);
        if (section.has("method")) scene_.stepping.method = &find_method(section.word("method"));
        if (const auto precision = find_precision(section.word("precision")))
            scene_.stepping.precision = *precision;
        scene_.stepping.damping = find_damping(section.word("damping"));
        method_place_ = section.place("method");
    }

    void read_gravity(const Section& section) {
        section.read("acceleration", scene_.gravity.emplace());
        check_numbers(scene_, section, "acceleration", *scene_.gravity);
    }

    void read_body(const Section& section) {
        SceneBody& body = scene_.bodies.emplace_back();
        section.read("name", body.name);
        section.read("position", body.position);
        section.read("velocity", body.velocity);
        read_matter(scene_, section, body.matter);
        check_matter(scene_, section, body.matter);
        check_numbers(scene_, section, "position", body.position);
        check_numbers(scene_, section, "velocity", body.velocity);
        if (section.has("name")) remember(section, body.name);
    }
    void remember(const Section& section, const std::string& name) {
        if (name.empty())
            refuse(section.place("name"),
                   "body.name: expected a name, got an empty text; leave it out");
        if (!names_.emplace(name, scene_.bodies.size() - 1).second)
            refuse(section.place("name"),
                   "body.name: another body has the name \"{}\"; give another name",
                   printable(name));
    }
    [[nodiscard]] std::size_t find_body(const Section& section, std::string_view key) const {
        std::string name;
        section.read(key, name);
        if (const auto found = names_.find(name); found != names_.end()) return found->second;
        std::vector<std::string_view> names;
        for (const auto& [known, index] : names_) names.push_back(known);
        const std::string near = did_you_mean(name, names);
        refuse(section.place(key), "{}.{}: no [[body]] has the name \"{}\"{}", section.name(), key,
               printable(name),
               near.empty() ? fmt::format("; give one name = \"{}\"", printable(name)) : near);
    }

    void read_spring(const Section& section) {
        SceneSpring& spring = scene_.springs.emplace_back();
        spring.body = find_body(section, "body");
        if (section.has("anchor") == section.has("to"))
            refuse(section.place("to"), "spring.to: expected either an anchor or a body, got {}",
                   section.has("to") ? "both; leave one out"
                                     : "neither; give anchor = […] or to = \"another body\"");
        if (section.has("to"))
            spring.to = find_body(section, "to");
        else
            force_place_ = section.place();
        if (spring.to == spring.body)
            refuse(section.place("to"),
                   "spring.to: both ends are the same body; give another body or an anchor");
        section.read("anchor", spring.anchor);
        section.read("stiffness", spring.stiffness);
        section.read("damping", spring.damping);
        section.read("rest_length", spring.rest_length);
        section.read("pulls_only", spring.pulls_only);
        section.read("colour", spring.colour);
        check_spring(scene_, section, spring);
    }

    void read_forces() {
        for_each_index<force_count>([&](auto kind) {
            using Force = std::tuple_element_t<kind, ForceList<double, 3>>;
            const auto table = std::ranges::find(scene_tables(), Force::name, &SceneTable::name);
            if constexpr (BodyForce<Force>)
                if (table != scene_tables().end() && table->is_force())
                    each(Force::name, [&](const Section& section) { read_force<Force>(section); });
        });
    }
    template <BodyForce Force>
    void read_force(const Section& section) {
        Force force;
        SceneForce& read = scene_.forces.emplace_back();
        read.body = find_body(section, "body");
        force_place_ = section.place();
        for_each_field<Force>(
            [&](const auto& field) { section.read(field.key, force.*field.member); });
        read.force = force;
        check_force(scene_, section, read);
    }

    void read_attractor(const Section& section) {
        SceneAttractor& attractor = scene_.attractors.emplace_back();
        force_place_ = section.place();
        section.read("position", attractor.position);
        section.read("gm", attractor.gm);
        section.read("colour", attractor.colour);
        section.read("radius", attractor.radius);
        check_numbers(scene_, section, "position", attractor.position);
        check_number(scene_, section, "gm", attractor.gm);
    }

    template <class Table>
    void add_obstacles(std::string_view table, std::vector<Table>& tables,
                       Table (*read)(Scene&, const Section&)) {
        each(table, [&](const Section& section) {
            Table& added = tables.emplace_back(read(scene_, section));
            if (!section.has("name")) return;
            if (added.name.empty())
                refuse(section.place("name"),
                       "{}.name: expected a name, got an empty text; leave it out", table);
            if (!obstacle_names_.insert(added.name).second)
                refuse(section.place("name"),
                       "{}.name: another obstacle has the name \"{}\"; give another name", table,
                       printable(added.name));
        });
    }

    void read_grid(const Section& section) {
        SceneGrid& grid = scene_.grids.emplace_back();
        section.read("count", grid.count);
        section.read("origin", grid.origin);
        section.read("velocity", grid.velocity);
        section.read("spacing", grid.spacing);
        read_matter(scene_, section, grid.matter);
        section.read("stiffness", grid.stiffness);
        section.read("damping", grid.damping);
        section.read("rest_length", grid.rest_length);
        section.read("diagonals", grid.diagonals);
        grid.hang = hang_of(section.word("hang"));
        check_grid(scene_, section, grid);
    }

    void read_scatter(const Section& section) {
        SceneScatter& scatter = scene_.scatters.emplace_back();
        section.read("count", scatter.count);
        section.read("seed", scatter.seed);
        section.read("position_from", scatter.position_from);
        section.read("position_to", scatter.position_to);
        section.read("velocity_from", scatter.velocity_from);
        scatter.velocity_to = scatter.velocity_from;
        section.read("velocity_to", scatter.velocity_to);
        read_matter(scene_, section, scatter.matter);
        check_scatter(scene_, section, scatter);
    }

    void read_camera(const Section& section) {
        section.read("centre", scene_.camera.centre);
        section.read("height", scene_.camera.height);
    }

    void read_view(const Section& section) {
        section.read("background", scene_.view.background);
        section.read("trails", scene_.view.trails);
        section.read("fastest", scene_.view.fastest);
        section.read("wind", scene_.view.wind);
    }

    void read_budget(const Section& section) {
        section.read("position_error", scene_.budget.position_error);
        section.read("energy_drift", scene_.budget.energy_drift);
    }

    const Value& document_;
    std::string_view file_;
    Place method_place_{};
    Place force_place_{};                       // last anchored spring or attractor
    std::map<std::string, std::size_t> names_;  // name of a body → its index
    std::set<std::string> obstacle_names_;
    Scene scene_;
};

Value word_value(std::string_view key, std::string_view text) {
    return {.key = std::string(key), .kind = ValueKind::text, .text = std::string(text)};
}

std::vector<Value> values_of(const Stepping& stepping) {
    std::vector<Value> values{
        {.key = "rate", .kind = ValueKind::whole, .whole = stepping.rate.steps},
        word_value("method", stepping.method->name),
        word_value("precision", name_of(stepping.precision))};
    if (stepping.damping) values.push_back(word_value("damping", damping_name(stepping)));
    return values;
}

std::string written(const Value& value, char quote = '"') {
    if (value.kind == ValueKind::whole) return fmt::format("{}", value.whole);
    return fmt::format("{0}{1}{0}", quote, value.text);
}

std::string replaced(std::string text, const Value& old, const Value& value) {
    if (old.whole == value.whole && old.text == value.text) return text;
    return text.replace(old.at.begin, old.at.size(), written(value, text[old.at.begin]));
}

/// Line end of the line that holds `at`: "\r\n" or "\n". If the last line has none, the line end of
/// the text.
std::string_view line_end(std::string_view text, std::size_t at) {
    const std::size_t end = text.find('\n', at);
    if (end == std::string_view::npos) return text.find("\r\n") < at ? "\r\n" : "\n";
    return end > 0 && text[end - 1] == '\r' ? "\r\n" : "\n";
}

/// Adds a line below that of `last`. It repeats the indentation of that line and the "scene." of a
/// dotted key.
std::string with_line(std::string text, const Value& last, const Value& value) {
    const std::string_view whole = text;
    const std::size_t begin = whole.substr(0, last.key_at.begin).rfind('\n') + 1;
    const std::string_view end = line_end(whole, last.at.end);
    const std::string line = fmt::format(
        "{}{} = {}", whole.substr(begin, last.key_at.begin - begin), value.key, written(value));
    const std::size_t below = whole.find('\n', last.at.end);
    if (below == std::string_view::npos) return fmt::format("{}{}{}", text, end, line);
    return text.insert(below + 1, fmt::format("{}{}", line, end));
}

std::string with(std::string text, std::string_view file, const Value& value) {
    const Value document = parse_document(text, file);
    const Value& scene = *document.find("scene");
    if (const Value* const old = scene.find(value.key))
        return replaced(std::move(text), *old, value);
    // Never empty, because `axes` is required.
    const Value& last =
        *std::ranges::max_element(scene.items, {}, [](const Value& item) { return item.at.end; });
    if (text[scene.at.begin] == '{')
        return text.insert(last.at.end, fmt::format(", {} = {}", value.key, written(value)));
    return with_line(std::move(text), last, value);
}

}  // namespace

std::string read_scene_text(const std::string& path) {
    const Descriptor file(path);
    if (file.number() < 0)
        fail(exit_of_open(errno), "{}: {}; give a scene file such as assets/scenes/cloth.toml",
             path, system_reason(errno));
    require_file(file.number(), path);
    std::string text(most_toml_bytes + 1, '\0');
    std::size_t size = 0;
    while (size < text.size()) {
        const ssize_t got = read(file.number(), text.data() + size, text.size() - size);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) fail(Exit::io, "{}: {}", path, system_reason(errno));
        if (got == 0) break;
        size += static_cast<std::size_t>(got);
    }
    text.resize(size);
    return text;
}

Scene read_scene(const std::string& path) { return parse_scene(read_scene_text(path), path); }

Scene parse_scene(std::string_view text, std::string_view file) {
    const Value document = parse_document(text, file);
    return Reader(document, file).run();
}

std::string apply(std::string_view text, std::string_view file, const Stepping& stepping) {
    require(stepping.method, "stepping needs a method");
    Scene scene = parse_scene(text, file);
    Stepping chosen = stepping;
    if (scene.stepping.damping && !chosen.damping) chosen.damping = chosen.method->damping;
    scene.stepping = chosen;
    std::string applied(text);
    for (const Value& value : values_of(chosen)) applied = with(std::move(applied), file, value);
    if (parse_scene(applied, file) != scene)
        fail(Exit::usage,
             "{}: an edit would change other keys; write rate = {}, method = \"{}\" and "
             "precision = \"{}\" into its [scene] by hand",
             file, chosen.rate.steps, chosen.method->name, name_of(chosen.precision));
    return applied;
}

}  // namespace oiler
