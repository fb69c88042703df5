// SPDX-License-Identifier: MIT
#include "oiler/physics/precision.hpp"

namespace oiler {

std::string_view name_of(Precision precision) {
    if (precision == Precision::extended) return "long double";
    return precision == Precision::single ? "float" : "double";
}

}  // namespace oiler
