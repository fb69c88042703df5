// SPDX-License-Identifier: MIT
#include "oiler/app/recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <nlohmann/json.hpp>

#include "oiler/capture/file.hpp"
#include "oiler/core/error.hpp"
#include "oiler/core/json.hpp"
#include "oiler/core/state_hash.hpp"
#include "oiler/core/version.hpp"

namespace oiler {
namespace {

constexpr std::string_view magic = "OILERREC ";
constexpr std::string_view format = "2\n";
// After the kinds of events.
constexpr std::uint8_t state_record = 16;
constexpr std::uint8_t end_record = 17;
constexpr std::size_t largest_chunk = 64 * 1024;
constexpr std::size_t chunk_head = 12;
constexpr std::size_t most_bodies_hashed_each_step = 1000;

void append_bytes(std::string& bytes, std::uint64_t number, unsigned count) {
    for (unsigned i = 0; i < count; ++i)
        bytes.push_back(static_cast<char>(number >> 8 * i & 0xFFU));
}
std::uint64_t take_bytes(std::string_view& bytes, unsigned count) {
    std::uint64_t number = 0;
    for (unsigned i = 0; i < count; ++i)
        number |= std::uint64_t{static_cast<unsigned char>(bytes[i])} << 8 * i;
    bytes.remove_prefix(count);
    return number;
}
std::uint64_t hash_of(std::string_view bytes) {
    StateHash hash;
    hash.add(std::as_bytes(std::span(bytes)));
    return hash.value();
}

Json to_json(const Buttons& buttons) {
    Json names = Json::array();
    for (const Button button : buttons) names.push_back(name_of(button));
    return names;
}
Json to_json(const RecordedControl& control) {
    if (!control.is_axis) return {{"action", control.name}, {"buttons", to_json(control.positive)}};
    return {{"axis", control.name},
            {"negative", to_json(control.negative)},
            {"positive", to_json(control.positive)},
            {"stick", control.stick ? name_of(*control.stick) : ""}};
}
Json to_json(const RecordingHeader& header) {
    Json controls = Json::array();
    for (const RecordedControl& control : header.controls) controls.push_back(to_json(control));
    const Stepping& stepping = header.stepping;
    return {{"game", header.game},
            {"version", header.version},
            {"method", stepping.method->name},
            {"rate", stepping.rate.steps},
            {"precision", name_of(stepping.precision)},
            {"damping", stepping.damping ? name_of(*stepping.damping) : ""},
            {"seed", header.seed},
            {"controls", controls}};
}

Buttons buttons_from(const nlohmann::json& names) {
    if (names.size() > Buttons::most) throw std::invalid_argument("buttons");
    Buttons buttons;
    for (const std::string name : names) buttons.add(find_button(name).value());
    return buttons;
}
RecordedControl control_from(const nlohmann::json& json) {
    if (json.contains("action"))
        return {.name = json.at("action"), .positive = buttons_from(json.at("buttons"))};
    RecordedControl axis{.name = json.at("axis"),
                         .is_axis = true,
                         .negative = buttons_from(json.at("negative")),
                         .positive = buttons_from(json.at("positive"))};
    const std::string stick = json.at("stick");
    if (!stick.empty()) axis.stick = find_stick(stick).value();
    return axis;
}
RecordingHeader header_from(const std::string& line) {
    const auto json = nlohmann::json::parse(line);
    RecordingHeader header{.game = json.at("game"),
                           .version = json.at("version"),
                           .stepping = {},
                           .seed = json.at("seed"),
                           .controls = {}};
    for (const auto& control : json.at("controls"))
        header.controls.push_back(control_from(control));
    Stepping& stepping = header.stepping;
    stepping.method = &find_method(std::string(json.at("method")));
    stepping.rate = {json.at("rate")};
    if (stepping.rate.steps < 1) throw std::invalid_argument("rate");
    stepping.precision = json.at("precision") == "float" ? Precision::single : Precision::double_;
    const std::string damping = json.at("damping");
    if (!damping.empty())
        stepping.damping = damping == "kick" ? Damping::in_kick : Damping::in_drift;
    return header;
}

/// "action fire", "axis aim".
std::vector<std::string> kinds_of(const RecordingHeader& header) {
    std::vector<std::string> kinds;
    for (const RecordedControl& control : header.controls)
        kinds.push_back((control.is_axis ? "axis " : "action ") + control.name);
    return kinds;
}

/// Reads the records of a chunk. Returns what is wrong with them; empty: nothing.
std::string read_records(std::string_view bytes, Recording& recording, std::int64_t& step) {
    while (!bytes.empty()) {
        if (recording.complete) return "it goes on after its end";
        const auto since = take_number(bytes);
        if (!since || *since > std::uint64_t{1} << 40U || bytes.empty()) return "a step is damaged";
        step += static_cast<std::int64_t>(*since);
        const auto kind = static_cast<std::uint8_t>(bytes.front());
        if (kind == state_record || kind == end_record) {
            bytes.remove_prefix(1);
            if (kind == end_record) {
                recording.complete = true;
                recording.steps = step;
                continue;
            }
            if (bytes.size() < 4) return "a hash is damaged";
            const auto bodies = static_cast<std::uint16_t>(take_bytes(bytes, 2));
            const auto whole = static_cast<std::uint16_t>(take_bytes(bytes, 2));
            recording.states[step] = {bodies, whole};
        } else {
            const auto event = take_event(bytes);
            if (!event) return "an event is damaged";
            recording.events.push_back({step, *event});
        }
        recording.steps = step + 1;
    }
    return "";
}

/// An empty file, with its folder.
std::ofstream opened(const std::filesystem::path& path) {
    if (path.has_parent_path()) make_folder(path.parent_path());
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    const int reason = errno;
    if (!file)
        fail(exit_of_open(reason), "--record {}: cannot be written: {}; give another file",
             path.string(), system_reason(reason));
    return file;
}

}  // namespace

RecordingHeader header_of(std::string_view game, const Settings& settings,
                          std::span<const Control> controls) {
    RecordingHeader header{.game = std::string(game),
                           .version = std::string(version()),
                           .stepping = settings.stepping,
                           .seed = settings.seed,
                           .controls = {}};
    for (const Control& control : controls)
        header.controls.push_back({std::string(control.name), control.is_axis, control.negative,
                                   control.positive, control.stick});
    return header;
}

ChosenControls controls_of(const RecordingHeader& header, std::span<const Control> of_game) {
    auto chosen = std::make_shared<std::vector<Control>>(of_game.begin(), of_game.end());
    for (std::size_t i = 0; i < chosen->size(); ++i) {
        const RecordedControl& recorded = header.controls.at(i);
        (*chosen)[i].negative = recorded.negative;
        (*chosen)[i].positive = recorded.positive;
        (*chosen)[i].stick = recorded.stick;
    }
    return chosen;
}

PartHashes part_hashes(const AnyGame& game) {
    StateHash bodies;
    game.world().bodies().hash_into(bodies);
    return {static_cast<std::uint16_t>(bodies.value()),
            static_cast<std::uint16_t>(game.state_hash())};
}

RecordingWriter::RecordingWriter(const std::filesystem::path& path, const RecordingHeader& header)
    : path_(path),
      file_(opened(path)),
      steps_per_second_(
          std::max<std::int64_t>(1, header.stepping.rate.steps / header.stepping.rate.seconds)) {
    file_ << magic << format << to_json(header).dump(-1) << '\n' << std::flush;
}

void RecordingWriter::begin_record(std::int64_t step) {
    append_number(records_, static_cast<std::uint64_t>(step - last_step_));
    last_step_ = step;
}

void RecordingWriter::add(std::int64_t step, const Input& input) {
    for (const InputEvent& event : events_between(before_, input)) {
        begin_record(step);
        append(records_, event);
    }
    before_ = input;
}

void RecordingWriter::add_state(std::int64_t step, const AnyGame& game) {
    const bool ends_second = (step + 1) % steps_per_second_ == 0;
    if (ends_second || game.world().bodies().size() <= most_bodies_hashed_each_step) {
        const PartHashes hashes = part_hashes(game);
        begin_record(step);
        records_.push_back(static_cast<char>(state_record));
        append_bytes(records_, hashes.bodies, 2);
        append_bytes(records_, hashes.whole, 2);
    }
    if (ends_second || records_.size() > largest_chunk / 2) write_chunk();
}

void RecordingWriter::finish(std::int64_t steps) {
    begin_record(std::max(steps, last_step_));
    records_.push_back(static_cast<char>(end_record));
    write_chunk();
}

void RecordingWriter::write_chunk() {
    std::string head;
    append_bytes(head, records_.size(), 4);
    append_bytes(head, hash_of(records_), 8);
    file_ << head << records_ << std::flush;
    if (!file_)
        fail(Exit::io, "--record {}: cannot be written; free disk space, or give another file",
             path_.string());
    records_.clear();
}

Recording read_recording(const std::filesystem::path& path) {
    const std::string text = read_text(path);
    const auto refuse = [&](std::string_view why) {
        fail(Exit::usage, "--replay {}: {}", path.string(), why);
    };
    std::string_view bytes(text);
    if (!bytes.starts_with(magic)) refuse("it is no recording; give a file of --record");
    bytes.remove_prefix(magic.size());
    if (!bytes.starts_with(format)) refuse("it has another format; use the Oiler that wrote it");
    bytes.remove_prefix(format.size());
    Recording recording;
    const std::size_t end_of_header = bytes.find('\n');
    try {
        recording.header = header_from(std::string(bytes.substr(0, end_of_header)));
    } catch (const std::exception&) {
        refuse("its second line is damaged; record again");
    }
    bytes.remove_prefix(std::min(end_of_header, bytes.size() - 1) + 1);
    std::int64_t step = 0;
    while (bytes.size() >= chunk_head) {
        const std::uint64_t size = take_bytes(bytes, 4);
        const std::uint64_t hash = take_bytes(bytes, 8);
        if (size > bytes.size()) break;  // the program was killed here
        if (hash_of(bytes.substr(0, size)) != hash)
            refuse(fmt::format("it is damaged after step {}; record again", step));
        const std::string wrong = read_records(bytes.substr(0, size), recording, step);
        if (!wrong.empty()) refuse(fmt::format("{} after step {}; record again", wrong, step));
        bytes.remove_prefix(size);
        if (recording.complete && !bytes.empty()) refuse("it goes on after its end; record again");
    }
    return recording;
}

void require_same_game(const RecordingHeader& recorded, const RecordingHeader& now,
                       bool other_version_too) {
    if (recorded.game != now.game)
        fail(Exit::usage, "--replay: the recording is of {}, not of {}; run that program",
             recorded.game, now.game);
    if (kinds_of(recorded) != kinds_of(now))
        fail(Exit::usage, "--replay: the game had other actions then: {}; replay it with that game",
             fmt::join(kinds_of(recorded), ", "));
    if (recorded.version != now.version && !other_version_too)
        fail(Exit::usage,
             "--replay: recorded with Oiler {}, this is {}; add --replay-anyway to try it",
             recorded.version, now.version);
}

}  // namespace oiler
