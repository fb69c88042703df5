// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace oiler::bench {

enum class Wanted { at_least, at_most };

/// A target and its measurement.
struct Target {
    std::string id;      ///< "T1"
    std::string what{};  ///< the subject and its size
    double measured = 0;
    std::string unit{};  ///< "ns"; empty for a ratio
    Wanted wanted = Wanted::at_most;
    double limit = 0;
    std::string remark{};  ///< the terms of a ratio, or a peer's additional work

    [[nodiscard]] bool met() const {
        return wanted == Wanted::at_least ? measured >= limit : measured <= limit;
    }
};

/// A row of a table: numbers by the names of their columns.
struct Row {
    std::string name;
    std::vector<std::pair<std::string, double>> numbers;
};

struct Section {
    std::string title;
    std::vector<Row> rows;
};

/// All measurements of a run.
class Report {
public:
    /// A fact about the machine or this run.
    void fact(const std::string& name, const std::string& value);
    /// Adds a missing measurement and its reason.
    void missing(const std::string& line);
    void add(const std::string& section, Row row);
    void target(Target target);

    [[nodiscard]] const std::vector<Section>& sections() const { return sections_; }
    [[nodiscard]] bool empty() const { return sections_.empty() && targets_.empty(); }

    /// The tables, then targets and measurements.
    [[nodiscard]] std::string text() const;
    [[nodiscard]] std::string json() const;

private:
    [[nodiscard]] std::string targets_text() const;

    std::vector<std::pair<std::string, std::string>> facts_;
    std::vector<std::string> missing_;
    std::vector<Section> sections_;
    std::vector<Target> targets_;
};

/// "10⁴", "4·10⁶"; 300 stays "300".
[[nodiscard]] std::string in_powers(std::size_t count);

}  // namespace oiler::bench
