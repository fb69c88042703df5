// SPDX-License-Identifier: MIT
#include <charconv>
#include <cmath>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "oiler/app/parse.hpp"
#include "oiler/app/run.hpp"
#include "oiler/capture/file.hpp"
#include "oiler/cli/commands.hpp"
#include "oiler/core/version.hpp"

using namespace oiler;
using namespace oiler::cli;

namespace {

/// What several commands read, in words.
struct Words {
    std::vector<std::string> methods;
    std::string damping;
    std::string size = "1280x720";
    std::string shard;
    std::string rates = "20,30,50,60,100,120,144,240";

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

void add_method_list(CLI::App& command, std::string& words) {
    command.add_option("--methods", words, "splitting, explicit, all, or names with commas")
        ->type_name("LIST");
}

/// A number above 0.
template <class Target>
void add_positive(CLI::App& command, const std::string& name, Target& target,
                  const std::string& type, const std::string& help) {
    command
        .add_option_function<double>(
            name,
            [name, &target](const double& value) {
                if (!(value > 0) || !std::isfinite(value))
                    throw CLI::ValidationError(
                        fmt::format("{} {}: give a number above 0", name, value));
                target = value;
            },
            help)
        ->type_name(type);
}

/// 0 where the words are no whole number.
int parse_part(const std::string& words) {
    int number = 0;
    const char* const end = words.data() + words.size();
    const auto [last, error] = std::from_chars(words.data(), end, number);
    return error == std::errc() && last == end ? number : 0;
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
        declare_tradeoff();
        declare_merge();
        declare_advise();
        declare_rates();
        declare_check();
        declare_report();
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
                 "give a command: play, advise, tradeoff, merge, rates, check, report, ledger, "
                 "methods, "
                 "certify, stability or figures (see oiler --help)");
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

    void declare_measured(CLI::App& command, Measured& measured) {
        command.add_option("SCENE", measured.scene, "scene file")->required();
        add_positive(command, "--duration", measured.duration, "S",
                     "measure so many seconds, the scene's duration if not given");
        add_json(command, measured.json);
        add_quiet(command, measured.quiet);
    }
    void declare_requirements(CLI::App& command, std::optional<double>& position,
                      std::optional<double>& energy) {
        add_positive(command, "--position-error", position, "M",
                     "largest distance from where bodies should be, at most");
        add_positive(command, "--energy-drift", energy, "X", "of the energy, relative, at most");
    }
    void declare_tradeoff() {
        CLI::App* const command = add_command(
            app_, "tradeoff", "Measure error and cost of all methods and rates on a scene",
            " assets/scenes/orbit.toml --out orbit\n"
            "Ctrl-C stops it, the same command goes on. On three machines:\n"
            "  oiler tradeoff SCENE --shard 1/3 --out parts    (2/3 and 3/3 on the others)\n"
            "  oiler merge parts/part-*.json --out whole");
        declare_measured(*command, tradeoff_.measured);
        add_method_list(*command, tradeoff_.methods);
        add_whole<std::int64_t>(
            *command, "--max-rate", tradeoff_.max_rate, 1, 1'000'000,
            "highest but for the scene's own, 1024 times as often as is looked if not given");
        command->add_option("--shard", words_.shard, "measure the Kth of N parts")
            ->type_name("K/N");
        command->add_flag("--all", tradeoff_.all, "print all rows")->disable_flag_override();
        tradeoff_.out = "tradeoff";
        add_pictures(*command, words_, tradeoff_.out);
    }
    void declare_merge() {
        CLI::App* const command =
            add_command(app_, "merge", "Join the parts that tradeoff --shard wrote",
                        " parts/part-*.json --out whole");
        command->add_option("PART", merge_.parts, "what the shards wrote, all of them")->required();
        command->add_flag("--all", merge_.all, "print all rows")->disable_flag_override();
        merge_.out = "tradeoff";
        add_pictures(*command, words_, merge_.out);
        add_json(*command, merge_.json);
        add_quiet(*command, merge_.quiet);
    }
    void declare_advise() {
        CLI::App* const command = add_command(
            app_, "advise", "Find the cheapest timestep and method that are good enough",
            " assets/scenes/orbit.toml --position-error 1e-3\n"
            "Exit 1 where nothing is good enough. With --budget-us alone: the most accurate that\n"
            "fits.");
        declare_measured(*command, advise_.measured);
        declare_requirements(*command, advise_.position_error, advise_.energy_drift);
        add_positive(*command, "--budget-us", advise_.budget_us, "US",
                     "of computing for a frame of 1/60 s, at most");
        add_whole<std::int64_t>(*command, "--min-rate", advise_.min_rate, 1, 1'000'000,
                                "lowest rate, 1 if not given");
        add_method_list(*command, advise_.methods);
        command
            ->add_flag("--apply", advise_.apply_it,
                       "write it into the scene file; its comments stay")
            ->disable_flag_override();
    }
    void declare_rates() {
        CLI::App* const command = add_command(
            app_, "rates", "Measure what a player notices at other rates: jump heights, periods",
            " assets/scenes/jump.toml");
        declare_measured(*command, rates_.measured);
        command->add_option("--rates", words_.rates, "with commas: 20,30,50,60,100,120,144,240")
            ->type_name("LIST");
        add_method_list(*command, rates_.methods);
        command->add_option("--body", rates_.body, "its name, or its number from 0")
            ->type_name("BODY");
    }
    void declare_check() {
        CLI::App* const command =
            add_command(app_, "check", "Hold scenes against their [budget], exit 1 if exceeded",
                        " assets/scenes/*.toml --junit budgets.xml");
        command->add_option("SCENE", check_.scenes, "scene files")->required();
        command->add_option("--junit", check_.junit, "write it for a CI to show, - for stdout")
            ->type_name("FILE");
        add_json(*command, check_.json);
    }
    void declare_report() {
        CLI::App* const command =
            add_command(app_, "report", "Put all of it on one page for a browser",
                        " assets/scenes/orbit.toml --out orbit.html");
        declare_measured(*command, report_.measured);
        declare_requirements(*command, report_.position_error, report_.energy_drift);
        report_.out = "report.html";
        command->add_option("--out", report_.out, "file to write")
            ->type_name("FILE")
            ->capture_default_str();
    }

