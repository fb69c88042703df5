// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "oiler/scene/read.hpp"
#include "scene/bad_files.hpp"
#include "support/oscillator.hpp"
#include "support/text.hpp"

namespace oiler::test {
namespace {

TEST(BadScenes, AreRefusedInOneLineWithFileLineAndKey) {
    const std::vector<BadFile> files = bad_files();
    EXPECT_GE(files.size(), 200U);
    for (const BadFile& file : files) {
        SCOPED_TRACE(file.path);
        const std::string line = line_of_error(Exit::usage, [&] { (void)read_scene(file.path); });
        const std::string place = file.path + ":" + std::to_string(file.line) + ": ";
        EXPECT_EQ(line.substr(0, place.size()), place) << line;
        EXPECT_TRUE(holds(line.substr(std::min(place.size(), line.size())), file.message)) << line;
        EXPECT_EQ(line.find('\n'), std::string::npos) << line;
        EXPECT_LE(line.size(), file.path.size() + 400) << line;
    }
}

}  // namespace
}  // namespace oiler::test
