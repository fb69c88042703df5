// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

namespace oiler {

/// A kind of output file. An output replaces files of its own kind only.
struct FileKind {
    std::string_view name;  ///< for messages
    /// The first bytes of all files of this kind: alternatives between '|'; '?' is any byte, and
    /// one '*' any text.
    std::string_view beginnings;
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
    "name": "explicit_euler"|{"displayTimeUnit":"ms","traceEvents":[)"};
inline constexpr FileKind sweep{"a file of oiler tradeoff", "{\n \"oiler\""};
inline constexpr FileKind trace{"a file of --trace", "tick,time,body,"};
inline constexpr FileKind energy{"a file of --energy", "tick,time,kinetic,"};
inline constexpr FileKind table{"a table of Oiler", "method,rate,|method,damping,"};
inline constexpr FileKind junit{"XML", "<?xml|<testsuite"};
inline constexpr FileKind report{
    "a page of oiler report",
    "<!DOCTYPE html>\n<!-- SPDX-License-Identifier: MIT -->\n<!-- The error and the cost of a "
    "scene's timestep. `oiler report`"};
inline constexpr FileKind differences{"a page of differences", "<!-- frames compared by Oiler -->"};
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
