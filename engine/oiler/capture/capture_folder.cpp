// SPDX-License-Identifier: MIT
#include "oiler/capture/capture_folder.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "oiler/capture/file.hpp"
#include "oiler/capture/manifest.hpp"
#include "oiler/core/error.hpp"
#include "oiler/core/utf8.hpp"

namespace oiler {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view lock_name = ".oiler-capture";
/// Has the files of the earlier capture while they are replaced.
constexpr std::string_view old_name = ".oiler-old";
/// Has them while they are put back, so that none is taken for a new one.
constexpr std::string_view back_name = ".oiler-back";

/// Returns whether a reader of frame_*.png would take the file for a frame.
bool is_frame_like(std::string_view name) {
    return name.starts_with("frame_") && name.ends_with(".png");
}

/// Returns whether the capture of that manifest may have written the file.
bool may_have_written(const Manifest& manifest, std::string_view name) {
    if (name == manifest_name || name == records_name) return true;
    if (!is_frame_like(name)) return false;
    const std::string_view digits = name.substr(std::string_view("frame_").size());
    std::int64_t index = -1;
    std::from_chars(digits.data(), digits.data() + digits.size(), index);
    if (index < 0 || name != frame_name(index)) return false;
    const auto listed = std::int64_t(manifest.frames.size());
    if (index < listed) return !manifest.frames[static_cast<std::size_t>(index)].file.empty();
    return index < manifest.planned_frames;
}

Manifest read_earlier(const fs::path& path) try {
    return read_manifest(path);
} catch (const Error& error) {
    fail(Exit::io, "{} is not from a capture and would be lost ({}); choose another folder",
         path.string(), error.what());
}

bool is_regular(const fs::path& path) {
    std::error_code error;
    return fs::symlink_status(path, error).type() == fs::file_type::regular;
}

/// The manifest and the other files of an earlier capture.
struct Earlier {
    std::optional<Manifest> manifest;
    std::vector<fs::path> files;
};

/// Throws Error{io} if a file would lie between the new frames.
Earlier find_earlier(const fs::path& folder) {
    std::error_code error;
    const fs::path manifest_path = folder / manifest_name;
    Earlier earlier;
    if (fs::exists(fs::symlink_status(manifest_path, error)))
        earlier.manifest = read_earlier(manifest_path);
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        const std::string name = entry.path().filename().string();
        if (earlier.manifest && may_have_written(*earlier.manifest, name) &&
            is_regular(entry.path()))
            earlier.files.push_back(entry.path());
        else if (is_capture_file(name))
            fail(Exit::io, "{} is not from a capture of Oiler; remove it or choose another folder",
                 entry.path().string());
    }
    std::erase(earlier.files, manifest_path);
    return earlier;
}

void remove_file(const fs::path& path) {
    std::error_code error;
    fs::remove(path, error);
    if (error)
        fail(Exit::io, "cannot remove {} of an earlier capture: {}; choose another folder",
             path.string(), error.message());
}

/// The files of a capture in a folder, the manifest last; none if there is no folder. Throws
/// Error{io}.
std::vector<fs::path> capture_files(const fs::path& folder) {
    std::error_code error;
    std::vector<fs::path> files;
    for (fs::directory_iterator at(folder, error); !error && at != fs::directory_iterator();
         at.increment(error))
        if (is_capture_file(at->path().filename().string())) files.push_back(at->path());
    if (error && error != std::errc::no_such_file_or_directory)
        fail(Exit::io, "cannot read {}: {}", folder.string(), error.message());
    std::partition(files.begin(), files.end(),
                   [](const fs::path& file) { return file.filename() != manifest_name; });
    return files;
}

void move(const fs::path& from, const fs::path& to) {
    std::error_code error;
    fs::rename(from, to, error);
    if (error) fail(Exit::io, "cannot write {}: {}", to.string(), error.message());
}

void move_capture(const fs::path& from, const fs::path& to) {
    for (const fs::path& file : capture_files(from)) move(file, to / file.filename());
}

bool is_folder(const fs::path& path) {
    std::error_code none;
    return fs::is_directory(fs::symlink_status(path, none));
}

