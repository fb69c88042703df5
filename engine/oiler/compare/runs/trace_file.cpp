// SPDX-License-Identifier: MIT
#include "oiler/compare/runs/state_log.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "oiler/core/error.hpp"
#include "oiler/core/read_number.hpp"

namespace oiler {
namespace {

/// Reads a text file line by line: files may be larger than the memory, or pipes.
class LineReader {
public:
    /// Throws Error if the file cannot be read, as next() does: see exit_of_open().
    explicit LineReader(const std::filesystem::path& path) : path_(path), file_(path) {
        if (!file_) fail_read();
    }

    /// The next line without its line end; empty after the last one. It is valid until the next
    /// call.
    [[nodiscard]] std::optional<std::string_view> next() {
        if (!file_) return std::nullopt;
        file_.getline(line_.data(), std::ssize(line_));
        if (file_.bad()) fail_read();
        if (file_.gcount() == 0) return std::nullopt;
        ++number_;
        const std::streamsize ending = ended() ? 1 : 0;
        return std::string_view(line_.data(), std::size_t(file_.gcount() - ending));
    }

    /// The number of the line that next() returned, from 1.
    [[nodiscard]] std::int64_t number() const { return number_; }
    /// Whether that line has a line end. Without one, the file ends there or the line is longer
    /// than a MiB.
    [[nodiscard]] bool ended() const { return file_.good(); }

private:
    [[noreturn]] void fail_read() const {
        const int reason = errno;
        fail(exit_of_open(reason), "{}: cannot be read: {}", path_.string(), system_reason(reason));
    }

    std::filesystem::path path_;
    std::ifstream file_;
    std::vector<char> line_ = std::vector<char>(std::size_t{1} << 20);
    std::int64_t number_ = 0;
};

constexpr std::array<std::string_view, 3> headers{"tick,time,body,x,vx", "tick,time,body,x,y,vx,vy",
                                                  "tick,time,body,x,y,z,vx,vy,vz"};
constexpr std::size_t columns_before_values = 3;

/// The start of a text, with ? for all but printable ASCII characters, for messages.
std::string shown(std::string_view text) {
    constexpr std::size_t most = 60;
    std::string start(text.substr(0, most));
    for (char& c : start)
        if (c < ' ' || c > '~') c = '?';
    return text.size() > most ? start + "…" : start;
}

/// Returns whether the value is the shortest decimal that reads back to the same float.
bool is_shortest_float(double value) {
    const auto number = static_cast<float>(value);
    if (!std::isfinite(number)) return false;
    std::array<char, 32> digits;
    const char* const end = std::to_chars(digits.data(), digits.data() + digits.size(), number,
                                          std::chars_format::scientific)
                                .ptr;
    double again = 0;
    read_number(digits.data(), end, again);
    return again == value;
}

/// The cells of a row, from the first one.
class Cells {
public:
    explicit Cells(std::string_view row) : at_(row.data()), end_(row.data() + row.size()) {}

    /// Reads a number that fills the next cell. Returns false if it does not.
    template <class Number>
    [[nodiscard]] bool read(Number& number) {
        if (at_ == nullptr) return false;
        const auto [after, error] = read_number(at_, end_, number);
        if (error != std::errc{} || (after != end_ && *after != ',')) return false;
        at_ = after == end_ ? nullptr : after + 1;
        return true;
    }
    [[nodiscard]] bool read_finite(double& number) { return read(number) && std::isfinite(number); }
    [[nodiscard]] bool at_end() const { return at_ == nullptr; }

private:
    const char* at_;  ///< null after the last cell
    const char* end_;
};

std::string_view cell_of(std::string_view row, std::size_t column) {
    for (; column > 0; --column) row.remove_prefix(row.find(',') + 1);
    return row.substr(0, row.find(','));
}

std::size_t count_columns(std::string_view row) {
    return static_cast<std::size_t>(std::ranges::count(row, ',')) + 1;
}

class TraceReader {
public:
    explicit TraceReader(const std::filesystem::path& path) : path_(path), lines_(path) {
        log_.name = path.string();
    }

    [[nodiscard]] StateLog read() {
        read_header();
        while (const auto line = next_line()) {
            read_row(*line);
            bytes_ += line->size() + 1;
            if (log_.bodies.size() == rows_of_estimate) reserve();
        }
        if (log_.ticks.empty()) refuse(2, "expected a row of numbers, got the end of the file");
        finish_tick();
        return std::move(log_);
    }

private:
    template <class... Args>
    [[noreturn]] void refuse(std::int64_t line, fmt::format_string<Args...> text,
                             Args&&... args) const {
        fail(Exit::usage, "{}:{}: {}", log_.name, line,
             fmt::format(text, std::forward<Args>(args)...));
    }

    std::optional<std::string_view> next_line() {
        const std::optional<std::string_view> line = lines_.next();
        if (line && !lines_.ended())
            refuse(lines_.number(), "expected a complete line, got `{}`; the file may be truncated",
                   shown(*line));
        return line;
    }

