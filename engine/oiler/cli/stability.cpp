// SPDX-License-Identifier: MIT
#include "oiler/app/console.hpp"
#include "oiler/app/stills.hpp"
#include "oiler/capture/file.hpp"
#include "oiler/cli/commands.hpp"
#include "oiler/certify/region.hpp"

namespace oiler::cli {

Exit StabilityCommand::run() const {
    const StabilityGrid grid;
    Stills stills(size);
    std::vector<StabilityRegion> regions;
    {
        Progress progress(quiet, "methods", static_cast<std::int64_t>(methods.size()));
        for (const Method* method : methods) {
            regions.push_back(measure_region(*method, damping.value_or(method->damping), grid));
            progress.show(static_cast<std::int64_t>(regions.size()));
        }
    }
    make_folder(out);
    const std::string csv = to_csv(regions, grid);
    write_file(out / "stability.csv", std::as_bytes(std::span(csv)));
    stills.write(atlas(regions, grid), out / "stability.png");
    remark(quiet, "stability.csv and stability.png are in {}", out.string());
    return Exit::done;
}

}  // namespace oiler::cli
