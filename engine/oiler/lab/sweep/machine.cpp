// SPDX-License-Identifier: MIT
#include "oiler/lab/sweep/machine.hpp"

#include <algorithm>
#include <fstream>
#include <thread>

#include "oiler/core/version.hpp"

namespace oiler::lab {

Machine this_machine() {
    Machine machine{.cpu = "unknown",
                    .cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency())),
                    .compiler = compiler()};
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        if (!line.starts_with("model name")) continue;
        machine.cpu = line.substr(std::min(line.size(), line.find(':') + 2));
        break;
    }
    return machine;
}

}  // namespace oiler::lab
