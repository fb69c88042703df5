// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include "oiler/lab/ledger/parts.hpp"
#include "oiler/scene/make_world.hpp"

namespace oiler::lab {
namespace {

/// "anchor.x", "anchor.y", "stiffness": the first field may be a vector.
std::vector<std::string> number_names(const Stored& stored) {
    static const std::vector<std::string_view> vector{""};
    static const std::vector<std::string_view> mass{"mass"};
    static const std::vector<std::string_view> contact{"radius"};
    const auto& forces = force_descriptions();
    const auto force = std::find_if(forces.begin(), forces.end(),
                                    [&](const auto& words) { return words.name == stored.of; });
    const auto& fields = force != forces.end()    ? force->numbers
                         : stored.of == "mass"    ? mass
                         : stored.of == "contact" ? contact
                                                  : vector;
    const std::size_t axes = stored.shared.size() - fields.size() + 1;
    std::vector<std::string> names;
    for (std::size_t axis = 0; axis < axes; ++axis) {
        const std::string name(fields[0]);
        const std::string dot = name.empty() || axes == 1 ? "" : ".";
        const bool with_axis = name.empty() || axes > 1;
        names.push_back(name + dot + (with_axis ? std::string(1, "xyz"[axis]) : ""));
    }
    names.insert(names.end(), fields.begin() + 1, fields.end());
    return names;
}

void add_columns(Ledger& ledger, const Stored& stored) {
    const auto own = std::count(stored.shared.begin(), stored.shared.end(), false);
    const std::vector<std::string> names = number_names(stored);
    for (std::size_t i = 0; i < names.size(); ++i)
        ledger.columns.push_back(
            {.of = std::string(stored.of),
             .index = stored.index,
             .number = names[i],
             .shared = stored.shared[i],
             .bytes = stored.shared[i] ? 0 : stored.bytes / static_cast<std::size_t>(own),
             .bodies = static_cast<std::int64_t>(stored.rows)});
}

/// Adds the handle that World keeps for each body.
void add_handle(Ledger& ledger) {
    for (const auto& [number, bytes] : {std::pair{"generation", sizeof(Entity::generation)},
                                        std::pair{"row of entity", sizeof(Entity::index)},
                                        std::pair{"entity of row", sizeof(Entity::index)}})
        ledger.columns.push_back(
            {.of = "handle", .number = number, .bytes = bytes, .bodies = ledger.bodies});
}

}  // namespace

std::vector<std::string_view> enter_columns(Ledger& ledger, const Bodies& bodies) {
    ledger.bodies = static_cast<std::int64_t>(bodies.size());
    ledger.links = static_cast<std::int64_t>(bodies.link_count());
    if (ledger.links > 0)
        ledger.bytes_per_link =
            static_cast<double>(bodies.bytes_of_links()) / static_cast<double>(ledger.links);
    std::vector<std::string_view> names;
    for (const Stored& stored : bodies.stored()) {
        add_columns(ledger, stored);
        names.push_back(stored.of);
    }
    add_handle(ledger);
    std::vector<std::string_view> forces;
    for (const ForceDescription& words : force_descriptions())
        if (std::find(names.begin(), names.end(), words.name) != names.end())
            forces.push_back(words.name);
        else
            ledger.absent.emplace_back(words.plural);
    if (ledger.links == 0) ledger.absent.emplace_back("links");
    return forces;
}

double Ledger::bytes_per_body() const {
    double bytes = 0;
    for (const LedgerColumn& column : columns) bytes += static_cast<double>(column.bytes);
    if (links == 0) return bytes;
    return bytes + static_cast<double>(links) * bytes_per_link / static_cast<double>(bodies);
}

}  // namespace oiler::lab
