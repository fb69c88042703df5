// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace oiler {

/// A file or folder that a command line names.
struct NamedPath {
    std::string name;            ///< the option or the argument, for messages
    std::filesystem::path path;  ///< empty: none; "-" of an output: the standard output
    /// Empty for a file. For a folder: whether the command reads or writes a file of that name in
    /// it.
    bool (*uses)(std::string_view name) = nullptr;
};

/// Throws Error{usage} if an output is an input, or if two outputs are one file. Compares files and
/// not names, so that links and relative paths are seen through. The null device may be given
/// several times.
void require_distinct(std::span<const NamedPath> inputs, std::span<const NamedPath> outputs);

/// Throws Error{io} if the file of an output cannot be made in its folder, so that a command fails
/// before its work. Makes neither file nor folder.
void require_openable(const NamedPath& output);

}  // namespace oiler
