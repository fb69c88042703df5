// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "oiler/core/json.hpp"

namespace oiler {

// Texts and data in HTML and XML.

/// Escapes a text for an element or for an attribute between double quotes.
[[nodiscard]] std::string escaped(std::string_view text);

/// Writes JSON that cannot end the script element around it.
[[nodiscard]] std::string for_script(const Json& json);

/// Returns the data URL of a PNG file.
[[nodiscard]] std::string data_url_of(const std::vector<std::byte>& png);

/// Replaces each name in the page by its part in one pass, so that names inside of parts stay.
[[nodiscard]] std::string fill_in(std::string_view page,
                                  const std::map<std::string, std::string>& parts);

/// A test suite in JUnit's XML, which CI services read. Texts may be any bytes: characters that XML
/// does not allow become question marks.
class JunitSuite {
public:
    explicit JunitSuite(std::string_view name) : name_(name) {}

    enum class Outcome { passed, failed, error, skipped };

    /// `group` and `name` name the test case. `text` is its output or, unless it passed, the
    /// reason.
    void add(std::string_view group, std::string_view name, Outcome outcome, std::string_view text);

    [[nodiscard]] std::string xml() const;

private:
    std::string name_;
    std::string cases_;
    std::array<int, 4> counts_{};  ///< of each outcome
};

}  // namespace oiler
