// SPDX-License-Identifier: MIT
#include "oiler/capture/frame_record.hpp"

#include <libdeflate.h>
#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>

#include "oiler/core/error.hpp"
#include "oiler/core/json.hpp"

namespace oiler {
namespace {

using Parsed = nlohmann::json;

constexpr std::size_t most_bodies_recorded = 1000;
constexpr std::size_t most_points_recorded = 20'000;

Json json_of(Point point) { return Json::array({point.x, point.y}); }

Json json_of(Colour colour) { return Json::array({colour.r, colour.g, colour.b, colour.a}); }

/// In the order of their values.
constexpr std::array space_names{"world",       "canvas",     "upper_left", "top",
                                 "upper_right", "lower_left", "bottom",     "lower_right"};

const char* name_of(Space space) { return space_names[static_cast<std::size_t>(space)]; }

Json json_of(const ElementKey& key) { return Json::array({key.object, key.part, key.jump}); }

/// The members that all kinds of elements share.
template <class Element>
Json json_of_common(const Element& element) {
    Json json{{"key", json_of(element.key)},
              {"space", name_of(element.space)},
              {"colour", json_of(element.colour)}};
    if (element.layer != 0) json["layer"] = element.layer;
    return json;
}

Json json_of(const std::vector<Point>& points) {
    Json json = Json::array();
    for (const Point point : points) {
        json.push_back(point.x);
        json.push_back(point.y);
    }
    return json;
}

/// The texels are not recorded: `bitmap` is their hash.
Json json_of(const Sprite& sprite) {
    Json json = json_of_common(sprite);
    json["centre"] = json_of(sprite.centre);
    json["size"] = json_of(sprite.size);
    json["angle"] = sprite.angle;
    json["smooth"] = sprite.is_smooth;
    json["bitmap"] = sprite.bitmap ? sprite.bitmap->hash : 0;
    if (const auto& part = sprite.part) {
        json["part"] = Json::array();
        for (const int texels : {part->left, part->top, part->size.width, part->size.height})
            json["part"].push_back(texels);
    }
    return json;
}

Json json_of(const Polygon& polygon) {
    Json json = json_of_common(polygon);
    json["points"] = json_of(polygon.points);
    json["outline"] = polygon.outline;
    json["outline_colour"] = json_of(polygon.outline_colour);
    return json;
}

Json json_of(const Polyline& line) {
    Json json = json_of_common(line);
    json["width"] = line.width;
    json["points"] = json_of(line.points);
    return json;
}

Json json_of(const Disc& disc) {
    Json json = json_of_common(disc);
    json["centre"] = json_of(disc.centre);
    json["radius"] = disc.radius;
    return json;
}

Json json_of(const Label& label) {
    Json json = json_of_common(label);
    json["at"] = json_of(label.at);
    json["text"] = label.text;
    json["size"] = label.size;
    json["align"] = static_cast<int>(label.align);
    if (label.size_in != Space::canvas) json["size_in"] = name_of(label.size_in);
    return json;
}

Json json_of(const BodyState& body) {
    Json json = Json::array({body.name});
    for (const auto& vector : {body.position, body.velocity})
        for (const double value : vector) json.push_back(value);
    return json;
}

Json json_of(const ObstacleState& obstacle) {
    Json json{{"name", obstacle.name}, {"shape", obstacle.shape}};
    for (const auto& [name, number] : obstacle.numbers) json[name] = number;
    return json;
}

template <class Element>
Json json_of_all(const std::vector<Element>& elements) {
    return Json::list(elements, [](const Element& element) { return json_of(element); });
}

Json json_of(const Picture& picture) {
    Json json{
        {"background", json_of(picture.background)}, {"centre", json_of(picture.camera.centre)},
        {"height", picture.camera.height},           {"lines", json_of_all(picture.polylines)},
        {"discs", json_of_all(picture.discs)},       {"labels", json_of_all(picture.labels)}};
    if (picture.has_bars) json["bars"] = true;
    if (!picture.sprites.empty()) json["sprites"] = json_of_all(picture.sprites);
    if (!picture.polygons.empty()) json["polygons"] = json_of_all(picture.polygons);
    return json;
}

/// JSON has neither infinities nor NaN: they are null.
template <class Real = float>
Real to_number(const Parsed& json) {
    return json.is_null() ? std::numeric_limits<Real>::quiet_NaN() : json.get<Real>();
}

Point to_point(const Parsed& json) { return {to_number(json.at(0)), to_number(json.at(1))}; }

Colour to_colour(const Parsed& json) { return {json.at(0), json.at(1), json.at(2), json.at(3)}; }

Space to_space(const Parsed& json) {
    const auto found = std::ranges::find(space_names, json.get<std::string_view>());
    return found == space_names.end() ? Space::canvas
                                      : static_cast<Space>(found - space_names.begin());
}

std::vector<Point> to_points(const Parsed& json) {
    std::vector<Point> points;
    for (std::size_t i = 0; i + 1 < json.size(); i += 2)
        points.push_back({to_number(json[i]), to_number(json[i + 1])});
    return points;
}

template <class Element>
Element to_common(const Parsed& json) {
    Element element;
    const Parsed& key = json.at("key");
    element.key = {.object = key.at(0), .part = key.at(1), .jump = key.at(2)};
    element.space = to_space(json.at("space"));
    element.colour = to_colour(json.at("colour"));
    element.layer = json.value("layer", 0);
    return element;
}

Sprite to_sprite(const Parsed& json) {
    auto sprite = to_common<Sprite>(json);
    sprite.centre = to_point(json.at("centre"));
    sprite.size = to_point(json.at("size"));
    sprite.angle = to_number(json.at("angle"));
    sprite.is_smooth = json.at("smooth");
    sprite.bitmap =
        std::make_shared<const Bitmap>(Bitmap{.size = {}, .rgba = {}, .hash = json.at("bitmap")});
    if (json.contains("part")) {
        const Parsed& part = json.at("part");
        sprite.part = BitmapPart{part.at(0), part.at(1), {part.at(2), part.at(3)}};
    }
    return sprite;
}

Polygon to_polygon(const Parsed& json) {
    auto polygon = to_common<Polygon>(json);
    polygon.points = to_points(json.at("points"));
    polygon.outline = to_number(json.at("outline"));
    polygon.outline_colour = to_colour(json.at("outline_colour"));
    return polygon;
}

Polyline to_line(const Parsed& json) {
    auto line = to_common<Polyline>(json);
    line.width = to_number(json.at("width"));
    line.points = to_points(json.at("points"));
    return line;
}

Disc to_disc(const Parsed& json) {
    auto disc = to_common<Disc>(json);
    disc.centre = to_point(json.at("centre"));
    disc.radius = to_number(json.at("radius"));
    return disc;
}

Label to_label(const Parsed& json) {
    auto label = to_common<Label>(json);
    label.at = to_point(json.at("at"));
    label.text = json.at("text");
    label.size = to_number(json.at("size"));
    label.align = static_cast<Align>(json.at("align").get<std::uint8_t>());
    label.size_in = to_space(json.value("size_in", "canvas"));
    return label;
}

BodyState to_body(const Parsed& json) {
    BodyState body{.name = json.at(0)};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        body.position[axis] = to_number<double>(json.at(1 + axis));
        body.velocity[axis] = to_number<double>(json.at(4 + axis));
    }
    return body;
}

ObstacleState to_obstacle(const Parsed& json) {
    ObstacleState obstacle{.name = json.at("name"), .shape = json.at("shape")};
    for (const auto& [name, value] : json.items())
        if (!value.is_string()) obstacle.numbers[name] = to_number<double>(value);
    return obstacle;
}

FrameRecord to_record(const Parsed& json) {
    FrameRecord record{.index = json.at("frame")};
    for (const Parsed& body : json.at("bodies")) record.bodies.push_back(to_body(body));
    if (json.contains("obstacles")) {
        auto& obstacles = record.obstacles.emplace();
        for (const Parsed& one : json.at("obstacles")) obstacles.push_back(to_obstacle(one));
    }
    const Parsed& picture = json.at("picture");
    record.picture.background = to_colour(picture.at("background"));
    record.picture.camera = {to_point(picture.at("centre")), to_number(picture.at("height"))};
    record.picture.has_bars = picture.value("bars", false);
    for (const Parsed& sprite : picture.value("sprites", Parsed::array()))
        record.picture.sprites.push_back(to_sprite(sprite));
    for (const Parsed& polygon : picture.value("polygons", Parsed::array()))
        record.picture.polygons.push_back(to_polygon(polygon));
    for (const Parsed& line : picture.at("lines"))
        record.picture.polylines.push_back(to_line(line));
    for (const Parsed& disc : picture.at("discs")) record.picture.discs.push_back(to_disc(disc));
    for (const Parsed& label : picture.at("labels"))
        record.picture.labels.push_back(to_label(label));
    return record;
}

constexpr std::size_t largest_member = std::size_t{1} << 28;

}  // namespace

