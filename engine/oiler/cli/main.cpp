// SPDX-License-Identifier: MIT
#include <span>
#include <string>
#include <vector>

#include "oiler/app/parse.hpp"
#include "oiler/app/run.hpp"
#include "oiler/capture/file.hpp"
#include "oiler/cli/commands.hpp"
#include "oiler/core/version.hpp"

using namespace oiler;

namespace {

/// What several commands read, in words.
struct Words {
    std::vector<std::string> methods;
    std::string damping;
    std::string size = "1280x720";

    [[nodiscard]] std::vector<const Method*> chosen() const {
        std::vector<const Method*> all;
        for (const std::string& name : methods) all.push_back(&find_method(name));
        if (all.empty())
            for (const Method& method : oiler::methods()) all.push_back(&method);
        return all;
    }
    [[nodiscard]] std::optional<Damping> treatment() const {
        if (damping.empty()) return std::nullopt;
        return damping == "kick" ? Damping::in_kick : Damping::in_drift;
    }
};

CLI::App* add_command(CLI::App& app, const std::string& name, const std::string& what,
                      const std::string& example) {
    CLI::App* const command = app.add_subcommand(name, what);
    command->footer("Example: oiler " + name + example);
    return command;
}

void add_methods(CLI::App& command, Words& words) {
    command.add_option("METHOD", words.methods, "which, all if none is given");
}

void add_json(CLI::App& command, std::filesystem::path& path) {
    command.add_option("--json", path, "write it as JSON, - for stdout")->type_name("FILE");
}

void add_quiet(CLI::App& command, bool& quiet) {
    command.add_flag("--quiet", quiet, "no remarks and no progress on standard error")
        ->disable_flag_override();
}

void add_pictures(CLI::App& command, Words& words, std::filesystem::path& out) {
    command.add_option("--out", out, "folder to write into")
        ->type_name("DIR")
        ->capture_default_str();
    command.add_option("--size", words.size, "of pictures in pixels; they are 16:9")
        ->type_name("WxH")
        ->capture_default_str();
}

/// The command line, and what comes of it.
class Program {
public:
    Program() : app_("A fixed timestep, and what it costs", "oiler") {
        app_.set_version_flag("--version", "oiler " + std::string(version()));
        app_.require_subcommand(0, 1);
        // Its options are those of all games, which run_play reads.
        app_.add_subcommand("play", "Play a scene file: in a window, as frames, or as numbers");
        declare_methods();
        declare_certify();
        declare_stability();
        declare_figures();
        declare_ledger();
    }

    Exit run(int argc, char** argv) {
        if (argc > 1 && std::string_view(argv[1]) == "play") return run_play(argc - 1, argv + 1);
        const std::string text = parse(app_, argc, argv);
        if (!text.empty()) {
            write_file("-", std::as_bytes(std::span(text)));
            return Exit::done;
        }
        const auto commands = app_.get_subcommands();
        if (commands.empty())
            fail(Exit::usage,
                 "give a command: play, methods, certify, stability, figures or ledger (see oiler "
                 "--help)");
        return run(commands.front()->get_name());
    }

private:
    void declare_methods() {
        CLI::App* const command =
            add_command(app_, "methods", "List the methods of stepping", " --json methods.json");
        add_json(*command, methods_.json);
    }
    void declare_certify() {
        CLI::App* const command = add_command(
            app_, "certify", "Measure what each method is, exit 1 if not what it claims",
            " velocity_verlet rk4");
        add_methods(*command, words_);
        add_damping(*command, words_.damping);
        add_whole<std::int64_t>(*command, "--steps", certify_.steps, 1000, 1'000'000'000,
                                "of the long run for energy, 1000000 if not given");
        add_json(*command, certify_.json);
        add_quiet(*command, certify_.quiet);
    }
    void declare_stability() {
        CLI::App* const command = add_command(
            app_, "stability", "Simulate where damped springs stay bounded: CSV and PNG",
            " --out stability");
        add_methods(*command, words_);
        add_damping(*command, words_.damping);
        stability_.out = "stability";
        add_pictures(*command, words_, stability_.out);
        add_quiet(*command, stability_.quiet);
    }
    void declare_figures() {
        CLI::App* const command =
            add_command(app_, "figures", "Draw the figures of the article Integration Basics",
                        " --out figures");
        figures_.out = "figures";
        add_pictures(*command, words_, figures_.out);
        add_quiet(*command, figures_.quiet);
    }

    void declare_ledger() {
        CLI::App* const command = add_command(
            app_, "ledger", "Measure what a scene pays for and what that changes",
            " assets/scenes/salvo.toml\n"
            "--json has scene, title, method, rate, precision, axes, bodies, links, steps, looks,\n"
            "timed_steps, bytes_per_body, bytes_per_link, columns, absent, ns_per_body_step,\n"
            "noise_ns, passes (name, ns_per_body_step, saves_ns, saves_percent,\n"
            "changes_position_m, diverges) and flags; null is what could not be measured.");
        command->add_option("SCENE", ledger_.scene, "scene file")->required();
        add_whole<std::int64_t>(*command, "--steps", ledger_.steps, 2, 1'000'000'000,
                                "at most that many, the scene's duration if not given");
        add_json(*command, ledger_.json);
        add_quiet(*command, ledger_.quiet);
    }

    Exit run(const std::string& command) {
        if (command == "methods") return methods_.run();
        if (command == "certify") {
            certify_.methods = words_.chosen();
            certify_.damping = words_.treatment();
            return certify_.run();
        }
        if (command == "stability") {
            stability_.methods = words_.chosen();
            stability_.damping = words_.treatment();
            stability_.size = parse_size(words_.size);
            return stability_.run();
        }
        if (command == "ledger") return ledger_.run();
        figures_.size = parse_size(words_.size);
        return figures_.run();
    }

    CLI::App app_;
    Words words_;
    MethodsCommand methods_;
    CertifyCommand certify_;
    StabilityCommand stability_;
    FiguresCommand figures_;
    LedgerCommand ledger_;
};

}  // namespace

int main(int argc, char** argv) {
    return guard_main("oiler", [&] { return Program().run(argc, argv); });
}
