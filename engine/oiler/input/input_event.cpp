// SPDX-License-Identifier: MIT
#include "oiler/input/input_event.hpp"

#include <bit>
#include <cmath>

namespace oiler {
namespace {

using What = InputEvent::What;

constexpr float parts_of_unit = 16;
constexpr std::uint64_t longest_text = 4096;
constexpr int most_notches = 1'000'000;
constexpr int farthest_pointer = 1 << 23;  ///< exact in a float

std::uint64_t zigzag(std::int64_t number) {
    return (static_cast<std::uint64_t>(number) << 1U) ^ static_cast<std::uint64_t>(number >> 63);
}
std::int64_t unzigzag(std::uint64_t number) {
    return static_cast<std::int64_t>(number >> 1U) ^ -static_cast<std::int64_t>(number & 1U);
}

void append_float(std::string& bytes, float number) {
    const auto bits = std::bit_cast<std::uint32_t>(number);
    for (unsigned shift = 0; shift < 32; shift += 8)
        bytes.push_back(static_cast<char>(bits >> shift & 0xFFU));
}

/// Reads the payload of an event; `good` ends false if the bytes are not one.
class Reader {
public:
    explicit Reader(std::string_view& bytes) : bytes_(bytes) {}

    std::uint64_t number(std::uint64_t largest) {
        const auto read = take_number(bytes_);
        if (!read || *read > largest) good = false;
        return good ? *read : 0;
    }
    int whole(int largest) {
        const std::int64_t read = unzigzag(number(~std::uint64_t{0}));
        if (read < -largest || read > largest) good = false;
        return good ? static_cast<int>(read) : 0;
    }
    float real() {
        if (bytes_.size() < 4) good = false;
        if (!good) return 0;
        std::uint32_t bits = 0;
        for (unsigned i = 0; i < 4; ++i)
            bits |= std::uint32_t{static_cast<unsigned char>(bytes_[i])} << 8 * i;
        bytes_.remove_prefix(4);
        const auto read = std::bit_cast<float>(bits);
        if (!std::isfinite(read)) good = false;
        return read;
    }
    std::string text() {
        const std::uint64_t size = number(longest_text);
        if (size > bytes_.size()) good = false;
        if (!good) return {};
        std::string read(bytes_.substr(0, size));
        bytes_.remove_prefix(size);
        return read;
    }

