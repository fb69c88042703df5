// SPDX-License-Identifier: MIT
#include "oiler/core/junit.hpp"

#include <fmt/core.h>

#include "oiler/core/markup.hpp"
#include "oiler/core/utf8.hpp"

namespace oiler {
namespace {

/// ASCII with character references.
std::string for_xml(std::string_view text) {
    std::string safe;
    for (const char32_t code : decode_utf8(text)) {
        const bool is_control = code < ' ' || (code > '~' && code < 0xA0);
        if (is_control || code == 0xFFFD)
            safe += '?';
        else if (code > '~')
            safe += fmt::format("&#{};", static_cast<unsigned>(code));
        else
            safe += escaped(std::string(1, static_cast<char>(code)));
    }
    return safe;
}

}  // namespace

void JunitSuite::add(std::string_view group, std::string_view name, std::string_view outcome,
                     std::string_view message) {
    ++tests_;
    cases_ +=
        fmt::format("  <testcase classname=\"{}\" name=\"{}\"><{} message=\"{}\"/></testcase>\n",
                    for_xml(group), for_xml(name), outcome, for_xml(message));
}

void JunitSuite::add_passed(std::string_view group, std::string_view name, std::string_view text) {
    ++tests_;
    cases_ += fmt::format(
        "  <testcase classname=\"{}\" name=\"{}\"><system-out>{}</system-out></testcase>\n",
        for_xml(group), for_xml(name), for_xml(text));
}

void JunitSuite::add_failed(std::string_view group, std::string_view name,
                            std::string_view message) {
    ++failures_;
    add(group, name, "failure", message);
}

void JunitSuite::add_error(std::string_view group, std::string_view name,
                           std::string_view message) {
    ++errors_;
    add(group, name, "error", message);
}

void JunitSuite::add_skipped(std::string_view group, std::string_view name,
                             std::string_view message) {
    ++skipped_;
    add(group, name, "skipped", message);
}

std::string JunitSuite::xml() const {
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"{}\" tests=\"{}\" "
        "failures=\"{}\" errors=\"{}\" skipped=\"{}\">\n{}</testsuite>\n",
        for_xml(name_), tests_, failures_, errors_, skipped_, cases_);
}

}  // namespace oiler
