// SPDX-License-Identifier: MIT
#include "oiler/certify/figures.hpp"

#include "oiler/app/console.hpp"
#include "oiler/app/stills.hpp"
#include "oiler/capture/file.hpp"
#include "oiler/cli/commands.hpp"

namespace oiler::cli {

Exit FiguresCommand::run() const {
    const std::vector<Figure> figures = article_figures();
    Stills stills(size);
    make_folder(out);
    Progress progress(quiet, "figures", static_cast<std::int64_t>(figures.size()));
    std::int64_t drawn = 0;
    for (const Figure& figure : figures) {
        stills.write(figure.picture, out / (figure.name + ".png"));
        progress.show(++drawn);
    }
    remark(quiet, "{} figures are in {}", figures.size(), out.string());
    return Exit::done;
}

}  // namespace oiler::cli
