// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace oiler {

/// The files of a capture in its folder.
inline constexpr std::string_view manifest_name = "manifest.json";
inline constexpr std::string_view records_name = "frames.jsonl.gz";
[[nodiscard]] std::string frame_name(std::int64_t index);
/// Returns whether the name is that of a file of a capture, or would be taken for one.
[[nodiscard]] bool is_capture_file(std::string_view name);

/// The hidden folder in `folder` for a capture that is to replace the one in it.
[[nodiscard]] std::filesystem::path folder_of_new(const std::filesystem::path& folder);

/// Throws Error{io} if a replacement of the capture in the folder was killed halfway, so that its
/// files are those of two captures.
void require_whole(const std::filesystem::path& folder);

/// A folder that belongs to one capture while that runs. The owner holds a lock on the file
/// .oiler-capture, which the system releases when the process ends in any way. Files of an earlier
/// capture are removed, so that a shorter run does not keep the last frames of a longer one.
class CaptureFolder {
public:
    /// Makes the folder if it is missing, and undoes a replacement that was killed. Throws
    /// Error{io} and changes no file if another process captures into the folder, or if it has
    /// frames of another scene or of another program.
    CaptureFolder(std::filesystem::path path, const std::string& scene);
    /// Removes the lock, and the folder if this object made it and it is empty.
    ~CaptureFolder();
    CaptureFolder(const CaptureFolder&) = delete;
    CaptureFolder& operator=(const CaptureFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::filesystem::path file(std::string_view name) const { return path_ / name; }
    /// Throws Error{io} if the folder was removed or replaced meanwhile.
    void require_present() const;
    /// Removes the files of the earlier capture. Throws Error{io}.
    void clear();
    /// Replaces the files of the earlier capture by those of the complete capture in
    /// `folder_of_new`. Both are on one file system, so that each file moves in one piece, and the
    /// manifest moves last. Throws Error{io} after a failure; the earlier files are then in place,
    /// or in the folder that the error names.
    void replace();
    /// "process 1234 of host" if that process was killed and left an unfinished capture here.
    [[nodiscard]] const std::string& dead_owner() const { return dead_owner_; }

private:
    /// Returns false if the lock file was removed meanwhile.
    [[nodiscard]] bool lock();
    /// Closes the descriptor of a lock that another process has or that the system refuses.
    [[noreturn]] void refuse_lock(int descriptor, int reason) const;
    void undo_replacement();
    void release();

    std::filesystem::path path_;
    std::string dead_owner_;
    int lock_ = -1;  ///< descriptor
    bool made_ = false;
};

}  // namespace oiler
