// SPDX-License-Identifier: MIT
// Frames per second of headless captures, by stage, beside other encoders of PNG:
//   oiler_capture_bench PROGRAMS SCENES [FRAMES]
// PROGRAMS is the folder of the programs, SCENES that of the scene files.
#include <fmt/core.h>
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "oiler/compare/captures/captured.hpp"

namespace {

namespace fs = std::filesystem;
using oiler::Image;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

struct Stages {
    std::map<std::string, double> ms;  ///< per frame, by stage
    double frame_ms = 0;               ///< from the first span to the last one
};

/// Reads the file of --profile: the spans of the stages, without the frames around them.
Stages read_stages(const fs::path& path, int frames) {
    std::ifstream file(path);
    const auto json = nlohmann::json::parse(file);
    Stages stages;
    double first = INFINITY;
    double last = 0;
    for (const auto& event : json.at("traceEvents")) {
        if (event.at("ph") != "X" || event.at("name") == "frame") continue;
        const double begin = event.at("ts");
        const double length = event.at("dur");
        stages.ms[event.at("name")] += length / 1e3 / frames;
        first = std::min(first, begin);
        last = std::max(last, begin + length);
    }
    stages.frame_ms = (last - first) / 1e3 / frames;
    return stages;
}

std::string text_of(const Stages& stages) {
    double sum = 0;
    std::pair<std::string, double> slowest;
    std::string text;
    for (const auto& [name, ms] : stages.ms) {
        text += fmt::format("{} {:.2f}, ", name, ms);
        sum += ms;
        if (ms > slowest.second) slowest = {name, ms};
    }
    return fmt::format(
        "{:.1f} frames per second; ms per frame: {}sum {:.2f}, slowest {} {:.2f}; a frame takes "
        "{:.2f} of the sum and {:.2f} of the slowest",
        1e3 / stages.frame_ms, text, sum, slowest.first, slowest.second, stages.frame_ms / sum,
        stages.frame_ms / slowest.second);
}

std::vector<Image> read_images(const fs::path& folder, std::int64_t most) {
    const oiler::Captured captured(folder);
    std::vector<Image> images;
    const auto count = static_cast<std::int64_t>(captured.manifest().frames.size());
    for (std::int64_t i = 0; i < std::min(most, count); ++i) images.push_back(captured.image(i));
    return images;
}

/// ms and bytes per frame of an encoder.
template <class Encode>
std::string measure(const std::vector<Image>& images, const Encode& encode) {
    const Clock::time_point start = Clock::now();
    std::size_t bytes = 0;
    for (const Image& image : images) bytes += encode(image);
    const double count = static_cast<double>(images.size());
    return fmt::format("{:.2f} ms, {:.0f} kB", 1e3 * seconds_since(start) / count,
                       static_cast<double>(bytes) / 1e3 / count);
}

/// ffmpeg's own encoder, with its start.
std::string measure_ffmpeg(const std::vector<Image>& images) {
    const fs::path folder = "frames/bench-ffmpeg";
    fs::remove_all(folder);
    fs::create_directories(folder);
    const oiler::Size size = images.front().size;
    const Clock::time_point start = Clock::now();
    FILE* const pipe = popen(
        fmt::format("ffmpeg -v error -f rawvideo -pixel_format rgb24 -video_size {}x{} -i pipe:0 "
                    "{}/%06d.png",
                    size.width, size.height, folder.string())
            .c_str(),
        "w");
    for (const Image& image : images)
        std::fwrite(image.rgb_bottom_up.data(), 1, image.rgb_bottom_up.size(), pipe);
    if (pclose(pipe) != 0) return "not installed";
    const double ms = 1e3 * seconds_since(start) / static_cast<double>(images.size());
    std::uintmax_t bytes = 0;
    for (const auto& entry : fs::directory_iterator(folder)) bytes += entry.file_size();
    return fmt::format("{:.2f} ms, {:.0f} kB", ms,
                       static_cast<double>(bytes) / 1e3 / static_cast<double>(images.size()));
}

void measure_capture(const std::string& name, const std::string& command, const std::string& size,
                     int frames) {
    const std::string out = "frames/bench-" + name;
    const std::string line =
        fmt::format("{} --headless --quiet --size {} --frames {} --out {} --profile {}.json",
                    command, size, frames, out, out);
    if (std::system(line.c_str()) != 0) {
        fmt::print(stderr, "failed: {}\n", line);
        std::exit(1);
    }
    fmt::print("{} {}: {}\n", name, size, text_of(read_stages(out + ".json", frames)));
    constexpr std::int64_t most_images = 20;
    const std::vector<Image> images = read_images(out, most_images);
    fmt::print("  PNG per frame: oiler {}; stock stb_image_write {}; ffmpeg with its start {}\n",
               measure(images,
                       [](const Image& image) {
                           return oiler::encode_png(image.size, image.rgb_bottom_up).size();
                       }),
               measure(images,
                       [](const Image& image) {
                           const auto& [width, height] = image.size;
                           int count = 0;
                           std::free(stbi_write_png_to_mem(image.rgb_bottom_up.data(), 3 * width,
                                                           width, height, 3, &count));
                           return static_cast<std::size_t>(count);
                       }),
               measure_ffmpeg(images));
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 3) {
        fmt::print(stderr, "usage: oiler_capture_bench PROGRAMS SCENES [FRAMES]\n");
        return 2;
    }
    const std::string programs = argv[1];
    const std::string scenes = argv[2];
    const int frames = argc > 3 ? std::atoi(argv[3]) : 120;
    for (const char* size : {"640x360", "1280x720", "1920x1080"}) {
        measure_capture("spring", programs + "/spring_damper", size, frames);
        measure_capture("100,000-discs",
                        fmt::format("{}/oiler play {}/hundred_thousand.toml", programs, scenes),
                        size, std::max(1, frames / 4));
    }
}
