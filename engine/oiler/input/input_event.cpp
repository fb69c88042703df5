// SPDX-License-Identifier: MIT
#include "oiler/input/input_event.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>

namespace oiler {
namespace {

using What = InputEvent::What;

constexpr std::uint64_t longest_text = 4096;

std::uint64_t zigzag(std::int64_t number) {
    return (static_cast<std::uint64_t>(number) << 1U) ^ static_cast<std::uint64_t>(number >> 63);
}
std::int64_t unzigzag(std::uint64_t number) {
    return static_cast<std::int64_t>(number >> 1U) ^ -static_cast<std::int64_t>(number & 1U);
}

/// Writes the numbers of an event, or reads them, so that each kind of event lists them once.
/// `good` becomes false if the bytes are not an event.
class Payload {
public:
    explicit Payload(std::string& written) : written_(&written) {}
    explicit Payload(std::string_view& read) : read_(&read) {}

    void natural(std::uint64_t& number, std::uint64_t largest) {
        if (written_) return append_number(*written_, number);
        const auto read = take_number(*read_);
        if (!read || *read > largest) good = false;
        number = good ? *read : 0;
    }
    void whole(std::int64_t& number, std::int64_t largest) {
        std::uint64_t bits = zigzag(number);
        natural(bits, ~std::uint64_t{0});
        number = unzigzag(bits);
        if (read_ && (number < -largest || number > largest)) good = false;
        if (!good) number = 0;
    }
    void real(float& number) {
        auto bits = std::bit_cast<std::uint32_t>(number);
        if (written_)
            for (unsigned shift = 0; shift < 32; shift += 8)
                written_->push_back(static_cast<char>(bits >> shift & 0xFFU));
        else
            number = take_real();
    }
    void text(std::string& text) {
        std::uint64_t size = text.size();
        natural(size, longest_text);
        if (written_) {
            *written_ += text;
            return;
        }
        if (size > read_->size()) good = false;
        if (!good) return;
        text = read_->substr(0, size);
        read_->remove_prefix(size);
    }

    bool good = true;

private:
    float take_real() {
        if (read_->size() < 4) good = false;
        if (!good) return 0;
        std::uint32_t bits = 0;
        for (unsigned i = 0; i < 4; ++i)
            bits |= std::uint32_t{static_cast<unsigned char>((*read_)[i])} << 8 * i;
        read_->remove_prefix(4);
        const auto number = std::bit_cast<float>(bits);
        if (!std::isfinite(number)) good = false;
        return number;
    }

    std::string* written_ = nullptr;
    std::string_view* read_ = nullptr;
};

void transfer_canvas(float& canvas, Payload& payload) {
    constexpr float parts_of_unit = 16;
    constexpr std::int64_t farthest = 1 << 23;  // exact in a float
    std::int64_t parts = std::llround(canvas * parts_of_unit);
    payload.whole(parts, farthest);
    canvas = static_cast<float>(parts) / parts_of_unit;
}

/// A kind of event: its numbers in a file, and its effect on the input of a player.
struct EventKind {
    What what;
    void (*transfer)(InputEvent& event, Payload& payload);
    void (*play)(const InputEvent& event, InputQueue& queue, Camera& camera);
};

/// In the order of What.
constexpr EventKind kinds[]{
    {What::edge,
     [](InputEvent& event, Payload& payload) {
         std::uint64_t number = std::uint64_t{event.button} * 2 + (event.down ? 1 : 0);
         payload.natural(number, 2 * Button::count - 1);
         event.button = static_cast<std::uint16_t>(number / 2);
         event.down = number % 2 == 1;
         if (!Button::of_id(event.button)) payload.good = false;
     },
     [](const InputEvent& event, InputQueue& queue, Camera&) {
         if (const auto button = Button::of_id(event.button)) queue.set(*button, event.down);
     }},
    {What::stick,
     [](InputEvent& event, Payload& payload) {
         std::uint64_t stick = event.stick;
         std::int64_t deflection = event.deflection;
         payload.natural(stick, stick_count - 1);
         payload.whole(deflection, 127);
         event.stick = static_cast<std::uint8_t>(stick);
         event.deflection = static_cast<Deflection>(deflection);
     },
     [](const InputEvent& event, InputQueue& queue, Camera&) {
         queue.deflect(static_cast<Stick>(event.stick), event.deflection);
     }},
    {What::pointer,
     [](InputEvent& event, Payload& payload) {
         transfer_canvas(event.canvas.x, payload);
         transfer_canvas(event.canvas.y, payload);
     },
     [](const InputEvent& event, InputQueue& queue, Camera&) { queue.point_at(event.canvas); }},
    {What::no_pointer, [](InputEvent&, Payload&) {},
     [](const InputEvent&, InputQueue& queue, Camera&) { queue.point_at(std::nullopt); }},
    {What::camera,
     [](InputEvent& event, Payload& payload) {
         payload.real(event.camera.centre.x);
         payload.real(event.camera.centre.y);
         payload.real(event.camera.height);
     },
     [](const InputEvent& event, InputQueue&, Camera& camera) { camera = event.camera; }},
    {What::wheel,
     [](InputEvent& event, Payload& payload) {
         constexpr std::int64_t most_notches = 1'000'000;
         std::int64_t notches = event.notches;
         payload.whole(notches, most_notches);
         event.notches = static_cast<int>(notches);
     },
     [](const InputEvent& event, InputQueue& queue, Camera&) { queue.turn_wheel(event.notches); }},
    {What::text, [](InputEvent& event, Payload& payload) { payload.text(event.text); },
     [](const InputEvent& event, InputQueue& queue, Camera&) { queue.enter(event.text); }},
    {What::restart, [](InputEvent&, Payload&) {},
     [](const InputEvent&, InputQueue& queue, Camera&) { queue.restart(); }},
};
constexpr const EventKind& kind_of(What what) { return kinds[static_cast<std::size_t>(what)]; }
static_assert(std::size(kinds) == InputEvent::what_count && [] {
    return std::ranges::all_of(kinds,
                               [](const EventKind& one) { return &kind_of(one.what) == &one; });
}());

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
    kind_of(event.what).play(event, queue_, camera_);
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
    InputEvent written = event;
    Payload payload(bytes);
    kind_of(event.what).transfer(written, payload);
}

std::optional<InputEvent> take_event(std::string_view& bytes) {
    if (bytes.empty()) return std::nullopt;
    const auto what = static_cast<std::uint8_t>(bytes.front());
    if (what >= InputEvent::what_count) return std::nullopt;
    bytes.remove_prefix(1);
    InputEvent event{.what = static_cast<What>(what)};
    Payload payload(bytes);
    kind_of(event.what).transfer(event, payload);
    return payload.good ? std::optional(event) : std::nullopt;
}

}  // namespace oiler
