// SPDX-License-Identifier: MIT
#include <string>
#include <vector>

#include "oiler/cli/command.hpp"
#include "oiler/platform/surface.hpp"
#include "oiler/process/interrupt.hpp"

namespace oiler::cli {

template <class... Declared>
struct CommandList {
    [[nodiscard]] static std::vector<Command> make() { return {make_command<Declared>()...}; }
};

/// The commands in the order of `oiler --help`. Each class is in the file of its command.
using AllCommands = CommandList<
    struct PlayCommand, struct MethodsCommand, struct CertifyCommand, struct StabilityCommand,
    struct FiguresCommand, struct LedgerCommand, struct TradeoffCommand, struct MergeCommand,
    struct AdviseCommand, struct RatesCommand, struct CheckCommand, struct ReportCommand,
    struct CompareCommand, struct DivergeCommand, struct DemosCommand, struct NewCommand>;

namespace {

/// `oiler` alone opens the menu of demos if a window can be opened; else it is refused with the
/// list of commands.
Exit run_alone(const std::vector<Command>& commands, int argc, char** argv) {
    std::string name = "oiler", demos = "demos", window = "--window";
    char* const words[] = {name.data(), demos.data(), window.data(), nullptr};
    try {
        return run_command(commands, 3, const_cast<char**>(words));
    } catch (const Error& error) {
        if (error.exit() != Exit::no_display && error.exit() != Exit::usage) throw;
        return run_command(commands, argc, argv);
    }
}

}  // namespace
}  // namespace oiler::cli

int main(int argc, char** argv) {
    using namespace oiler;
    return guard_main("oiler", [&] {
        const std::vector<cli::Command> commands = cli::AllCommands::make();
        return argc == 1 && has_display() ? cli::run_alone(commands, argc, argv)
                                          : cli::run_command(commands, argc, argv);
    });
}