    /// Allocates memory for the rows of the whole file. Growing step by step takes up to a third of
    /// the time.
    void reserve() {
        std::error_code not_a_file;
        const std::uintmax_t size = std::filesystem::file_size(path_, not_a_file);
        if (not_a_file) return;
        const auto rows = static_cast<std::size_t>(size / (bytes_ / rows_of_estimate));
        log_.bodies.reserve(rows);
        log_.values.reserve(rows * log_.width());
    }

    void read_header() {
        const std::string_view header = next_line().value_or("");
        const auto found = std::ranges::find(headers, header);
        if (found == headers.end())
            refuse(1, "expected the header of a trace, for example `{}`, got `{}`", headers[1],
                   shown(header));
        log_.axes = static_cast<int>(found - headers.begin()) + 1;
        header_ = *found;
    }

    void read_row(std::string_view row) {
        StateLog::Tick tick{.first_row = log_.bodies.size()};
        std::uint32_t body = 0;
        Cells cells(row);
        if (!cells.read(tick.tick) || tick.tick < 0) refuse_cell(row, 0);
        if (!cells.read_finite(tick.time)) refuse_cell(row, 1);
        if (!cells.read(body)) refuse_cell(row, 2);
        read_values(row, cells);
        if (!cells.at_end()) refuse_columns(row);
        if (log_.ticks.empty() || tick.tick != log_.ticks.back().tick)
            start_tick(tick);
        else if (tick.time != log_.ticks.back().time)
            refuse(lines_.number(), "time: expected {} as in the row above, got {}",
                   log_.ticks.back().time, tick.time);
        else if (body <= log_.bodies.back())
            sorted_ = false;
        log_.bodies.push_back(body);
    }

    void read_values(std::string_view row, Cells& cells) {
        for (std::size_t i = 0; i < log_.width(); ++i) {
            double value = 0;
            if (!cells.read_finite(value)) refuse_cell(row, columns_before_values + i);
            log_.floats = log_.floats && is_shortest_float(value);
            log_.values.push_back(value);
        }
    }

    [[noreturn]] void refuse_columns(std::string_view row) const {
        refuse(lines_.number(), "expected {} columns, got {}", count_columns(header_),
               count_columns(row));
    }

    [[noreturn]] void refuse_cell(std::string_view row, std::size_t column) const {
        if (count_columns(row) != count_columns(header_)) refuse_columns(row);
        const bool whole = column == 0 || column == 2;
        refuse(lines_.number(), "{}: expected {}, got `{}`", cell_of(header_, column),
               whole ? "a whole number, 0 or more" : "a finite number",
               shown(cell_of(row, column)));
    }

    void start_tick(const StateLog::Tick& tick) {
        if (!log_.ticks.empty()) {
            const StateLog::Tick& before = log_.ticks.back();
            if (tick.tick < before.tick)
                refuse(lines_.number(), "tick: expected {} or a later one, got {}", before.tick,
                       tick.tick);
            if (!(tick.time > before.time))
                refuse(lines_.number(), "time: expected more than the {} of tick {}, got {}",
                       before.time, before.tick, tick.time);
            finish_tick();
        }
        log_.ticks.push_back(tick);
    }

    /// Sorts the rows of the last tick by body.
    void finish_tick() {
        if (sorted_) return;
        const std::size_t first = log_.ticks.back().first_row;
        const auto body_of = [&](std::size_t row) { return log_.bodies[row]; };
        std::vector<std::size_t> rows(log_.bodies.size() - first);
        std::iota(rows.begin(), rows.end(), first);
        std::ranges::stable_sort(rows, {}, body_of);
        const auto doubled = std::ranges::adjacent_find(rows, {}, body_of);
        if (doubled != rows.end())
            refuse(static_cast<std::int64_t>(doubled[1]) + 2,
                   "expected one row of body {} in tick {}, got two", body_of(*doubled),
                   log_.ticks.back().tick);
        reorder(first, rows);
        sorted_ = true;
    }

    void reorder(std::size_t first, const std::vector<std::size_t>& rows) {
        std::vector<std::uint32_t> bodies;
        std::vector<double> values;
        for (const std::size_t row : rows) {
            bodies.push_back(log_.bodies[row]);
            const std::span<const double> numbers = std::as_const(log_).row(row);
            values.insert(values.end(), numbers.begin(), numbers.end());
        }
        std::ranges::copy(bodies, log_.bodies.begin() + static_cast<std::ptrdiff_t>(first));
        std::ranges::copy(values,
                          log_.values.begin() + static_cast<std::ptrdiff_t>(first * log_.width()));
    }

    static constexpr std::size_t rows_of_estimate = 1000;

    std::filesystem::path path_;
    LineReader lines_;
    std::size_t bytes_ = 0;  ///< of the rows read
    StateLog log_;
    std::string_view header_;
    bool sorted_ = true;  ///< whether the rows of the last tick ascend by body
};

}  // namespace

StateLog read_trace(const std::filesystem::path& path) { return TraceReader(path).read(); }

}  // namespace oiler
