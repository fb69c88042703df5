// SPDX-License-Identifier: MIT
#include "oiler/certify/figures.hpp"

#include "oiler/app/stills.hpp"
#include "oiler/cli/shared_options.hpp"
#include "oiler/process/console.hpp"
#include "oiler/process/interrupt.hpp"

namespace oiler::cli {

struct FiguresCommand {
    static constexpr CommandTexts texts{
        .name = "figures",
        .summary = "Draw the figures of the article Integration Basics",
        .example = "--out figures"};

    PictureOptions pictures{.out = "figures"};
    bool quiet = false;

    void declare(Arguments& arguments) {
        pictures.declare(arguments);
        add_quiet(arguments, quiet);
    }

    [[nodiscard]] Exit run() const {
        const std::vector<certify::Figure> figures = certify::article_figures();
        Stills stills(pictures.size());
        make_folder(pictures.out);
        Progress progress(quiet, "figures", static_cast<std::int64_t>(figures.size()));
        std::int64_t drawn = 0;
        for (const certify::Figure& figure : figures) {
            if (Interrupt::requested()) return Exit::interrupted;
            stills.write(figure.picture, pictures.out / (figure.name + ".png"));
            progress.show(++drawn);
        }
        remark(quiet, "{} figures are in {}", figures.size(), pictures.out.string());
        return Exit::done;
    }
};

template Command make_command<FiguresCommand>();

}  // namespace oiler::cli
