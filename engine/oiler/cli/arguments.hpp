// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "oiler/capture/file.hpp"
#include "oiler/cli/command.hpp"

namespace CLI {
class App;
}

namespace oiler::cli {

/// The files and folders of a command line.
struct NamedPaths {
    std::vector<NamedPath> inputs;
    std::vector<NamedPath> outputs;
};

/// Declares the arguments of one command. CLI11 stays behind this class because it takes five
/// seconds to compile: only arguments.cpp includes it.
///
/// A target outlives the parsing and keeps its value when the command line omits the argument.
/// `--help` shows the value of a text or path as its default. `type` is the placeholder of the
/// value in `--help`.
class Arguments {
public:
    explicit Arguments(CLI::App& command) : command_(command) {}

    /// An input file, or a folder of which the command reads the files for which `reads` is true.
    void add_required(const std::string& name, std::filesystem::path& target,
                      const std::string& help, bool (*reads)(std::string_view name) = nullptr);
    /// One or more input files.
    void add_required(const std::string& name, std::vector<std::filesystem::path>& target,
                      const std::string& help);
    /// One word.
    void add_required(const std::string& name, std::string& target, const std::string& help);
    /// Any number of words.
    void add_words(const std::string& name, std::vector<std::string>& target,
                   const std::string& help);

    /// The first word that is no option of the command, and all words after it, also options.
    void add_rest(std::vector<std::string>& target);

    void add_flag(const std::string& name, bool& target, const std::string& help);
    void add_option(const std::string& name, std::string& target, const std::string& type,
                    const std::string& help);
    /// `--NAME FILE`, an output file.
    void add_output(const std::string& name, std::filesystem::path& target, const std::string& help,
                    const FileKind& kind);
    /// `--NAME DIR`, an output folder. `writes` is that of NamedPath.
    void add_output_folder(const std::string& name, std::filesystem::path& target,
                           bool (*writes)(std::string_view name), const std::string& help);
    /// An integer from `low` to `high` in decimal digits.
    void add_integer(const std::string& name, std::int64_t& target, std::int64_t low,
                     std::int64_t high, const std::string& help);
    /// A finite number above 0.
    void add_positive(const std::string& name, std::optional<double>& target,
                      const std::string& type, const std::string& help);
    /// `--damping kick|drift`, as in all games.
    void add_damping(std::string& target);

    /// The current values of the declared inputs and outputs.
    [[nodiscard]] NamedPaths paths() const;

private:
    /// `path` is a NamedPath without its path.
    void add_path(const NamedPath& path, std::filesystem::path& target, const std::string& type,
                  const std::string& help);

    CLI::App& command_;
    std::vector<std::function<void(NamedPaths&)>> paths_;  ///< each adds those of an argument
};

/// A class declares a command with `static constexpr CommandTexts texts`, and either
/// `void declare(Arguments&)` and `Exit run() const`, or `static Exit parse_and_run(int, char**)`.
/// Its file ends with `template Command make_command<ItsClass>();`.
template <class Declared>
Command make_command() {
    if constexpr (requires(char** argv) { Declared::parse_and_run(0, argv); }) {
        return {Declared::texts, {}, Declared::parse_and_run};
    } else {
        return {Declared::texts, [](Arguments& arguments) -> Command::Run {
                    const auto command = std::make_shared<Declared>();
                    command->declare(arguments);
                    return [command] { return command->run(); };
                }};
    }
}

}  // namespace oiler::cli