bool is_recordable(std::size_t bodies, const Picture& picture) {
    std::size_t points = picture.sprites.size() + picture.discs.size() + picture.labels.size();
    for (const Polygon& polygon : picture.polygons) points += polygon.points.size();
    for (const Polyline& line : picture.polylines) points += line.points.size();
    return bodies <= most_bodies_recorded && points <= most_points_recorded;
}

std::string to_json(const FrameRecord& record) {
    Json json{{"frame", record.index},
              {"bodies", json_of_all(record.bodies)},
              {"picture", json_of(record.picture)}};
    if (record.obstacles) json["obstacles"] = json_of_all(*record.obstacles);
    return json.dump(-1) + "\n";
}

std::vector<FrameRecord> parse_frame_records(std::string_view lines, std::string_view file) try {
    std::vector<FrameRecord> records;
    while (!lines.empty()) {
        const std::size_t end = std::min(lines.find('\n'), lines.size());
        records.push_back(to_record(Parsed::parse(lines.substr(0, end))));
        lines.remove_prefix(std::min(end + 1, lines.size()));
    }
    return records;
} catch (const Parsed::exception& error) {
    fail(Exit::usage, "{}: not the records of a capture ({}); capture again", file, error.what());
}

std::vector<std::byte> gzip(std::string_view text) {
    constexpr int level = 6;
    const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
        libdeflate_alloc_compressor(level), libdeflate_free_compressor);
    if (!compressor) throw std::bad_alloc();
    std::vector<std::byte> bytes(libdeflate_gzip_compress_bound(compressor.get(), text.size()));
    bytes.resize(libdeflate_gzip_compress(compressor.get(), text.data(), text.size(), bytes.data(),
                                          bytes.size()));
    return bytes;
}

std::string gunzip(std::span<const std::byte> bytes, std::string_view file) {
    const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)>
        decompressor(libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
    if (!decompressor) throw std::bad_alloc();
    std::string text;
    std::string member(1 << 16, '\0');
    while (!bytes.empty()) {
        std::size_t read = 0;
        std::size_t written = 0;
        const auto result =
            libdeflate_gzip_decompress_ex(decompressor.get(), bytes.data(), bytes.size(),
                                          member.data(), member.size(), &read, &written);
        if (result == LIBDEFLATE_INSUFFICIENT_SPACE && member.size() < largest_member) {
            member.resize(4 * member.size());
            continue;
        }
        if (result != LIBDEFLATE_SUCCESS)
            fail(Exit::usage, "{}: damaged gzip file; capture again", file);
        text.append(member, 0, written);
        bytes = bytes.subspan(read);
    }
    return text;
}

}  // namespace oiler
