// SPDX-License-Identifier: MIT
#include "oiler/capture/file.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <charconv>
#include <climits>
#include <cstdio>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

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
        case EFBIG:
            return "raise the limit of `ulimit -f`, or write less";
        case EBADF:
            return "do not close it, or name a file";
        case ELOOP:
            return "remove the loop of links or choose another place";
        case EMFILE:
            return "raise the limit of `ulimit -n`";
        default:
            return "choose another place";
    }
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

constexpr std::string_view temporary_start = ".oiler-";

std::string temporary_name(pid_t process, int attempt) {
    return fmt::format("{}{}-{}.tmp", temporary_start, process, attempt);
}

/// Whether the name is that of a temporary file, and its process has ended.
bool is_of_ended_process(const std::string& name) {
    if (!name.starts_with(temporary_start)) return false;
    const char* const end = name.data() + name.size();
    pid_t process = 0;
    int attempt = 0;
    const auto read = std::from_chars(name.data() + temporary_start.size(), end, process);
    if (read.ptr != end) std::from_chars(read.ptr + 1, end, attempt);
    return process > 0 && name == temporary_name(process, attempt) && kill(process, 0) != 0 &&
           errno == ESRCH;
}

/// Returns whether the file is locked and still has its name.
bool lock(int descriptor, const fs::path& path) {
    if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) return errno != EWOULDBLOCK;
    struct stat named = {};
    return lstat(path.c_str(), &named) == 0 && is_same_file(descriptor, named);
}

/// Whether `path` can only be the name of a folder.
bool names_folder(const fs::path& path) {
    std::error_code none;
    return !path.has_filename() || fs::is_directory(fs::symlink_status(path, none));
}

fs::path folder_of(const fs::path& file) {
    return file.has_parent_path() ? file.parent_path() : ".";
}

/// Calls `make` with the names of temporary files until it returns no -1 of EEXIST. Returns the
/// result and leaves the name in `name`.
template <class Make>
int make_temporary(const fs::path& folder, fs::path& name, Make make) {
    constexpr int most_attempts = 10'000;
    for (int attempt = 0; attempt < most_attempts; ++attempt) {
        fs::path tried = folder / temporary_name(getpid(), attempt);
        const int result = make(tried.c_str());
        if (result < 0 && errno == EEXIST) continue;
        if (result >= 0) name = std::move(tried);
        return result;
    }
    return -1;
}

/// The path by which a file without a name can be linked.
std::string path_of(int descriptor) { return fmt::format("/proc/self/fd/{}", descriptor); }

int open_without_name(const fs::path& folder) {
    const int descriptor = open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
    struct stat made = {};
    const bool has_no_name = descriptor >= 0 && fstat(descriptor, &made) == 0 && made.st_nlink == 0;
    if (descriptor < 0 || (has_no_name && access(path_of(descriptor).c_str(), F_OK) == 0))
        return descriptor;
    close(descriptor);
    return -1;
}

namespace fs = std::filesystem;

/// The target of a path: a file, or the place where one would be made.
class Place {
public:
    explicit Place(const fs::path& path) : path_(path) {
        struct stat found = {};
        if ((path == "-" ? fstat(STDOUT_FILENO, &found) : stat(path.c_str(), &found)) == 0)
            file_ = found;
    }

    [[nodiscard]] bool is_file_or_folder() const {
        return file_ && (S_ISREG(file_->st_mode) || S_ISDIR(file_->st_mode));
    }
    [[nodiscard]] bool is_null_device() const {
        struct stat null = {};
        return file_ && S_ISCHR(file_->st_mode) && stat("/dev/null", &null) == 0 &&
               file_->st_rdev == null.st_rdev;
    }
    [[nodiscard]] bool is(const Place& other) const {
        if (file_.has_value() != other.file_.has_value()) return false;
        if (file_)
            return file_->st_dev == other.file_->st_dev && file_->st_ino == other.file_->st_ino;
        return absolute() == other.absolute();
    }
    /// Whether the path names an entry of the folder.
    [[nodiscard]] bool is_in(const Place& folder) const {
        return Place(path_.has_parent_path() ? path_.parent_path() : ".").is(folder);
    }

private:
    [[nodiscard]] fs::path absolute() const {
        std::error_code error;
        const fs::path path =
            fs::absolute(path_.has_filename() ? path_ : path_.parent_path(), error);
        const fs::path followed = fs::weakly_canonical(path, error);
        return error ? path.lexically_normal() : followed;
    }

    fs::path path_;
    std::optional<struct stat> file_;
};

bool is_written_by(const NamedPath& folder, const NamedPath& file) {
    return folder.uses && !folder.path.empty() && file.path != "-" &&
           folder.uses(file.path.filename().string()) && Place(file.path).is_in(Place(folder.path));
}

const FileKind& kind_of_ending(const fs::path& path) {
    const fs::path ending = path.extension();
    return ending == ".png"    ? kinds::png
           : ending == ".csv"  ? kinds::table
           : ending == ".json" ? kinds::sweep
                               : kinds::any;
}

