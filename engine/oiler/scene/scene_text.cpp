// SPDX-License-Identifier: MIT
#include "oiler/scene/scene_text.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "oiler/core/error.hpp"
#include "oiler/toml/guard.hpp"

namespace oiler {
namespace {

class Descriptor {
public:
    /// O_NONBLOCK: opening a pipe without a writer does not wait.
    explicit Descriptor(const std::string& path)
        : number_(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {}
    ~Descriptor() {
        if (number_ >= 0) close(number_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    [[nodiscard]] int number() const { return number_; }

private:
    int number_;
};

void require_file(int descriptor, const std::string& path) {
    struct stat status {};
    if (fstat(descriptor, &status) != 0) fail(Exit::io, "{}: {}", path, system_reason(errno));
    if (!S_ISREG(status.st_mode))
        fail(Exit::usage, "{}: not a file; give a scene file such as assets/scenes/cloth.toml",
             path);
}

}  // namespace

std::string read_scene_text(const std::string& path) {
    const Descriptor file(path);
    if (file.number() < 0)
        fail(exit_of_open(errno), "{}: {}; give a scene file such as assets/scenes/cloth.toml",
             path, system_reason(errno));
    require_file(file.number(), path);
    std::string text(most_toml_bytes + 1, '\0');
    std::size_t size = 0;
    while (size < text.size()) {
        const ssize_t got = read(file.number(), text.data() + size, text.size() - size);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) fail(Exit::io, "{}: {}", path, system_reason(errno));
        if (got == 0) break;
        size += static_cast<std::size_t>(got);
    }
    text.resize(size);
    return text;
}

}  // namespace oiler
