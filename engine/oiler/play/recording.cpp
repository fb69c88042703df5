// SPDX-License-Identifier: MIT
#include "oiler/play/recording.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "oiler/core/error.hpp"
#include "oiler/core/json.hpp"
#include "oiler/core/state_hash.hpp"
#include "oiler/core/version.hpp"
#include "oiler/sim/bodies.hpp"

namespace oiler {
namespace {

constexpr std::string_view magic = "OILERREC ";
constexpr std::string_view format = "3\n";
// After the kinds of events.
constexpr std::uint8_t state_record = 16;
constexpr std::uint8_t end_record = 17;
constexpr std::uint8_t quit_record = 18;
constexpr std::size_t largest_chunk = 64 * 1024;
constexpr std::size_t seal_size = 8;
constexpr std::size_t chunk_head = 4 + seal_size;
constexpr std::size_t bodies_hashed_per_step = 1000;

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
    Json stepping = to_json(header.stepping);
    return {{"game", header.game},
            {"version", header.version},
            {"method", stepping["method"]},
            {"rate", stepping["rate"]},
            {"precision", stepping["precision"]},
            {"damping", damping_name(header.stepping)},
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
        return {{.positive = buttons_from(json.at("buttons"))}, json.at("action")};
    RecordedControl axis{{.is_axis = true,
                          .negative = buttons_from(json.at("negative")),
                          .positive = buttons_from(json.at("positive"))},
                         json.at("axis")};
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
    stepping.precision = find_precision(std::string(json.at("precision"))).value();
    const std::string damping = json.at("damping");
    if (!damping.empty()) stepping.damping = find_damping(damping).value();
    return header;
}

/// "action fire", "axis aim".
std::vector<std::string> kinds_of(const RecordingHeader& header) {
    std::vector<std::string> kinds;
    for (const RecordedControl& control : header.controls)
        kinds.push_back((control.is_axis ? "axis " : "action ") + control.name);
    return kinds;
}

/// Reads the records of a chunk. Returns an error in them; empty: none.
std::string read_records(std::string_view bytes, Recording& recording, std::int64_t& step) {
    while (!bytes.empty()) {
        if (recording.complete) return "it goes on after its end";
        const auto since = take_number(bytes);
        if (!since || *since > std::uint64_t{1} << 40U || bytes.empty()) return "a step is damaged";
        step += static_cast<std::int64_t>(*since);
        const auto kind = static_cast<std::uint8_t>(bytes.front());
        if (kind >= state_record && kind <= quit_record) {
            bytes.remove_prefix(1);
            if (kind != state_record) {
                recording.complete = true;
                recording.quits = kind == quit_record;
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

/// Reads a file from its start and hashes the bytes read.
class Reader {
public:
    explicit Reader(std::string_view bytes) : rest_(bytes) {}

    [[nodiscard]] std::string_view rest() const { return rest_; }
    std::string_view take(std::size_t count) {
        const std::string_view bytes = rest_.substr(0, count);
        rest_.remove_prefix(bytes.size());
        read_.add(std::as_bytes(std::span(bytes)));
        return bytes;
    }
    /// Takes a seal. Returns whether it is the hash of all bytes before it.
    bool take_seal() {
        const std::uint64_t hash = read_.value();
        std::string_view seal = take(seal_size);
        return take_bytes(seal, seal_size) == hash;
    }

private:
    std::string_view rest_;
    StateHash read_;
};

}  // namespace

RecordingHeader header_of(std::string_view game, const Settings& settings,
                          std::span<const Control> controls) {
    RecordingHeader header{.game = std::string(game),
                           .version = std::string(version()),
                           .stepping = settings.stepping,
                           .seed = settings.seed,
                           .controls = {}};
    for (const Control& control : controls)
        header.controls.push_back({control, std::string(control.name)});
    return header;
}

ChosenControls controls_of(const RecordingHeader& header, std::span<const Control> of_game) {
    auto chosen = std::make_shared<std::vector<Control>>(of_game.begin(), of_game.end());
    for (std::size_t i = 0; i < chosen->size(); ++i)
        static_cast<Binding&>((*chosen)[i]) = header.controls.at(i);
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
      head_(fmt::format("{}{}{}\n", magic, format, to_json(header).dump(-1))),
      steps_per_second_(
          std::max<std::int64_t>(1, header.stepping.rate.steps / header.stepping.rate.seconds)) {
    std::error_code none;
    if (std::filesystem::is_directory(path, none))
        fail(Exit::usage, "--record {}: it is a folder; give a file", path.string());
    require_writable(path);
    const File probe(path, kinds::recording);
    require_replaceable(part_of(std::filesystem::weakly_canonical(path)), kinds::recording);
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
    const auto stride =
        static_cast<std::int64_t>(1 + game.world().body_count() / (bodies_hashed_per_step + 1));
    if (ends_second || (step + 1) % stride == 0) add_hashes(step, game);
    if (ends_second || records_.size() > largest_chunk / 2) write_chunk();
}

void RecordingWriter::add_hashes(std::int64_t step, const AnyGame& game) {
    const PartHashes hashes = part_hashes(game);
    begin_record(step);
    records_.push_back(static_cast<char>(state_record));
    append_bytes(records_, hashes.bodies, 2);
    append_bytes(records_, hashes.whole, 2);
    hashed_step_ = step;
}

void RecordingWriter::finish(std::int64_t steps, const AnyGame& game, bool diverged) {
    if (steps == 0) return;
    const bool quits = game.loop().quits();
    // The update that quits has changed the game since its last step.
    if (!quits && !diverged && hashed_step_ < steps - 1) add_hashes(steps - 1, game);
    begin_record(std::max(steps, last_step_));
    records_.push_back(static_cast<char>(quits ? quit_record : end_record));
    write_chunk();
    file_->commit();
}

void RecordingWriter::write_chunk() {
    const bool is_first = !file_;
    if (is_first) {
        file_.emplace(path_, kinds::recording);
        write(head_);
    }
    std::string size;
    append_bytes(size, records_.size(), 4);
    write(size);
    write_seal();
    write(records_);
    write_seal();
    if (is_first)
        file_->publish();
    else
        file_->flush();
    records_.clear();
}

void RecordingWriter::write(std::string_view bytes) {
    file_->write(bytes);
    written_.add(std::as_bytes(std::span(bytes)));
}

void RecordingWriter::write_seal() {
    std::string seal;
    append_bytes(seal, written_.value(), seal_size);
    write(seal);
}

Recording read_recording(const std::filesystem::path& path) {
    const std::string text = read_text(path);
    const auto refuse = [&](std::string_view why) {
        fail(Exit::usage, "--replay {}: {}", path.string(), why);
    };
    Reader reader(text);
    if (reader.take(magic.size()) != magic) refuse("it is no recording; give a file of --record");
    if (reader.take(format.size()) != format)
        refuse("it has another format; use the Oiler that wrote it");
    Recording recording;
    const std::size_t end_of_header = reader.rest().find('\n');
    try {
        recording.header = header_from(std::string(reader.take(end_of_header)));
    } catch (const std::exception&) {
        refuse("its second line is damaged; record again");
    }
    (void)reader.take(1);
    std::int64_t step = 0;
    while (!reader.rest().empty() && !recording.complete) {
        const auto refuse_damage = [&] {
            refuse(fmt::format("it is damaged after step {}; record again", step));
        };
        if (reader.rest().size() < chunk_head) break;  // its program was killed here, or it was cut
        std::string_view size_bytes = reader.take(4);
        const std::uint64_t size = take_bytes(size_bytes, 4);
        if (!reader.take_seal()) refuse_damage();
        if (reader.rest().size() < size + seal_size) break;
        const std::string_view records = reader.take(size);
        if (!reader.take_seal()) refuse_damage();
        const std::string wrong = read_records(records, recording, step);
        if (!wrong.empty()) refuse(fmt::format("{} after step {}; record again", wrong, step));
    }
    if (recording.complete && !reader.rest().empty())
        refuse("it goes on after its end; record again");
    if (recording.steps == 0) refuse("it ends before its first step; record again");
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