/// Through a link, the files of another folder would be moved and removed.
void refuse_link(const fs::path& path) {
    if (fs::is_symlink(path))
        fail(Exit::io, "{} is a link; remove it or choose another folder", path.string());
}

/// A folder without the file of its owner is not from a replacement, unless it is empty.
void refuse_foreign(const fs::path& path) {
    refuse_link(path);
    if (is_folder(path) && !fs::is_empty(path) && !is_regular(path / lock_name))
        fail(Exit::io, "{} is not from Oiler; rename it or choose another folder", path.string());
}

void remove_folder(const fs::path& folder) {
    remove_file(folder / lock_name);
    remove_file(folder);
}

/// Waits until everything written to the folder's file system is on the disk.
void sync_to_disk(const fs::path& folder) {
    const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool synced = descriptor >= 0 && syncfs(descriptor) == 0;
    const int reason = errno;
    if (descriptor >= 0) close(descriptor);
    if (!synced) fail(Exit::io, "cannot write {}: {}", folder.string(), system_reason(reason));
}

bool has_manifest(const fs::path& folder) {
    std::error_code none;
    return fs::exists(fs::symlink_status(folder / manifest_name, none));
}

std::string host_name() {
    std::array<char, 256> name{};
    gethostname(name.data(), name.size() - 1);
    return name.data();
}

std::string own_name() { return fmt::format("process {} of {}\n", getpid(), host_name()); }

std::string read_owner(int descriptor) {
    std::array<char, 300> text{};
    const ssize_t count = pread(descriptor, text.data(), text.size() - 1, 0);
    const std::string_view line(text.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
    return std::string(line.substr(0, line.find('\n')));
}

/// Waits for a process that has just locked the file and has not written its name yet.
std::string wait_for_owner(int descriptor) {
    for (int attempt = 0; attempt < 100; ++attempt) {
        if (const std::string owner = read_owner(descriptor); !owner.empty()) return owner;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return "another process";
}

bool is_same_file(int descriptor, const fs::path& path) {
    struct stat held {};
    struct stat named {};
    return fstat(descriptor, &held) == 0 && lstat(path.c_str(), &named) == 0 &&
           held.st_dev == named.st_dev && held.st_ino == named.st_ino;
}

}  // namespace

bool is_capture_file(std::string_view name) {
    return is_frame_like(name) || name == records_name || name == manifest_name;
}

fs::path folder_of_new(const fs::path& folder) { return folder / ".oiler-new"; }

std::string frame_name(std::int64_t index) { return fmt::format("frame_{:06}.png", index); }

void require_whole(const fs::path& folder) {
    const fs::path old = folder / old_name;
    const bool is_replaced = has_manifest(folder) && has_manifest(old);
    for (const fs::path& hidden : {old, folder / back_name})
        if (is_regular(hidden / lock_name) && !is_replaced)
            fail(Exit::io,
                 "{}: its update was stopped halfway, its earlier frames are in {}; update it "
                 "again, which first puts them back",
                 folder.string(), hidden.string());
}

CaptureFolder::CaptureFolder(fs::path path, const std::string& scene) : path_(std::move(path)) {
    do {
        made_ = make_folder(path_) || made_;
    } while (!lock());
    try {
        undo_replacement();
        const Earlier earlier = find_earlier(path_);
        if (earlier.manifest && decode_utf8(earlier.manifest->scene) != decode_utf8(scene))
            fail(Exit::io, "{} has a capture of {}, not of {}; remove it or choose another folder",
                 path_.string(), earlier.manifest->scene, scene);
        if (earlier.manifest && earlier.manifest->is_finished()) dead_owner_.clear();
    } catch (...) {
        release();
        throw;
    }
}

CaptureFolder::~CaptureFolder() { release(); }

bool CaptureFolder::lock() {
    const fs::path path = file(lock_name);
    const int descriptor = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (descriptor < 0 && errno == ENOENT) return false;
    if (descriptor < 0)
        fail(Exit::io, "cannot write {}: {}; choose another folder", path.string(),
             system_reason(errno));
    if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) refuse_lock(descriptor, errno);
    if (!is_same_file(descriptor, path)) {
        close(descriptor);
        return false;
    }
    dead_owner_ = read_owner(descriptor);
    if (!dead_owner_.empty() && !dead_owner_.starts_with("process ")) {
        close(descriptor);
        fail(Exit::io, "{} is not from Oiler; rename it or choose another folder", path.string());
    }
    lock_ = descriptor;
    const std::string owner = own_name();
    if (ftruncate(lock_, 0) != 0 ||
        pwrite(lock_, owner.data(), owner.size(), 0) != static_cast<ssize_t>(owner.size())) {
        const int error_number = errno;
        release();
        fail(Exit::io, "cannot write {}: {}; free some space or choose another place",
             path.string(), system_reason(error_number));
    }
    return true;
}

