// SPDX-License-Identifier: MIT
#include "oiler/cli/arguments.hpp"

#include <charconv>
#include <cmath>
#include <map>

#include "oiler/cli/output.hpp"
#include "oiler/core/read_number.hpp"
#include "oiler/core/version.hpp"
#include "oiler/process/interrupt.hpp"
#include "oiler/process/parse.hpp"

namespace oiler::cli {
namespace {

/// The unit of a number, by the placeholder of its option.
std::string_view unit_of(std::string_view type) {
    if (type == "M") return "in m, ";
    if (type == "S") return "in s, ";
    if (type == "US") return "in µs, ";
    return "";
}

/// Declares each command as a subcommand; returns their functions by name.
std::map<std::string, Command::Run> declare(CLI::App& app, const std::vector<Command>& commands) {
    std::map<std::string, Command::Run> runs;
    for (const Command& command : commands) {
        const CommandTexts& texts = command.texts;
        const std::string name(texts.name);
        CLI::App* const subcommand = app.add_subcommand(name, std::string(texts.summary));
        subcommand->footer(fmt::format("Example: oiler {} {}{}{}", name, texts.example,
                                       texts.notes.empty() ? "" : "\n", texts.notes));
        Arguments arguments(*subcommand);
        if (!command.declare) continue;
        const Command::Run run = command.declare(arguments);
        const auto limit = std::make_shared<std::optional<double>>();
        if (texts.may_take_long)
            add_seconds(*subcommand, "--time-limit", *limit, help_of_time_limit);
        runs[name] = [run, arguments, limit] {
            if (*limit) Interrupt::set_time_limit(**limit);
            const NamedPaths paths = arguments.paths();
            require_distinct(paths.inputs, paths.outputs);
            for (const NamedPath& output : paths.outputs) require_openable(output);
            return run();
        };
    }
    return runs;
}

/// "play, methods or certify".
std::string names_of(const std::vector<Command>& commands) {
    std::string names;
    for (const Command& command : commands) {
        if (!names.empty()) names += &command == &commands.back() ? " or " : ", ";
        names += command.texts.name;
    }
    return names;
}

}  // namespace

void Arguments::add_required(const std::string& name, std::filesystem::path& target,
                             const std::string& help, bool (*reads)(std::string_view name)) {
    command_.add_option(name, target, help)->required();
    paths_.emplace_back([name, &target, reads](NamedPaths& all) {
        all.inputs.push_back({name, target, reads});
    });
}

void Arguments::add_required(const std::string& name, std::vector<std::filesystem::path>& target,
                             const std::string& help) {
    command_.add_option(name, target, help)->required();
    paths_.emplace_back([name, &target](NamedPaths& all) {
        for (const std::filesystem::path& path : target) all.inputs.push_back({name, path});
    });
}

void Arguments::add_required(const std::string& name, std::string& target,
                             const std::string& help) {
    command_.add_option(name, target, help)->required();
}

void Arguments::add_words(const std::string& name, std::vector<std::string>& target,
                          const std::string& help) {
    command_.add_option(name, target, help);
}

void Arguments::add_rest(std::vector<std::string>& target) {
    command_.prefix_command();
    command_.parse_complete_callback([&command = command_, &target] {
        target = command.remaining();
        if (!target.empty() && target.front().starts_with("-"))
            throw CLI::ExtrasError(command.get_name(), target);
    });
}

void Arguments::add_flag(const std::string& name, bool& target, const std::string& help) {
    command_.add_flag(name, target, help)->disable_flag_override();
}

void Arguments::add_option(const std::string& name, std::string& target, const std::string& type,
                           const std::string& help) {
    command_.add_option(name, target, help)->type_name(type)->default_str(target);
}

void Arguments::add_output(const std::string& name, std::filesystem::path& target,
                           const std::string& help, const FileKind& kind) {
    add_path({.name = name, .path = {}, .kind = &kind}, target, "FILE", help);
}

void Arguments::add_output_folder(const std::string& name, std::filesystem::path& target,
                                  bool (*writes)(std::string_view name), const std::string& help) {
    add_path({.name = name, .path = {}, .uses = writes}, target, "DIR", help);
}

void Arguments::add_path(const NamedPath& path, std::filesystem::path& target,
                         const std::string& type, const std::string& help) {
    const auto set = [name = path.name, &target](const std::string& given) {
        if (given.empty()) throw CLI::ValidationError(name + ": give a path");
        target = given;
    };
    command_.add_option_function<std::string>(path.name, set, help)
        ->type_name(type)
        ->default_str(target.string());
    paths_.emplace_back(
        [path, &target](NamedPaths& all) { (all.outputs.emplace_back(path)).path = target; });
}

NamedPaths Arguments::paths() const {
    NamedPaths all;
    for (const auto& add : paths_) add(all);
    return all;
}

void Arguments::add_integer(const std::string& name, std::int64_t& target, std::int64_t low,
                            std::int64_t high, const std::string& help) {
    add_whole<std::int64_t>(command_, name, target, low, high, help);
}

void Arguments::add_positive(const std::string& name, std::optional<double>& target,
                             const std::string& type, const std::string& help) {
    const auto set = [name, type, &target](const std::string& words) {
        const char* const end = words.data() + words.size();
        double value = 0;
        const auto [last, error] = read_number(words.data(), end, value);
        if (error != std::errc() || last != end || !(value > 0) || !std::isfinite(value))
            throw CLI::ValidationError(fmt::format("{} {}: give a number above 0, {}such as 0.01",
                                                   name, words, unit_of(type)));
        target = value;
    };
    command_.add_option_function<std::string>(name, set, help)->type_name(type);
}

void Arguments::add_damping(std::string& target) { oiler::add_damping(command_, target); }

Exit run_command(const std::vector<Command>& commands, int argc, char** argv) {
    const std::string_view first = argc > 1 ? argv[1] : "";
    for (const Command& command : commands)
        if (command.parse_and_run && command.texts.name == first)
            return command.parse_and_run(argc - 1, argv + 1);
    CLI::App app("Plays scenes at a fixed timestep and measures its error and cost", "oiler");
    app.set_version_flag("--version", "oiler " + std::string(version()));
    app.require_subcommand(0, 1);
    const std::map<std::string, Command::Run> runs = declare(app, commands);
    if (const std::string text = parse(app, argc, argv); !text.empty()) {
        print(text);
        return Exit::done;
    }
    const auto chosen = app.get_subcommands();
    if (chosen.empty())
        fail(Exit::usage,
             "give a command: {} (see oiler --help); `oiler demos` lists games and scenes to start",
             names_of(commands));
    return runs.at(chosen.front()->get_name())();
}

}  // namespace oiler::cli
