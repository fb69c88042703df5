// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "oiler/picture/picture.hpp"
#include "oiler/scene/document.hpp"
#include "oiler/scene/keys.hpp"
#include "oiler/scene/refuse.hpp"
#include "oiler/math/vec.hpp"

namespace oiler {

/// One table of a scene file, read by the list of keys: each value is checked against its entry
/// there, and what an absent key means is left to the target. All throw Error{usage} with file,
/// line and key.
class Section {
public:
    /// Refuses members that are no keys of the table `name`.
    Section(std::string_view file, std::string_view name, const Value& value);

    /// How many numbers a vector has.
    void set_axes(int axes) { axes_ = axes; }

    void read(std::string_view key, std::string& target) const;
    void read(std::string_view key, std::int64_t& target) const;
    void read(std::string_view key, double& target) const;
    void read(std::string_view key, bool& target) const;
    void read(std::string_view key, Vec3& target) const;
    void read(std::string_view key, Colour& target) const;
    void read(std::string_view key, std::array<std::int64_t, 2>& target) const;
    template <class T>
    void read(std::string_view key, std::optional<T>& target) const {
        T given{};
        if (!has(key)) return;
        read(key, given);
        target = given;
    }
    /// One of the words of the key's entry; empty where it is absent.
    [[nodiscard]] std::string word(std::string_view key) const;

    [[nodiscard]] bool has(std::string_view key) const;
    /// Of a key, or of the table where it does not have it.
    [[nodiscard]] Place place(std::string_view key) const;
    [[nodiscard]] Place place() const { return {file_, value_.line}; }
    [[nodiscard]] std::string_view name() const { return name_; }

private:
    /// Null where the key is absent and need not be there.
    [[nodiscard]] const Value* find(const SceneKey& key) const;
    [[nodiscard]] const SceneKey& entry(std::string_view key) const;
    void refuse_unknown(const Value& member) const;
    [[noreturn]] void refuse_value(const SceneKey& key, const Value& value,
                                   std::string_view hint = {}) const;
    [[nodiscard]] std::string example(const SceneKey& key) const;
    [[nodiscard]] double number(const SceneKey& key, const Value& value) const;
    [[nodiscard]] std::int64_t whole(const SceneKey& key, const Value& value) const;
    [[nodiscard]] const std::string& text(const SceneKey& key, const Value& value) const;

    std::string_view file_;
    std::string_view name_;
    const Value& value_;
    int axes_ = 1;
};

}  // namespace oiler
