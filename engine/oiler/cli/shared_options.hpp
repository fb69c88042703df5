// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "oiler/cli/arguments.hpp"
#include "oiler/core/size.hpp"
#include "oiler/physics/methods/methods.hpp"
#include "oiler/scene/scene.hpp"

namespace oiler::cli {

// Options that several commands share. An empty path writes no file.

void add_json(Arguments& arguments, std::filesystem::path& target,
              const FileKind& kind = kinds::json);
void add_quiet(Arguments& arguments, bool& target);

/// `--methods`, see parse_methods.
void add_method_list(Arguments& arguments, std::string& target);

/// Returns the methods of groups ("splitting", "explicit", "all") and of names, with commas between
/// them. Throws Error{usage}.
[[nodiscard]] std::vector<const Method*> parse_methods(const std::string& words);

/// The rates in Hz that players and displays commonly have.
[[nodiscard]] std::vector<std::int64_t> usual_rates();

/// Returns the integer in decimal digits, 0 for all other words.
[[nodiscard]] int parse_integer(const std::string& words);

/// The output folder and the size of pictures.
struct PictureOptions {
    std::filesystem::path out;
    std::string size_words = "1280x720";

    /// `writes` is that of NamedPath.
    void declare(
        Arguments& arguments,
        bool (*writes)(std::string_view name) = [](std::string_view) { return true; });
    /// Throws Error{usage}.
    [[nodiscard]] Size size() const;
};

/// The methods and the treatment of damping, without a scene.
struct MethodOptions {
    std::vector<std::string> names;
    std::string damping;

    void declare(Arguments& arguments);
    /// Returns all methods when none is named. Throws Error{usage}.
    [[nodiscard]] std::vector<const Method*> methods() const;
    /// Returns the method's own treatment of damping when none is given.
    [[nodiscard]] Damping damping_of(const Method& method) const;
};

/// The scene that a command measures, and where the results go.
struct SceneOptions {
    std::filesystem::path file;
    std::optional<double> duration;  ///< s; none: the scene's own
    std::filesystem::path json;
    bool quiet = false;

    void declare(Arguments& arguments, const FileKind& kind_of_json = kinds::json);
    /// Reads the scene and sets its duration. Throws Error.
    [[nodiscard]] Scene read() const;
    /// The file's name without .toml.
    [[nodiscard]] std::string name() const { return file.stem().string(); }
};

/// The largest errors that an advice may have.
struct ToleranceOptions {
    std::optional<double> position_error;  ///< m
    std::optional<double> energy_drift;    ///< relative

    void declare(Arguments& arguments);
};

}  // namespace oiler::cli
