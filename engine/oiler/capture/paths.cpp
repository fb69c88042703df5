// SPDX-License-Identifier: MIT
#include "oiler/capture/paths.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <optional>
#include <system_error>

#include "oiler/capture/file.hpp"
#include "oiler/core/error.hpp"

namespace oiler {
namespace {

namespace fs = std::filesystem;

/// What a path names: a file, or the place where one would be made.
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

bool are_one_file(const NamedPath& a, const NamedPath& b) {
    if (a.path.empty() || b.path.empty()) return false;
    if (a.path == "-" && b.path == "-") return true;
    const Place place(a.path);
    if (place.is(Place(b.path))) return !place.is_null_device();
    return is_written_by(a, b) || is_written_by(b, a);
}

}  // namespace

void require_openable(const NamedPath& output) {
    if (output.uses || output.path.empty() || output.path == "-") return;
    std::error_code none;
    const fs::file_status found = fs::status(output.path, none);
    if (fs::exists(found) && !fs::is_regular_file(found) && !fs::is_directory(found)) return;
    // Missing folders are made later: a command that fails leaves none.
    if (const fs::path folder = output.path.parent_path();
        folder.empty() || fs::is_directory(folder, none))
        const File probe(output.path);
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
