// SPDX-License-Identifier: MIT
#include "oiler/app/stills.hpp"
#include "oiler/certify/region.hpp"
#include "oiler/cli/output.hpp"
#include "oiler/cli/shared_options.hpp"
#include "oiler/process/console.hpp"
#include "oiler/process/interrupt.hpp"

namespace oiler::cli {

using namespace certify;

struct StabilityCommand {
    static constexpr CommandTexts texts{
        .name = "stability",
        .summary = "Simulate the stability regions of damped springs: CSV and PNG",
        .example = "--out stability"};

    MethodOptions chosen;
    PictureOptions pictures{.out = "stability"};
    bool quiet = false;

    void declare(Arguments& arguments) {
        chosen.declare(arguments);
        pictures.declare(arguments);
        add_quiet(arguments, quiet);
    }

    /// Returns fewer regions when interrupted.
    [[nodiscard]] std::vector<StabilityRegion> measure(const std::vector<const Method*>& methods,
                                                       const StabilityGrid& grid) const {
        Progress progress(quiet, "methods", static_cast<std::int64_t>(methods.size()));
        std::vector<StabilityRegion> regions;
        for (const Method* method : methods) {
            if (Interrupt::requested()) break;
            regions.push_back(measure_region(*method, chosen.damping_of(*method), grid));
            progress.show(static_cast<std::int64_t>(regions.size()));
        }
        return regions;
    }

    [[nodiscard]] Exit run() const {
        const std::vector<const Method*> methods = chosen.methods();
        Stills stills(pictures.size());
        const StabilityGrid grid;
        const std::vector<StabilityRegion> regions = measure(methods, grid);
        if (regions.size() < methods.size() && !(Interrupt::by_time_limit() && !regions.empty()))
            return Exit::interrupted;
        make_folder(pictures.out);
        write_file(pictures.out / "stability.csv", to_csv(regions, grid), kinds::table,
                   Links::replaced);
        stills.write(atlas(regions, grid), pictures.out / "stability.png");
        remark(quiet, "stability.csv and stability.png are in {}", pictures.out.string());
        return Exit::done;
    }
};

template Command make_command<StabilityCommand>();

}  // namespace oiler::cli
