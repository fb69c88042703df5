// SPDX-License-Identifier: MIT
#include <stdlib.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <thread>

#include "bench/bench.hpp"
#include "bench/plots.hpp"
#include "oiler/capture/file.hpp"
#include "oiler/core/version.hpp"
#include "oiler/process/console.hpp"
#include "oiler/process/interrupt.hpp"
#include "oiler/process/parse.hpp"

namespace oiler::bench {

bool Bench::wants(std::string_view name) const {
    if (!only.empty() && !std::regex_search(name.begin(), name.end(), std::regex(only)))
        return false;
    remark(quiet, "{}", name);
    return true;
}

namespace {

struct Words {
    std::string json;
    std::string plot;
    std::string isa;
};

void choose_isa(Bench& bench, const std::string& isa) {
    const std::vector<Limits> supported = supported_limits();
    bench.limits = supported.back();
    if (isa.empty()) return;
    const auto found = std::ranges::find(supported, isa, &Limits::isa);
    if (found == supported.end()) fail(Exit::usage, "--isa {}: not supported by this machine", isa);
    bench.limits = *found;
    const std::string kernels = isa == "SSE2" ? "baseline" : isa == "AVX2" ? "avx2" : "avx512";
    setenv("OILER_INSTRUCTIONS", kernels.c_str(), 1);
}

void declare(CLI::App& app, Bench& bench, Words& words) {
    app.add_flag("--full", bench.full, "the campaign: all sizes up to 10⁷, longer measurements");
    app.add_flag("--all", bench.all_methods, "all methods instead of some");
    app.add_option("--only", bench.only, "measure only names that match this regular expression")
        ->type_name("REGEX");
    app.add_flag("--quiet", bench.quiet, "do not show progress on standard error");
    app.add_option("--isa", words.isa,
                   "of Oiler and the hand-written loops: SSE2, AVX2 or AVX-512; the widest")
        ->type_name("NAME");
    app.add_option("--json", words.json, "write all numbers, - for stdout")->type_name("FILE");
    app.add_option("--plot", words.plot, "draw cost over the number of bodies, and bounces")
        ->type_name("DIR");
}

void state_facts(Bench& bench) {
    bench.report.fact("Oiler", std::string(version()));
    bench.report.fact("loops by hand", std::string(bench.limits.isa));
    bench.report.fact("processors", std::to_string(std::thread::hardware_concurrency()));
    double load = 0;
    if (getloadavg(&load, 1) == 1)
        bench.report.fact("busy when this began", fmt::format("{:.1f} of them", load));
}

void measure(Bench& bench) {
    bench_agreement(bench);
    bench_limits(bench);
    bench_steps(bench);
    bench_methods(bench);
    bench_prices(bench);
    bench_threads(bench);
    bench_settled(bench);
    bench_peers(bench);
    bench_bounces(bench);
    bench_bounce_costs(bench);
    bench_obstacles(bench);
    bench_obstacle_errors(bench);
    bench_nets(bench);
    bench_entities(bench);
    bench_memory(bench);
    bench_loop(bench);
    bench_frames(bench);
}

Exit run(int argc, char** argv) {
    CLI::App app("The cost of a step beside the limits of this machine", "oiler_bench");
    Bench bench;
    Words words;
    declare(app, bench, words);
    const std::string help = parse(app, argc, argv);
    if (!help.empty()) {
        write_file("-", std::as_bytes(std::span(help)));
        return Exit::done;
    }
    choose_isa(bench, words.isa);
    if (bench.full) bench.effort = {.repetitions = 30, .seconds = 0.01, .patience = 4};
    state_facts(bench);
    measure(bench);
    if (bench.report.empty()) fail(Exit::usage, "--only {}: no name matches", bench.only);
    const std::string text = bench.report.text();
    if (words.json != "-") write_file("-", std::as_bytes(std::span(text)));
    const std::string json = bench.report.json();
    if (!words.json.empty()) write_file(words.json, std::as_bytes(std::span(json)));
    if (!words.plot.empty()) draw_plots(bench.report, words.plot);
    return Exit::done;
}

}  // namespace
}  // namespace oiler::bench

int main(int argc, char** argv) {
    return oiler::guard_main("oiler_bench", [&] { return oiler::bench::run(argc, argv); });
}
