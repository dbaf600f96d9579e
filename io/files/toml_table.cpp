#include "io/files/toml_table.h"

#include <charconv>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/error.h"
#include "core/spelling.h"

namespace clsurf::io {

TomlFile::TomlFile(const std::string& path) : TomlFile(map_file(path)) {}

TomlFile::TomlFile(const Source& source) : TomlFile(source.text(), source.name) {}

TomlFile::TomlFile(std::string_view text, std::string name) : name_(std::move(name)) {
    try {
        root_ = toml::parse(text, name_);
    } catch (const toml::parse_error& error) {  // the library reports errors only by exceptions
        const toml::source_position at = error.source().begin;
        throw InputError(Place::of_line(name_, at.line, static_cast<std::uint32_t>(at.column)),
                         std::string(error.description()));
    }
}

void TomlFile::fail(const toml::node& node, const std::string& what, const std::string& hint) const {
    const toml::source_position at = node.source().begin;
    throw InputError(Place::of_line(name_, at.line, static_cast<std::uint32_t>(at.column)), what, hint);
}

void TomlFile::fail(const std::string& what) const { throw InputError(Place::of_file(name_), what); }

void TomlFile::allow(const toml::table& table, const std::vector<std::string_view>& keys) const {
    for (const auto& [key, node] : table) {
        bool found = false;
        for (const std::string_view candidate : keys) found = found || candidate == key.str();
        if (!found)
            fail(node, fmt::format("unknown key '{}'", std::string_view(key.str())), did_you_mean(key.str(), keys));
    }
}

std::optional<bool> TomlFile::boolean(const toml::table& table, std::string_view key) const {
    const toml::node* node = table.get(key);
    if (node == nullptr) return std::nullopt;
    if (!node->is_boolean()) fail(*node, fmt::format("'{}' must be true or false", key));
    return node->value<bool>();
}

std::optional<double> TomlFile::number(const toml::table& table, std::string_view key) const {
    const toml::node* node = table.get(key);
    if (node == nullptr) return std::nullopt;
    const std::optional<double> value = node->value<double>();
    if (!node->is_number() || !value || !std::isfinite(*value)) fail(*node, fmt::format("'{}' must be a number", key));
    return value;
}

std::optional<std::string> TomlFile::text(const toml::table& table, std::string_view key) const {
    const toml::node* node = table.get(key);
    if (node == nullptr) return std::nullopt;
    if (!node->is_string()) fail(*node, fmt::format("'{}' must be a text in quotes", key));
    return node->value<std::string>();
}

std::optional<std::int64_t> TomlFile::integer(const toml::table& table, std::string_view key, std::int64_t low,
                                              std::int64_t high) const {
    const toml::node* node = table.get(key);
    if (node == nullptr) return std::nullopt;
    if (!node->is_integer()) fail(*node, fmt::format("'{}' must be a whole number", key));
    const std::int64_t value = *node->value<std::int64_t>();
    if (value < low || value > high) fail(*node, fmt::format("'{}' is {}, expected {} … {}", key, value, low, high));
    return value;
}

const toml::table* TomlFile::section(const toml::table& table, std::string_view key) const {
    const toml::node* node = table.get(key);
    if (node == nullptr) return nullptr;
    if (!node->is_table()) fail(*node, fmt::format("'{}' must be a table", key));
    return node->as_table();
}

const toml::array* TomlFile::tables(const toml::table& table, std::string_view key) const {
    const toml::node* node = table.get(key);
    if (node == nullptr) return nullptr;
    if (!node->is_array_of_tables()) fail(*node, fmt::format("'{}' must be written as [[{}]]", key, key));
    return node->as_array();
}

double twelve_digits(double value) {
    const std::string digits = fmt::format("{:.11e}", value);
    std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return value + 0.0;
}

}  // namespace clsurf::io
