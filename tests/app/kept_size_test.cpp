// SPDX-License-Identifier: MIT
// The size that a user gave to a window.
#include "oiler/app/kept_size.hpp"

#include <cstdlib>
#include <fstream>

#include "support/folder.hpp"
#include "support/test.hpp"

namespace oiler::test {
namespace {

TEST(KeptSize, IsInTheFolderOfStates) {
    ASSERT_EQ(setenv("HOME", "/home/ada", 1), 0);
    ASSERT_EQ(setenv("XDG_STATE_HOME", "/states", 1), 0);
    EXPECT_EQ(file_of_size("jump"), "/states/oiler/jump.size");
    ASSERT_EQ(unsetenv("XDG_STATE_HOME"), 0);
    EXPECT_EQ(file_of_size("jump"), "/home/ada/.local/state/oiler/jump.size");
    ASSERT_EQ(unsetenv("HOME"), 0);
    EXPECT_TRUE(file_of_size("jump").empty());
}

TEST(KeptSize, IsReadAsItWasWritten) {
    const Folder folder;
    const std::filesystem::path file = folder / "new" / "jump.size";
    EXPECT_FALSE(read_size(file));
    write_size(file, {1600, 903});
    EXPECT_EQ(read_size(file)->width, 1600);
    EXPECT_EQ(read_size(file)->height, 903);
    write_size(file, {800, 600});
    EXPECT_EQ(read_size(file)->width, 800);
}

TEST(KeptSize, IsNamedWithItsFileIfItIsNone) {
    const Folder folder;
    const std::filesystem::path file = folder / "jump.size";
    std::ofstream(file) << "16:9";
    EXPECT_EQ(line_of_error(Exit::usage, [&] { static_cast<void>(read_size(file)); }),
              file.string() +
                  ": expected a size such as 1280x720, got '16:9'; "
                  "remove the file");
    EXPECT_THROW(write_size(file / "jump.size", {1, 1}), Error);
}

}  // namespace
}  // namespace oiler::test