void require_replaceable_files(const NamedPath& folder) {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder.path, none))
        if (folder.uses(entry.path().filename().string()))
            require_replaceable(entry.path(), kind_of_ending(entry.path()));
}

bool are_one_file(const NamedPath& a, const NamedPath& b) {
    if (a.path.empty() || b.path.empty()) return false;
    if (a.path == "-" && b.path == "-") return true;
    const Place place(a.path);
    if (place.is(Place(b.path))) return !place.is_null_device();
    return is_written_by(a, b) || is_written_by(b, a);
}

}  // namespace

File::File(const fs::path& path, const FileKind& kind, Links links)
    : path_(path), target_(path), largest_write_(std::size_t{1} << 20) {
    std::optional<int> in_place;
    if (links == Links::followed) {
        std::error_code missing;
        if (fs::path followed = fs::canonical(path, missing); !missing)
            target_ = std::move(followed);
        std::error_code none;
        const bool is_link = fs::is_symlink(fs::symlink_status(path, none));
        if (is_link && missing.value() == ENOENT)
            fail(Exit::io, "cannot write {}: it is a link to nothing; remove it, or {}",
                 path.string(), remedy(ENOENT));
        if (is_link && missing) fail_write(missing.value());
        in_place = open_in_place(path);
    }
    in_place_ = in_place.has_value();
    if (in_place_) largest_write_ = PIPE_BUF;
    if (!in_place_ && names_folder(target_)) fail_write(EISDIR);
    if (!in_place_) require_replaceable(path, kind);
    if (!in_place_ && target_.has_parent_path()) make_folder(target_.parent_path());
    descriptor_ = in_place_ ? *in_place : open_temporary();
    if (descriptor_ < 0) fail_write(errno);
}

File::~File() {
    if (descriptor_ >= 0) close(descriptor_);
    if (!temporary_.empty() && (!is_published_ || failure_ != 0)) unlink(temporary_.c_str());
}

void File::fail_write(int error_number) {
    failure_ = error_number;
    const std::string name = path_ == "-" ? "the standard output" : path_.string();
    if (error_number == EINTR && descriptor_ < 0)
        fail(Exit::interrupted, "{}: waited for a reader; start the reader first", name);
    if (error_number == EINTR)
        fail(Exit::interrupted,
             "{}: waited for its reader and is incomplete; run the command again", name);
    fail(Exit::io, "cannot write {}: {}; {}", name, system_reason(error_number),
         remedy(error_number));
}

/// Not all file systems have files without names.
int File::open_temporary() {
    const int descriptor = open_without_name(folder_of(target_));
    return descriptor >= 0 ? descriptor : oiler::open_temporary(folder_of(target_), temporary_);
}

void File::write(std::span<const std::byte> bytes) {
    assert(descriptor_ >= 0);
    constexpr std::size_t most_buffered = 1 << 16;
    buffer_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (buffer_.size() >= most_buffered) flush();
}

void File::write(std::string_view text) { write(std::as_bytes(std::span(text))); }

void File::flush() {
    if (failure_ != 0) fail_write(failure_);
    for (std::string_view left = buffer_; !left.empty();) {
        const std::string_view next = left.substr(0, largest_write_);
        const ssize_t written = ::write(descriptor_, next.data(), next.size());
        if (written < 0) fail_write(errno);
        left.remove_prefix(static_cast<std::size_t>(written));
    }
    buffer_.clear();
}

/// Returns whether there is an older file.
bool File::keep_permissions() const {
    struct stat replaced = {};
    if (lstat(target_.c_str(), &replaced) != 0 || !S_ISREG(replaced.st_mode)) return false;
    fchmod(descriptor_, replaced.st_mode & 07777);
    return true;
}

/// Links a file without a name to a name or, if that exists, to a temporary one.
void File::give_name(const fs::path& name) {
    const std::string own = path_of(descriptor_);
    const auto link_to = [&](const char* path) {
        return linkat(AT_FDCWD, own.c_str(), AT_FDCWD, path, AT_SYMLINK_FOLLOW);
    };
    if (link_to(name.c_str()) == 0) return;
    if (errno != EEXIST || make_temporary(folder_of(target_), temporary_, link_to) != 0)
        fail_write(errno);
}

/// Closes before the file is renamed, because network file systems report errors then.
void File::close_descriptor() {
    const int descriptor = std::exchange(descriptor_, -1);
    if (close(descriptor) != 0 && errno != EINTR) fail_write(errno);
}

/// Writes everything to a file that has its own name or a temporary one.
void File::prepare_name() {
    assert(descriptor_ >= 0);
    flush();
    if (in_place_) return;
    if (is_published_) require_own_part();
    if (keep_permissions() && fsync(descriptor_) != 0) fail_write(errno);
    if (temporary_.empty()) give_name(target_);
}

void File::rename_temporary() {
    if (temporary_.empty()) return;
    if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail_write(errno);
    temporary_.clear();
}

