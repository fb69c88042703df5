// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

namespace oiler {

/// The form of a whole file.
enum class Form {
    any,
    json,     ///< one value (RFC 8259)
    numbers,  ///< a line of names, and rows with as many numbers
    table,    ///< the same, but fields may be words or empty
};

/// A kind of output file. An output replaces files of its own kind only.
struct FileKind {
    std::string_view name;  ///< for messages
    /// The first bytes of all files of this kind: alternatives between '|'; '?' is any byte, and
    /// one '*' any text within a line.
    std::string_view beginnings;
    Form form = Form::any;
    std::string_view ending = "";  ///< the last bytes
};

namespace kinds {

inline constexpr FileKind any{"a file", ""};
/// The first keys that each command writes.
inline constexpr FileKind json{"JSON of Oiler", R"({
  "scene": "*",
  "method": "|{
  "scene": "*",
  "time": |{
  "scene": "*",
  "title": "|[
  {
    "scene": "*",
    "kept": |[
  {
    "scene": "*",
    "error": |{
  "meets": |{
  "tradeoff": {|{
  "rates": [|{
  "golden": "*",
  "actual": "|{
  "same": |[
  {
    "method": "*",
    "damping": |[
  {
    "name": "explicit_euler"|{"displayTimeUnit":"ms","traceEvents":[)",
                               Form::json};
inline constexpr FileKind sweep{"a file of oiler tradeoff", "{\n \"oiler\"", Form::json};
inline constexpr FileKind trace{"a file of --trace",
                                "tick,time,body,x,vx\n|tick,time,body,x,y,vx,vy\n|"
                                "tick,time,body,x,y,z,vx,vy,vz\n",
                                Form::numbers};
inline constexpr FileKind energy{"a file of --energy", "tick,time,kinetic,potential,total\n",
                                 Form::numbers};
inline constexpr FileKind table{
    "a table of Oiler",
    "method,rate,precision,stable,below_floor,pareto,position_error,step_error,velocity_error,"
    "phase_error,energy_drift,evaluations,ns_per_second,ns_spread,ns_worst_frame,ns_together\n|"
    "method,damping,omega_dt,zeta,spectral_radius,stable,bounded_double,bounded_float\n",
    Form::table};
inline constexpr FileKind junit{"XML of Oiler",
                                "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"",
                                Form::any, "</testsuite>\n"};
inline constexpr FileKind report{
    "a page of oiler report",
    "<!DOCTYPE html>\n<!-- SPDX-License-Identifier: MIT -->\n<!-- The error and the cost of a "
    "scene's timestep. `oiler report`",
    Form::any, "</html>\n"};
inline constexpr FileKind differences{"a page of differences", "<!-- frames compared by Oiler -->",
                                      Form::any, "</html>\n"};
inline constexpr FileKind recording{"a recording", "OILERREC "};
inline constexpr FileKind png{"a PNG", "\x89PNG\r\n\x1a\n"};
inline constexpr FileKind video{"a video", "????ftyp|GIF8|\x89PNG\r\n\x1a\n"};

}  // namespace kinds

/// Whether the file is missing, empty, not a regular file, or of the kind. Throws Error{io} if it
/// cannot be read.
[[nodiscard]] bool is_replaceable(const std::filesystem::path& path, const FileKind& kind);
/// Throws Error{usage} unless the file is replaceable by one of the kind.
void require_replaceable(const std::filesystem::path& path, const FileKind& kind);

}  // namespace oiler
