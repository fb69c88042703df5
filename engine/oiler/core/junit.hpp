// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace oiler {

/// A test suite in JUnit's XML, which CI services read. Texts may be any bytes: characters that XML
/// does not allow become question marks.
class JunitSuite {
public:
    explicit JunitSuite(std::string_view name) : name_(name) {}

    /// `group` and `name` name the test case.
    void add_passed(std::string_view group, std::string_view name, std::string_view text);
    void add_failed(std::string_view group, std::string_view name, std::string_view message);
    void add_error(std::string_view group, std::string_view name, std::string_view message);
    void add_skipped(std::string_view group, std::string_view name, std::string_view message);

    [[nodiscard]] std::string xml() const;

private:
    void add(std::string_view group, std::string_view name, std::string_view outcome,
             std::string_view message);

    std::string name_;
    std::string cases_;
    int tests_ = 0;
    int failures_ = 0;
    int errors_ = 0;
    int skipped_ = 0;
};

}  // namespace oiler
