// SPDX-License-Identifier: MIT
#include "oiler/core/version.hpp"

#include <cstdio>

int main() { std::puts(std::string(oiler::version()).c_str()); }
