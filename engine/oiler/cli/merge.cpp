// SPDX-License-Identifier: MIT
#include "oiler/cli/output.hpp"
#include "oiler/cli/shared_options.hpp"
#include "oiler/cli/tradeoff_output.hpp"
#include "oiler/lab/sweep/tradeoff_file.hpp"

namespace oiler::cli {

namespace {

lab::Tradeoff read_part(const std::filesystem::path& path) {
    lab::Tradeoff part = lab::parse_tradeoff(read_text(path), path.string());
    if (!part.timed())
        fail(Exit::usage, "{}: has no times because it was interrupted; run its command again",
             path.string());
    return part;
}

}  // namespace

struct MergeCommand {
    static constexpr CommandTexts texts{.name = "merge",
                                        .summary = "Join the part files of tradeoff --shard",
                                        .example = "parts/part-*.json --out whole"};

    std::vector<std::filesystem::path> parts;
    bool all = false;
    PictureOptions pictures{.out = "tradeoff"};
    std::filesystem::path json;
    bool quiet = false;

    void declare(Arguments& arguments) {
        arguments.add_required("PART", parts, "part files of all shards");
        arguments.add_flag("--all", all, "print all rows");
        pictures.declare(arguments, is_tradeoff_file);
        add_json(arguments, json, kinds::sweep);
        add_quiet(arguments, quiet);
    }

    [[nodiscard]] Exit run() const {
        const Size size = pictures.size();
        std::vector<lab::Tradeoff> read;
        for (const std::filesystem::path& path : parts) read.push_back(read_part(path));
        const lab::Tradeoff tradeoff = lab::merge(read);
        for (const std::filesystem::path& path : {pictures.out / "tradeoff.json", json})
            (void)find_earlier(path);
        make_folder(pictures.out);
        Stills stills(size);
        publish(tradeoff, {pictures.out, json, all, quiet}, stills);
        remove_picture(pictures.out / energy_picture);
        return Exit::done;
    }
};

template Command make_command<MergeCommand>();

}  // namespace oiler::cli
