// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "oiler/capture/file_kind.hpp"

namespace oiler {

/// The treatment of a symbolic link at the path of a file.
enum class Links {
    followed,  ///< for paths that a user names
    replaced,  ///< for names that Oiler chooses within an output folder
};

/// A file that is written completely or not at all, so that a failed, interrupted or killed run
/// leaves no partial frame. Bytes go to a file without a name in the same folder. commit() gives it
/// its name; without it the file disappears. A missing folder is made. What replaces an older file
/// is on the disk before, so that a power failure leaves the old file or the new one.
///
/// With Links::followed, "-" is the standard output. Devices, pipes and the targets of standard
/// output and standard error (/dev/stdout) cannot be replaced and are written in place. With
/// Links::replaced, everything at the path but a folder is replaced.
///
/// Every failure throws Error{io} with the path, the reason and a remedy, but Error{usage} for an
/// older file of another kind. A signal that interrupts the wait for a pipe throws
/// Error{interrupted}.
class File {
public:
    explicit File(const std::filesystem::path& path, const FileKind& kind = kinds::any,
                  Links links = Links::followed);
    ~File();
    File(const File&) = delete;
    File& operator=(const File&) = delete;

    /// Writes are buffered, so a full disk may be reported only by commit().
    void write(std::span<const std::byte> bytes);
    void write(std::string_view text);
    /// For another program that writes the file.
    [[nodiscard]] int descriptor() const { return descriptor_; }

    /// Flushes and gives the file the name part_of(its path) until commit(), so that a killed
    /// program leaves it. Later writes add to it; flush() makes them readable. A failed write
    /// removes it.
    void publish();
    void flush();
    /// Gives the file its name and closes it. No write may follow.
    void commit();

private:
    [[nodiscard]] int open_temporary();
    bool keep_permissions() const;
    void prepare_name();
    void give_name(const std::filesystem::path& name);
    void require_own_part();
    void rename_temporary();
    void close_descriptor();
    [[noreturn]] void fail_write(int error_number);

    std::filesystem::path path_;       // as given by the user, for messages
    std::filesystem::path target_;     // path_, with symbolic links followed or not
    std::filesystem::path temporary_;  // its name before commit(); empty: none
    std::size_t largest_write_;        // bytes; pipes take these completely or not at all
    int descriptor_ = -1;
    bool in_place_ = false;
    bool is_published_ = false;
    int failure_ = 0;  // errno of the first failed write; later ones fail too
    std::string buffer_;
};

/// The name of a published file that is incomplete.
[[nodiscard]] std::filesystem::path part_of(const std::filesystem::path& path);

/// The text of a file. Throws Error{usage} for a missing file, a folder or more than `most` bytes,
/// Error{io} if the machine refuses, Error{interrupted} if a signal ends the wait for a pipe.
[[nodiscard]] std::string read_text(const std::filesystem::path& path,
                                    std::size_t most = 256'000'000);
/// Writes all of `bytes` to `path` through File.
void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes,
                const FileKind& kind = kinds::any, Links links = Links::followed);
void write_file(const std::filesystem::path& path, std::string_view text,
                const FileKind& kind = kinds::any, Links links = Links::followed);

/// Throws Error{io} if the file may not be written, also for a superuser if it is read-only for
/// all.
void require_writable(const std::filesystem::path& path);

/// Makes a new hidden file in a folder, with the permissions of a new file under the user's umask,
/// and locks it. Returns its descriptor and sets `name`, or returns -1 with errno set.
[[nodiscard]] int open_temporary(const std::filesystem::path& folder, std::filesystem::path& name);
/// Removes the temporary files in a folder whose processes were killed: they have ended, and no
/// process, perhaps of another container, holds the lock.
void remove_abandoned_files(const std::filesystem::path& folder);

/// Makes the folder and its parents. Returns whether it was missing. Throws Error(Exit::io).
bool make_folder(const std::filesystem::path& path);

/// A file or folder that a command line names.
struct NamedPath {
    std::string name;            ///< the option or the argument, for messages
    std::filesystem::path path;  ///< empty: none; "-" of an output: the standard output
    /// Empty for a file. For a folder: whether the command reads or writes a file of that name in
    /// it.
    bool (*uses)(std::string_view name) = nullptr;
    /// Of an output file.
    const FileKind* kind = &kinds::any;
};

/// Throws Error{usage} if an output is an input, or if two outputs are one file. Compares files,
/// not names, so that links and relative paths are resolved. The null device may be given several
/// times.
void require_distinct(std::span<const NamedPath> inputs, std::span<const NamedPath> outputs);

/// Removes the temporary files of killed processes where an output is to be.
void remove_abandoned_files(const NamedPath& output);

/// Throws Error{io} if the file of an output cannot be made in its folder, and Error{usage} if it,
/// or a file that is written into an output folder, is of another kind, so that a command fails
/// before its work. Makes neither file nor folder.
void require_openable(const NamedPath& output);

}  // namespace oiler