void CaptureFolder::refuse_lock(int descriptor, int reason) const {
    const bool is_in_use = reason == EWOULDBLOCK;
    const std::string owner = is_in_use ? wait_for_owner(descriptor) : read_owner(descriptor);
    if (owner.empty()) unlink(file(lock_name).c_str());  // made by this process
    close(descriptor);
    if (is_in_use)
        fail(Exit::io, "{} is in use: {} captures into it; choose another folder", path_.string(),
             owner);
    fail(Exit::io, "cannot lock {}: {}; choose another folder", path_.string(),
         system_reason(reason));
}

void CaptureFolder::require_present() const {
    if (!is_same_file(lock_, file(lock_name)))
        fail(Exit::io, "{} was removed during the capture; capture again", path_.string());
}

/// The manifest lists no frame before the first one is removed, and is removed last. If this
/// process is killed meanwhile, the manifest is still true and the next capture continues the
/// removal.
void CaptureFolder::clear() {
    Earlier earlier = find_earlier(path_);
    if (earlier.manifest && !earlier.manifest->frames.empty()) {
        earlier.manifest->frames.clear();
        write_file(file(manifest_name), to_json(*earlier.manifest));
    }
    for (const fs::path& path : earlier.files) remove_file(path);
    remove_file(file(manifest_name));
    remove_abandoned_files(path_);
}

void CaptureFolder::replace() {
    const fs::path old = file(old_name);
    try {
        sync_to_disk(path_);
        make_folder(old);
        write_file(old / lock_name, own_name());
        move_capture(path_, old);
        move_capture(folder_of_new(path_), path_);
    } catch (const Error& error) {
        try {
            undo_replacement();
        } catch (const Error&) {
            fail(Exit::io, "{}; the next capture into {} puts the earlier one back", error.what(),
                 path_.string());
        }
        fail(Exit::io, "{}; the earlier capture is as it was, the new one is in {}", error.what(),
             folder_of_new(path_).string());
    }
    try {
        undo_replacement();
    } catch (const Error& error) {
        fail(Exit::io, "{}; the new capture is complete, the next one removes the earlier one",
             error.what());
    }
}

/// Puts the earlier files back, or removes them if the replacement is complete. The manifest moves
/// last in both directions, so it shows how far the replacement came.
void CaptureFolder::undo_replacement() {
    const fs::path old = file(old_name);
    const fs::path back = file(back_name);
    refuse_link(folder_of_new(path_));
    for (const fs::path& hidden : {old, back}) refuse_foreign(hidden);
    if (is_folder(old)) {
        const bool has_any = has_manifest(path_);
        if (has_any && has_manifest(old)) {
            for (const fs::path& path : capture_files(old)) remove_file(path);
            return remove_folder(old);
        }
        if (!has_any) move_capture(path_, folder_of_new(path_));
        move(old, back);
    }
    if (!is_folder(back)) return;
    move_capture(back, path_);
    remove_folder(back);
}

void CaptureFolder::release() {
    if (lock_ < 0) return;
    std::error_code ignored;
    fs::remove(file(lock_name), ignored);
    close(std::exchange(lock_, -1));
    if (made_) fs::remove(path_, ignored);
}

}  // namespace oiler
