// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "oiler/math/vec.hpp"
#include "oiler/picture/picture.hpp"
#include "oiler/scene/keys.hpp"
#include "oiler/scene/scene.hpp"
#include "oiler/toml/document.hpp"

namespace oiler {

/// One table of a scene file. Each value is checked against its entry in scene_keys(). An absent
/// key leaves its target unchanged. All functions throw Error{usage} with file, line and key.
class Section {
public:
    /// Refuses unknown keys of the table `name`.
    Section(std::string_view file, std::string_view name, const Value& value);

    /// Sets the number of components of a vector.
    void set_axes(int axes) { axes_ = axes; }

    void read(std::string_view key, std::string& target) const;
    void read(std::string_view key, std::int64_t& target) const;
    void read(std::string_view key, double& target) const;
    void read(std::string_view key, bool& target) const;
    void read(std::string_view key, Vec3& target) const;
    void read(std::string_view key, Colour& target) const;
    void read(std::string_view key, std::array<std::int64_t, 2>& target) const;
    void read(std::string_view key, std::vector<Vec3>& target) const;
    void read(std::string_view key, std::vector<std::string>& target) const;
    template <class T>
    void read(std::string_view key, std::optional<T>& target) const {
        T given{};
        if (!has(key)) return;
        read(key, given);
        target = given;
    }
    /// Returns one of the key's allowed words; empty if the key is absent.
    [[nodiscard]] std::string word(std::string_view key) const;

    [[nodiscard]] bool has(std::string_view key) const;
    /// Place of a key, or of the table if the key is absent.
    [[nodiscard]] Place place(std::string_view key) const;
    [[nodiscard]] Place place() const { return {file_, value_.line}; }
    [[nodiscard]] std::string_view name() const { return name_; }

private:
    /// Returns null if the key is absent and optional.
    [[nodiscard]] const Value* find(const SceneKey& key) const;
    [[nodiscard]] const SceneKey& entry(std::string_view key) const;
    void refuse_unknown(const Value& member) const;
    [[noreturn]] void refuse_value(const SceneKey& key, const Value& value,
                                   std::string_view hint = {}) const;
    [[nodiscard]] std::string example(const SceneKey& key) const;
    [[nodiscard]] double number(const SceneKey& key, const Value& value) const;
    [[nodiscard]] std::int64_t whole(const SceneKey& key, const Value& value) const;
    [[nodiscard]] const std::string& text(const SceneKey& key, const Value& value) const;
    [[nodiscard]] const std::string& printed(const SceneKey& key, const Value& value,
                                             std::size_t longest) const;
    [[nodiscard]] Vec3 vector(const SceneKey& key, const Value& value) const;

    std::string_view file_;
    std::string_view name_;
    const Value& value_;
    int axes_ = 1;
};

// Checks that need more than one key: numbers fit the scene's precision and agree with each other.
// All throw Error{usage} with file, line and key.

void check_number(const Scene& scene, const Section& section, std::string_view key, double number);
void check_numbers(const Scene& scene, const Section& section, std::string_view key,
                   const Vec3& vector);
void check_matter(const Scene& scene, const Section& section, const SceneMatter& matter);
void check_spring(const Scene& scene, const Section& section, const SceneSpring& spring);
void check_force(const Scene& scene, const Section& section, const SceneForce& force);
void check_plane(const Scene& scene, const Section& section, const Plane& plane);
/// Checks an obstacle of which only the values of `key`, and the values checked before, are given.
void check_obstacle(const Scene& scene, const Section& section, std::string_view key,
                    const Obstacle& obstacle);
void check_grid(const Scene& scene, const Section& section, const SceneGrid& grid);
void check_scatter(const Scene& scene, const Section& section, const SceneScatter& scatter);

/// Checks that the scene has at most `most_forces` forces.
void check_forces(const Scene& scene, const Place& place);

/// Checks that the method can step the forces of the scene.
void check_method(const Scene& scene, const Place& place);

}  // namespace oiler
