// SPDX-License-Identifier: MIT
#include "oiler/core/utf8.hpp"

#include <fmt/core.h>

namespace oiler {
namespace {

constexpr char32_t replacement = 0xFFFD;

/// The number of bytes that follow a lead byte; -1 for a byte that cannot lead.
int continuation_bytes(unsigned char lead) {
    if (lead < 0x80) return 0;
    if (lead >= 0xC2 && lead < 0xE0) return 1;
    if (lead >= 0xE0 && lead < 0xF0) return 2;
    if (lead >= 0xF0 && lead < 0xF5) return 3;
    return -1;
}

bool well_formed(char32_t code, int continuations) {
    constexpr char32_t least[] = {0, 0x80, 0x800, 0x10000};
    const bool surrogate = code >= 0xD800 && code < 0xE000;
    return code >= least[continuations] && code <= 0x10FFFF && !surrogate;
}

bool is_shown(char32_t code) {
    const bool is_control = code < 0x20 || (code >= 0x7F && code < 0xA0);
    const bool turns_text = (code >= 0x200E && code <= 0x200F) ||
                            (code >= 0x2028 && code <= 0x202E) ||
                            (code >= 0x2066 && code <= 0x2069);
    return !is_control && !turns_text;
}

}  // namespace

char32_t take_code(std::string_view& text) {
    const auto lead = static_cast<unsigned char>(text.front());
    const int more = continuation_bytes(lead);
    text.remove_prefix(1);
    if (more <= 0) return more == 0 ? lead : replacement;
    char32_t code = lead & (0x3FU >> static_cast<unsigned>(more));
    for (int i = 0; i < more; ++i) {
        const auto at = static_cast<std::size_t>(i);
        if (at >= text.size() || (static_cast<unsigned char>(text[at]) & 0xC0U) != 0x80U)
            return replacement;
        code = (code << 6U) | (static_cast<unsigned char>(text[at]) & 0x3FU);
    }
    if (!well_formed(code, more)) return replacement;
    text.remove_prefix(static_cast<std::size_t>(more));
    return code;
}

std::u32string decode_utf8(std::string_view text) {
    std::u32string codes;
    while (!text.empty()) codes.push_back(take_code(text));
    return codes;
}

std::string for_terminal(std::string_view text) {
    std::string safe;
    bool is_start = true;  // of a line, but for spaces of any alphabet
    while (!text.empty()) {
        const std::string_view before = text;
        const char32_t code = take_code(text);
        const std::string_view bytes = before.substr(0, before.size() - text.size());
        const bool is_damaged = code == replacement && bytes.size() == 1;
        const bool is_command = before.starts_with("##") || (is_start && before.starts_with("::"));
        if (is_damaged || (code < 0x100 && code != '\n' && (is_command || !is_shown(code))))
            safe +=
                fmt::format("\\x{:02x}", is_damaged ? static_cast<unsigned char>(bytes[0]) : code);
        else if (code != '\n' && !is_shown(code))
            safe += fmt::format("\\u{:04x}", static_cast<unsigned>(code));
        else
            safe += bytes;
        is_start = code == '\n' || (is_start && (code <= ' ' || code > '~'));
    }
    return safe;
}

bool is_utf8(std::string_view text) {
    while (!text.empty()) {
        const std::size_t before = text.size();
        // A bad byte is replaced alone; the replacement itself has three bytes.
        if (take_code(text) == replacement && before - text.size() == 1) return false;
    }
    return true;
}

}  // namespace oiler
