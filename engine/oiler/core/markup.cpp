// SPDX-License-Identifier: MIT
#include "oiler/core/markup.hpp"

#include <fmt/core.h>

#include <cstdint>

#include "oiler/core/utf8.hpp"

namespace oiler {
namespace {

std::string base64(const std::vector<std::byte>& bytes) {
    constexpr std::string_view letters =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t three = 0;
        for (std::size_t k = 0; k < 3; ++k)
            three = three << 8 |
                    (i + k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? letters[three >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

/// ASCII with character references, also for the second of two #: a CI takes "##" in a log for the
/// start of a command.
std::string for_xml(std::string_view text) {
    std::string safe;
    for (const char32_t code : decode_utf8(text)) {
        const bool is_control = code < ' ' || (code > '~' && code < 0xA0);
        if (is_control || code == 0xFFFD)
            safe += '?';
        else if (code > '~' || (code == '#' && safe.ends_with('#')))
            safe += fmt::format("&#{};", static_cast<unsigned>(code));
        else
            safe += escaped(std::string(1, static_cast<char>(code)));
    }
    return safe;
}

}  // namespace

std::string escaped(std::string_view text) {
    static const std::map<std::string, std::string> entities{
        {"&", "&amp;"}, {"<", "&lt;"}, {">", "&gt;"}, {"\"", "&quot;"}};
    return fill_in(text, entities);
}

std::string for_script(const Json& json) {
    return fill_in(json.dump(-1, Json::Characters::ascii), {{"<", "\\u003c"}});
}

std::string data_url_of(const std::vector<std::byte>& png) {
    return "data:image/png;base64," + base64(png);
}

std::string fill_in(std::string_view page, const std::map<std::string, std::string>& parts) {
    std::string text;
    while (!page.empty()) {
        std::size_t at = page.npos;
        const std::pair<const std::string, std::string>* found = nullptr;
        for (const auto& part : parts)
            if (const std::size_t here = page.find(part.first); here < at) {
                at = here;
                found = &part;
            }
        text += page.substr(0, at);
        if (!found) break;
        text += found->second;
        page.remove_prefix(at + found->first.size());
    }
    return text;
}

void JunitSuite::add(std::string_view group, std::string_view name, Outcome outcome,
                     std::string_view text) {
    constexpr std::string_view elements[]{"system-out", "failure", "error", "skipped"};
    const auto index = static_cast<std::size_t>(outcome);
    ++counts_[index];
    cases_ +=
        fmt::format("  <testcase classname=\"{}\" name=\"{}\">", for_xml(group), for_xml(name));
    cases_ += outcome == Outcome::passed
                  ? fmt::format("<{0}>{1}</{0}>", elements[index], for_xml(text))
                  : fmt::format("<{} message=\"{}\"/>", elements[index], for_xml(text));
    cases_ += "</testcase>\n";
}

std::string JunitSuite::xml() const {
    const auto [passed, failed, errors, skipped] = counts_;
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"{}\" tests=\"{}\" "
        "failures=\"{}\" errors=\"{}\" skipped=\"{}\">\n{}</testsuite>\n",
        for_xml(name_), passed + failed + errors + skipped, failed, errors, skipped, cases_);
}

}  // namespace oiler
