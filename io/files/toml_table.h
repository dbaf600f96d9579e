#pragma once
// A TOML file, read strictly: unknown keys and values of the wrong type are errors with
// file and line. Layout, mapping, budget and machine files are read through it.

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <toml++/toml.h>

#include "io/files/mapped_file.h"

namespace clsurf::io {

class TomlFile {
public:
    /// Throws InputError (missing, malformed).
    explicit TomlFile(const std::string& path);
    /// Parses a text as the content of a file of that name. Throws InputError (malformed).
    TomlFile(std::string_view text, std::string name);

    [[nodiscard]] const toml::table& root() const { return root_; }
    /// Throws InputError at the position of a node.
    [[noreturn]] void fail(const toml::node& node, const std::string& what, const std::string& hint = {}) const;
    [[noreturn]] void fail(const std::string& what) const;
    /// Checks that every key of the table is one of these; the error suggests a similar key.
    void allow(const toml::table& table, std::initializer_list<std::string_view> keys) const {
        allow(table, std::vector<std::string_view>(keys));
    }
    void allow(const toml::table& table, const std::vector<std::string_view>& keys) const;
    [[nodiscard]] std::optional<double> number(const toml::table& table, std::string_view key) const;
    [[nodiscard]] std::optional<bool> boolean(const toml::table& table, std::string_view key) const;
    [[nodiscard]] std::optional<std::string> text(const toml::table& table, std::string_view key) const;
    /// An integer in [low, high].
    [[nodiscard]] std::optional<std::int64_t> integer(const toml::table& table, std::string_view key, std::int64_t low,
                                                      std::int64_t high) const;
    /// A table inside `table`; nullptr: missing.
    [[nodiscard]] const toml::table* section(const toml::table& table, std::string_view key) const;
    /// An array of tables, `[[key]]`; nullptr: missing.
    [[nodiscard]] const toml::array* tables(const toml::table& table, std::string_view key) const;

private:
    explicit TomlFile(const Source& source);

    std::string name_;
    toml::table root_;
};

/// Rounds to twelve digits, so that values that are scaled by reading and by writing stay the same. Never −0, which
/// TOML does not have for integers.
[[nodiscard]] double twelve_digits(double value);

}  // namespace clsurf::io