    bool good = true;

private:
    std::string_view& bytes_;
};

}  // namespace

std::vector<InputEvent> events_between(const Input& before, const Input& now) {
    std::vector<InputEvent> events;
    if (now.restarts_) events.push_back({.what = What::restart});
    for (const Edge& edge : now.edges_)
        events.push_back({.what = What::edge, .button = edge.button.id(), .down = edge.down});
    for (std::uint8_t i = 0; i < stick_count; ++i)
        if (now.sticks_[i] != before.sticks_[i])
            events.push_back({.what = What::stick, .stick = i, .deflection = now.sticks_[i]});
    if (now.pointer_ != before.pointer_) {
        if (!now.pointer_) {
            events.push_back({.what = What::no_pointer});
        } else {
            if (!before.pointer_ || now.pointer_->camera != before.pointer_->camera)
                events.push_back({.what = What::camera, .camera = now.pointer_->camera});
            events.push_back({.what = What::pointer, .canvas = now.pointer_->canvas});
        }
    }
    if (now.wheel_ != 0) events.push_back({.what = What::wheel, .notches = now.wheel_});
    for (std::size_t at = 0; at < now.text_.size(); at += longest_text)
        events.push_back({.what = What::text, .text = now.text_.substr(at, longest_text)});
    return events;
}

void EventPlayer::play(const InputEvent& event) {
    switch (event.what) {
        case What::edge:
            if (const auto button = Button::of_id(event.button)) queue_.set(*button, event.down);
            return;
        case What::stick:
            return queue_.deflect(static_cast<Stick>(event.stick), event.deflection);
        case What::pointer:
            return queue_.point_at(event.canvas);
        case What::no_pointer:
            return queue_.point_at(std::nullopt);
        case What::camera:
            camera_ = event.camera;
            return;
        case What::wheel:
            return queue_.turn_wheel(event.notches);
        case What::text:
            return queue_.enter(event.text);
        case What::restart:
            return queue_.restart();
    }
}

void append_number(std::string& bytes, std::uint64_t number) {
    for (; number >= 0x80; number >>= 7U)
        bytes.push_back(static_cast<char>(0x80U | (number & 0x7FU)));
    bytes.push_back(static_cast<char>(number));
}

std::optional<std::uint64_t> take_number(std::string_view& bytes) {
    std::uint64_t number = 0;
    for (unsigned shift = 0; shift < 64 && !bytes.empty(); shift += 7) {
        const auto byte = static_cast<unsigned char>(bytes.front());
        bytes.remove_prefix(1);
        const std::uint64_t group = byte & 0x7FU;
        // Neither bits beyond 64 nor a longer form than needed.
        if (shift == 63 && group > 1) return std::nullopt;
        if (shift > 0 && byte == 0) return std::nullopt;
        number |= group << shift;
        if (byte < 0x80) return number;
    }
    return std::nullopt;
}

void append(std::string& bytes, const InputEvent& event) {
    bytes.push_back(static_cast<char>(event.what));
    switch (event.what) {
        case What::edge:
            return append_number(bytes, std::uint64_t{event.button} * 2 + (event.down ? 1 : 0));
        case What::stick:
            append_number(bytes, event.stick);
            return append_number(bytes, zigzag(event.deflection));
        case What::pointer:
            append_number(bytes, zigzag(std::llround(event.canvas.x * parts_of_unit)));
            return append_number(bytes, zigzag(std::llround(event.canvas.y * parts_of_unit)));
        case What::camera:
            append_float(bytes, event.camera.centre.x);
            append_float(bytes, event.camera.centre.y);
            return append_float(bytes, event.camera.height);
        case What::wheel:
            return append_number(bytes, zigzag(event.notches));
        case What::text:
            append_number(bytes, event.text.size());
            bytes += event.text;
            return;
        case What::no_pointer:
        case What::restart:
            return;
    }
}

std::optional<InputEvent> take_event(std::string_view& bytes) {
    if (bytes.empty()) return std::nullopt;
    const auto what = static_cast<std::uint8_t>(bytes.front());
    if (what >= InputEvent::what_count) return std::nullopt;
    bytes.remove_prefix(1);
    InputEvent event{.what = static_cast<What>(what)};
    Reader reader(bytes);
    switch (event.what) {
        case What::edge: {
            const std::uint64_t edge = reader.number(2 * Button::count - 1);
            event.button = static_cast<std::uint16_t>(edge / 2);
            event.down = edge % 2 == 1;
            if (!Button::of_id(event.button)) reader.good = false;
            break;
        }
        case What::stick: {
            event.stick = static_cast<std::uint8_t>(reader.number(stick_count - 1));
            event.deflection = static_cast<Deflection>(reader.whole(127));
            break;
        }
        case What::pointer:
            event.canvas.x = static_cast<float>(reader.whole(farthest_pointer)) / parts_of_unit;
            event.canvas.y = static_cast<float>(reader.whole(farthest_pointer)) / parts_of_unit;
            break;
        case What::camera:
            event.camera.centre.x = reader.real();
            event.camera.centre.y = reader.real();
            event.camera.height = reader.real();
            break;
        case What::wheel:
            event.notches = reader.whole(most_notches);
            break;
        case What::text:
            event.text = reader.text();
            break;
        case What::no_pointer:
        case What::restart:
            break;
    }
    return reader.good ? std::optional(event) : std::nullopt;
}

}  // namespace oiler
