// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace oiler::house {

/// The definitions of a C++ text at the scope of named namespaces.
struct Definitions {
    /// Qualified names of types, concepts, aliases and variables ("oiler::Range"), and signatures
    /// of functions that have a body ("oiler::ticks(Range,int)").
    std::vector<std::string> names;
    /// False if brackets do not match; `names` is then unreliable.
    bool balanced = true;
};

/// Finds the definitions of a file. Forward declarations, members, template specialisations and
/// the contents of anonymous namespaces do not count. Reads statements, not C++: it does not
/// expand macros and takes both branches of an #if.
Definitions find_definitions(const std::string& text);

/// The headers that a file includes, in order.
std::vector<std::string> find_includes(const std::string& text);

}  // namespace oiler::house
