// SPDX-License-Identifier: MIT
#pragma once

#include "support/shell.hpp"
#include "support/test.hpp"

namespace oiler::test {

/// The same; the program must end with this exit code.
inline Outcome shell(const std::string& line, int exit) {
    Outcome run = shell(line);
    EXPECT_EQ(run.exit, exit) << line << "\n" << run.out << run.err;
    return run;
}

}  // namespace oiler::test