void File::publish() {
    flush();
    if (in_place_) return;
    keep_permissions();
    const fs::path part = part_of(target_);
    if (temporary_.empty()) give_name(part);
    if (!temporary_.empty() && std::rename(temporary_.c_str(), part.c_str()) != 0)
        fail_write(errno);
    temporary_ = part;
    is_published_ = true;
}

/// Another run may write the same file.
void File::require_own_part() {
    struct stat own = {};
    struct stat named = {};
    if (fstat(descriptor_, &own) != 0) {
        if (errno == ENOENT) return;  // emscripten looks for the old name; no other run is there
        fail_write(errno);
    }
    if (lstat(temporary_.c_str(), &named) != 0 && errno != ENOENT) fail_write(errno);
    if (own.st_dev == named.st_dev && own.st_ino == named.st_ino) return;
    fail(Exit::io, "cannot write {}: {} was replaced or removed meanwhile; choose another path",
         path_.string(), temporary_.string());
}

void File::commit() {
    prepare_name();
    close_descriptor();
    rename_temporary();
}

fs::path part_of(const fs::path& path) { return fs::path(path) += ".part"; }

std::string read_text(const fs::path& path, std::size_t most) {
    const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    int reason = descriptor < 0 ? errno : 0;
    const Exit exit = exit_of_open(reason);
    std::string text;
    if (descriptor >= 0) {
        std::array<char, 1 << 16> part;
        ssize_t count = 0;
        while (text.size() <= most && (count = read(descriptor, part.data(), part.size())) > 0)
            text.append(part.data(), static_cast<std::size_t>(count));
        if (count < 0) reason = errno;
        close(descriptor);
    }
    if (reason == EINTR)
        fail(Exit::interrupted, "{}: waited for data; start its writer first", path.string());
    if (reason == EISDIR) fail(Exit::usage, "{}: it is a folder; give a file", path.string());
    if (reason != 0)
        fail(descriptor < 0 ? exit : Exit::io,
             "{}: cannot be read: {}; give a file that you may read", path.string(),
             system_reason(reason));
    if (text.size() > most)
        fail(Exit::usage, "{}: it has more than {} MB; give a smaller file", path.string(),
             most / 1'000'000);
    return text;
}

void write_file(const fs::path& path, std::span<const std::byte> bytes, const FileKind& kind,
                Links links) {
    File file(path, kind, links);
    file.write(bytes);
    file.commit();
}

void write_file(const fs::path& path, std::string_view text, const FileKind& kind, Links links) {
    write_file(path, std::as_bytes(std::span(text)), kind, links);
}

void require_writable(const fs::path& path) {
    struct stat found = {};
    constexpr mode_t writable = S_IWUSR | S_IWGRP | S_IWOTH;
    if (stat(path.c_str(), &found) != 0) return;
    if ((found.st_mode & writable) == 0 || access(path.c_str(), W_OK) != 0)
        fail(Exit::io, "cannot write {}: it is read-only; allow it with `chmod u+w`",
             path.string());
}

int open_temporary(const fs::path& folder, fs::path& name) {
    return make_temporary(folder, name, [](const char* path) {
        const int descriptor = open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor < 0 || lock(descriptor, path)) return descriptor;
        close(descriptor);  // another process took it for abandoned
        errno = EEXIST;
        return -1;
    });
}

void remove_abandoned_files(const fs::path& folder) {
    std::error_code error;
    for (const auto& entry :
         fs::directory_iterator(folder.empty() ? fs::path(".") : folder, error)) {
        if (!is_of_ended_process(entry.path().filename().string()) || !entry.is_regular_file(error))
            continue;
        const int descriptor = open(entry.path().c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW);
        if (descriptor < 0) continue;
        if (flock(descriptor, LOCK_EX | LOCK_NB) == 0) unlink(entry.path().c_str());
        close(descriptor);
    }
}

void remove_abandoned_files(const NamedPath& output) {
    remove_abandoned_files(output.uses ? output.path : output.path.parent_path());
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

void require_openable(const NamedPath& output) {
    if (output.path.empty() || output.path == "-") return;
    remove_abandoned_files(output);
    if (output.uses) return require_replaceable_files(output);
    std::error_code none;
    const fs::file_status found = fs::status(output.path, none);
    if (fs::exists(found) && !fs::is_regular_file(found) && !fs::is_directory(found)) return;
    // Missing folders are made later: a command that fails leaves none.
    if (const fs::path folder = output.path.parent_path();
        folder.empty() || fs::is_directory(folder, none))
        const File probe(output.path, *output.kind);
}

void require_distinct(std::span<const NamedPath> inputs, std::span<const NamedPath> outputs) {
    for (const NamedPath& input : inputs)
        for (const NamedPath& output : outputs)
            if (Place(input.path).is_file_or_folder() && are_one_file(input, output))
                fail(Exit::usage, "{}: {} would overwrite {}, an input; give another path",
                     output.name, output.path.string(), input.name);
    for (std::size_t i = 0; i < outputs.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (are_one_file(outputs[i], outputs[j]))
                fail(Exit::usage, "{} and {}: both write {}; give two paths", outputs[j].name,
                     outputs[i].name, outputs[i].path.string());
}

}  // namespace oiler
