// SPDX-License-Identifier: MIT
#include "oiler/capture/file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <optional>
#include <system_error>

#include "oiler/core/error.hpp"

namespace oiler {
namespace {

namespace fs = std::filesystem;

std::string_view remedy(int error_number) {
    switch (error_number) {
        case ENOSPC:
        case EDQUOT:
            return "free some space or choose another place";
        case EACCES:
        case EPERM:
        case EROFS:
            return "choose a place that you may write to";
        case EISDIR:
            return "name a file, not a folder";
        default:
            return "choose another place";
    }
}

[[noreturn]] void fail_write(const fs::path& path, int error_number) {
    fail(Exit::io, "cannot write {}: {}; {}", path.string(), system_reason(error_number),
         remedy(error_number));
}

bool is_same_file(int descriptor, const struct stat& other) {
    struct stat own = {};
    return fstat(descriptor, &own) == 0 && own.st_dev == other.st_dev && own.st_ino == other.st_ino;
}

/// Opens files that must be written in place. Returns a descriptor, -1 with errno set, or empty if
/// the file is missing or can be replaced.
std::optional<int> open_in_place(const fs::path& path) {
    if (path == "-") return fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0);
    struct stat named = {};
    if (stat(path.c_str(), &named) != 0) return std::nullopt;
    // Duplicated, not opened again, to share the file offset with other output.
    for (const int standard : {STDOUT_FILENO, STDERR_FILENO})
        if (is_same_file(standard, named)) return fcntl(standard, F_DUPFD_CLOEXEC, 0);
    if (S_ISREG(named.st_mode)) return std::nullopt;
    return open(path.c_str(), O_WRONLY | O_CLOEXEC);
}

}  // namespace

File::File(const fs::path& path) : path_(path), target_(path) {
    std::error_code missing;
    if (fs::path followed = fs::canonical(path, missing); !missing) target_ = std::move(followed);
    if (missing && fs::is_symlink(fs::symlink_status(path, missing))) fail_write(path_, ENOENT);
    const std::optional<int> in_place = open_in_place(path);
    if (!in_place && target_.has_parent_path()) make_folder(target_.parent_path());
    const int descriptor = in_place ? *in_place : open_temporary();
    if (descriptor < 0) fail_write(path_, errno);
    file_.reset(fdopen(descriptor, "wb"));
    if (!file_) {
        const int error_number = errno;
        close(descriptor);
        if (!temporary_.empty()) unlink(temporary_.c_str());
        fail_write(path_, error_number);
    }
}

File::~File() {
    if (!temporary_.empty()) unlink(temporary_.c_str());
}

/// Like mkstemp(), but with the permissions of a new file under the user's umask.
int File::open_temporary() {
    constexpr int most_attempts = 10'000;
    for (int attempt = 0; attempt < most_attempts; ++attempt) {
        const fs::path name =
            target_.parent_path() / fmt::format(".oiler-{}-{}.tmp", getpid(), attempt);
        const int descriptor = open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor < 0 && errno == EEXIST) continue;
        if (descriptor >= 0) temporary_ = name;
        return descriptor;
    }
    return -1;
}

void File::write(std::span<const std::byte> bytes) {
    assert(file_);
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size())
        fail_write(path_, errno);
}

void File::write(std::string_view text) { write(std::as_bytes(std::span(text))); }

void File::commit() {
    assert(file_);
    if (std::fclose(file_.release()) != 0) fail_write(path_, errno);
    if (temporary_.empty()) return;
    std::error_code none;
    const fs::file_status replaced = fs::status(target_, none);
    if (!none && fs::exists(replaced)) fs::permissions(temporary_, replaced.permissions(), none);
    if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail_write(path_, errno);
    temporary_.clear();
}

void write_file(const fs::path& path, std::span<const std::byte> bytes) {
    File file(path);
    file.write(bytes);
    file.commit();
}

void write_file(const fs::path& path, std::string_view text) {
    write_file(path, std::as_bytes(std::span(text)));
}

bool make_folder(const fs::path& path) {
    std::error_code error;
    const bool made = fs::create_directories(path, error);
    if (!error && !fs::is_directory(path, error) && !error)
        error = std::make_error_code(std::errc::not_a_directory);
    if (error)
        fail(Exit::io, "cannot make the folder {}: {}; {}", path.string(), error.message(),
             remedy(error.value()));
    return made;
}

}  // namespace oiler
