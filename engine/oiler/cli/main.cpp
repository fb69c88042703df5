// SPDX-License-Identifier: MIT
#include "oiler/app/run.hpp"
#include "oiler/cli/command.hpp"

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

}  // namespace oiler::cli

int main(int argc, char** argv) {
    using namespace oiler;
    return guard_main("oiler",
                      [&] { return cli::run_command(cli::AllCommands::make(), argc, argv); });
}
