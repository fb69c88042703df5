// SPDX-License-Identifier: MIT
#include "oiler/capture/video.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <system_error>
#include <utility>
#include <vector>

#include "oiler/core/end_with_parent.hpp"
#include "oiler/core/error.hpp"

namespace oiler {
namespace {

namespace fs = std::filesystem;

/// The file of the video in ffmpeg.
constexpr int video_descriptor = 3;

struct Format {
    std::string_view ending;
    std::vector<std::string> arguments;  ///< filters and encoder
};

/// Frames come bottom row first. H.264 with the usual chroma needs even sizes.
const std::array<Format, 3>& formats() {
    static const std::array<Format, 3> all{
        {{".mp4",
          {"-vf", "vflip,pad=ceil(iw/2)*2:ceil(ih/2)*2", "-c:v", "libx264", "-preset", "veryfast",
           "-crf", "18", "-pix_fmt", "yuv420p", "-movflags", "+faststart", "-f", "mp4"}},
         {".gif",
          {"-filter_complex",
           "vflip,fps=min(source_fps\\,50),split[a][b];[a]palettegen[p];[b][p]paletteuse=dither="
           "none",
           "-f", "gif"}},
         {".apng", {"-vf", "vflip", "-plays", "0", "-f", "apng"}}}};
    return all;
}

const Format& format_of(const fs::path& path) {
    std::string ending = path.extension().string();
    std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
    for (const Format& format : formats())
        if (ending == format.ending) return format;
    fail(Exit::usage, "--video {}: give a file that ends with .mp4, .gif or .apng", path.string());
}

const fs::path& with_known_ending(const fs::path& path) {
    (void)format_of(path);
    return path;
}

std::vector<std::string> command_of(const Format& format, Size size, int fps) {
    // Without -xerror a full disk is no error.
    std::vector<std::string> words{"ffmpeg", "-v", "error",    "-xerror",       "-nostdin",
                                   "-y",     "-f", "rawvideo", "-pixel_format", "rgb24"};
    words.insert(words.end(), {"-video_size", fmt::format("{}x{}", size.width, size.height),
                               "-framerate", std::to_string(fps), "-i", "pipe:0"});
    words.insert(words.end(), format.arguments.begin(), format.arguments.end());
    words.insert(words.end(),
                 {"-fflags", "+bitexact", fmt::format("file:/proc/self/fd/{}", video_descriptor)});
    return words;
}

/// The descriptors that ffmpeg gets.
struct Streams {
    int input;
    int errors;
    int video;
};

/// Becomes ffmpeg. Returns if that is impossible. It is in a process group of its own, so that
/// Ctrl-C in a terminal lets it complete its file, and ends with its parent.
void exec(const std::vector<std::string>& words, const Streams& streams, pid_t parent) {
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    dup2(streams.input, STDIN_FILENO);
    dup2(streams.errors, STDOUT_FILENO);
    dup2(streams.errors, STDERR_FILENO);
    if (streams.video == video_descriptor)
        fcntl(streams.video, F_SETFD, 0);
    else
        dup2(streams.video, video_descriptor);
    for (const int number : {SIGPIPE, SIGXFSZ}) signal(number, SIG_DFL);
    setpgid(0, 0);
    end_with_parent(SIGKILL);
    if (getppid() == parent) execvp("ffmpeg", arguments.data());
}

/// Starts ffmpeg. Returns an errno value.
int spawn(pid_t& process, const std::vector<std::string>& words, const Streams& streams) {
    std::array<int, 2> reason{};
    if (pipe2(reason.data(), O_CLOEXEC) != 0) return errno;
    const pid_t parent = getpid();
    process = fork();
    if (process == 0) {
        const int report = fcntl(reason[1], F_DUPFD_CLOEXEC, video_descriptor + 1);
        exec(words, streams, parent);
        const int error = errno;
        _exit(write(report, &error, sizeof error) == sizeof error ? 127 : 126);
    }
    int error = process < 0 ? errno : 0;
    close(reason[1]);
    if (process > 0 && read(reason[0], &error, sizeof error) > 0) waitpid(process, nullptr, 0);
    close(reason[0]);
    return error;
}

/// The last line that ffmpeg wrote.
std::string last_line(int descriptor) {
    std::string text(4096, '\0');
    const off_t end = lseek(descriptor, 0, SEEK_END);
    const off_t start = std::max<off_t>(0, end - static_cast<off_t>(text.size()));
    const ssize_t count = pread(descriptor, text.data(), text.size(), start);
    text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
    while (!text.empty() && text.back() == '\n') text.pop_back();
    return text.substr(text.rfind('\n') + 1);
}

}  // namespace

void Video::require_format(const fs::path& path) { (void)format_of(path); }

Video::Video(const fs::path& path, Size size, int fps)
    : path_(with_known_ending(path)), file_(path, kinds::video) {
    remove_abandoned_files(path.parent_path());
    try {
        start(command_of(format_of(path), size, fps));
    } catch (...) {
        stop();
        throw;
    }
}

Video::~Video() { stop(); }

void Video::start(const std::vector<std::string>& words) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) fail_to_start(errno);
    frames_ = ends[1];
    errors_ = memfd_create("ffmpeg", MFD_CLOEXEC);
    const int error =
        errors_ < 0 ? errno : spawn(process_, words, {ends[0], errors_, file_.descriptor()});
    close(ends[0]);
    if (error == 0) return;
    process_ = -1;
    fail_to_start(error);
}

void Video::fail_to_start(int error_number) const {
    const std::string_view remedy =
        error_number == ENOENT   ? "install the Debian package ffmpeg, or leave out --video"
        : error_number == EMFILE ? "raise the limit of `ulimit -n`, or leave out --video"
                                 : "leave out --video";
    fail(Exit::io, "--video {}: cannot start ffmpeg: {}; {}", path_.string(),
         system_reason(error_number), remedy);
}

void Video::stop() {
    if (process_ > 0) {
        kill(process_, SIGKILL);
        wait();
    }
    for (const int descriptor : {frames_, errors_}) close(descriptor);
}

int Video::wait() {
    close(std::exchange(frames_, -1));
    int status = 0;
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) continue;
    process_ = -1;
    return status;
}

void Video::fail_with_reason(int status) {
    const std::string words = last_line(errors_);
    const std::string end = WIFSIGNALED(status) ? fmt::format("signal {}", WTERMSIG(status))
                                                : fmt::format("exit code {}", WEXITSTATUS(status));
    fail(Exit::io, "cannot write {}: ffmpeg ended with {}{}{}", path_.string(), end,
         words.empty() ? "" : ": ", words);
}

void Video::add(std::span<const std::uint8_t> rgb_bottom_up) {
    while (!rgb_bottom_up.empty()) {
        const ssize_t count = ::write(frames_, rgb_bottom_up.data(), rgb_bottom_up.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail_with_reason(wait());
        rgb_bottom_up = rgb_bottom_up.subspan(static_cast<std::size_t>(count));
    }
}

void Video::finish() {
    const int status = wait();
    struct stat made {};
    if (status != 0 || fstat(file_.descriptor(), &made) != 0 || made.st_size == 0)
        fail_with_reason(status);
    file_.commit();
}

}  // namespace oiler