    Exit run_tradeoff() {
        const std::size_t slash = words_.shard.find('/');
        if (!words_.shard.empty()) {
            tradeoff_.shard = parse_part(words_.shard.substr(0, slash));
            tradeoff_.shards =
                slash == std::string::npos ? 0 : parse_part(words_.shard.substr(slash + 1));
            if (tradeoff_.shard < 1 || tradeoff_.shard > tradeoff_.shards ||
                tradeoff_.shards > 1000)
                fail(Exit::usage, "--shard {}: give K/N, the Kth of N parts, say 1/4",
                     words_.shard);
        }
        tradeoff_.size = parse_size(words_.size);
        return tradeoff_.run();
    }
    Exit run_rates() {
        rates_.rates.clear();
        // A comma at the end would not begin another number for getline.
        std::istringstream stream(words_.rates + ",");
        for (std::string words; std::getline(stream, words, ',');) {
            const int rate = parse_part(words);
            if (rate < 1 || rate > 1'000'000)
                fail(Exit::usage,
                     "--rates {}: give whole numbers from 1 to 1000000 with commas between",
                     words_.rates);
            rates_.rates.push_back(rate);
        }
        return rates_.run();
    }
    Exit run_merge() {
        merge_.size = parse_size(words_.size);
        return merge_.run();
    }

    Exit run(const std::string& command) {
        if (command == "tradeoff") return run_tradeoff();
        if (command == "merge") return run_merge();
        if (command == "advise") return advise_.run();
        if (command == "rates") return run_rates();
        if (command == "check") return check_.run();
        if (command == "report") return report_.run();
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
    TradeoffCommand tradeoff_;
    MergeCommand merge_;
    AdviseCommand advise_;
    RatesCommand rates_;
    CheckCommand check_;
    ReportCommand report_;
};

}  // namespace

int main(int argc, char** argv) {
    return guard_main("oiler", [&] { return Program().run(argc, argv); });
}
