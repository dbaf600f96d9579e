#include "io/modbus/register_map.h"

#include <algorithm>
#include <array>
#include <bit>
#include <tuple>

#include "core/spelling.h"
#include "io/files/toml_table.h"
#include "log/channel.h"

namespace clsurf::io {
namespace {

constexpr int last_address = 65535;
constexpr std::size_t longest_name = 23, longest_unit = 8;  // limits of BIIP
constexpr std::array<std::string_view, 2> functions{"holding", "input"};
constexpr std::array<std::string_view, 5> types{"u16", "i16", "u32", "i32", "f32"};
constexpr std::array<std::string_view, 4> orders{"abcd", "cdab", "badc", "dcba"};

/// The index of the word of `key` in `words`, or `otherwise` if the key is missing.
std::size_t read_word(const TomlFile& file, const toml::table& entry, const std::string& key,
                      std::span<const std::string_view> words, std::size_t otherwise) {
    const std::optional<std::string> text = file.text(entry, key);
    if (!text) return otherwise;
    const auto found = std::find(words.begin(), words.end(), *text);
    if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
    std::string all;
    for (const std::string_view word : words) all += (all.empty() ? "" : ", ") + std::string(word);
    file.fail(*entry.get(key), "'" + key + "' is '" + *text + "', not one of " + all, did_you_mean(*text, words));
}

/// Names with a meaning that a channel sampled a few times per second must not have.
bool is_reserved(const std::string& name) {
    const std::string known = normalised_name(name);
    return known == "time" || known == "line" || known == "program" || is_position(known) ||
           (is_known_name(name) && name.size() == 1);  // an axis without role
}

std::string read_name(const TomlFile& file, const toml::table& entry) {
    const std::optional<std::string> name = file.text(entry, "name");
    if (!name || name->empty()) file.fail(entry, "channel without 'name'");
    const toml::node& node = *entry.get("name");
    if (name->size() > longest_name) file.fail(node, "the name '" + *name + "' is longer than 23 bytes");
    if (is_reserved(*name)) {
        file.fail(node, "'" + *name + "' cannot come from Modbus: registers are read too slowly and not at one moment",
                  "a channel of another name is possible, for example display." + *name);
    }
    return *name;
}

int read_slave(const TomlFile& file, const toml::table& table, int otherwise) {
    // 248 … 254 are reserved, 0 is broadcast, 255 is the device itself behind a TCP address.
    const auto slave = file.integer(table, "slave", 1, 255);
    if (slave && *slave > 247 && *slave < 255)
        file.fail(*table.get("slave"), "slaves have the numbers 1 … 247, or 255");
    return static_cast<int>(slave.value_or(otherwise));
}

RegisterChannel read_channel(const TomlFile& file, const std::string& path, const toml::table& entry, int slave) {
    file.allow(entry, {"name", "unit", "function", "address", "type", "order", "scale", "bias", "slave"});
    RegisterChannel channel;
    channel.where = Place::of_line(path, entry.source().begin.line);
    channel.name = read_name(file, entry);
    channel.unit = file.text(entry, "unit").value_or("");
    if (channel.unit.size() > longest_unit)
        file.fail(*entry.get("unit"), "the unit '" + channel.unit + "' is longer than 8 bytes");
    if (entry.get("function") == nullptr) file.fail(entry, "channel without 'function', \"holding\" or \"input\"");
    const std::size_t function = read_word(file, entry, "function", functions, 0);
    channel.function = function == 0 ? RegisterFunction::holding : RegisterFunction::input;
    if (entry.get("type") == nullptr) file.fail(entry, "channel without 'type'");
    channel.type = static_cast<RegisterType>(read_word(file, entry, "type", types, 0));
    channel.order = static_cast<ByteOrder>(read_word(file, entry, "order", orders, 0));
    if (entry.get("order") != nullptr && channel.registers() == 1)
        file.fail(*entry.get("order"), "'order' applies only to values in two registers");
    const std::optional<std::int64_t> address = file.integer(entry, "address", 0, last_address);
    if (!address) file.fail(entry, "channel without 'address'");
    channel.address = static_cast<int>(*address);
    if (channel.address + channel.registers() - 1 > last_address)
        file.fail(*entry.get("address"), "the second register would be beyond address 65535");
    channel.scale = file.number(entry, "scale").value_or(1.0);
    channel.bias = file.number(entry, "bias").value_or(0.0);
    channel.slave = read_slave(file, entry, slave);
    return channel;
}

}  // namespace

std::string_view name_of(RegisterFunction function) { return functions[function == RegisterFunction::input ? 1 : 0]; }
std::string_view name_of(RegisterType type) { return types[static_cast<std::size_t>(type)]; }
std::string_view name_of(ByteOrder order) { return orders[static_cast<std::size_t>(order)]; }

int RegisterChannel::registers() const { return type == RegisterType::u16 || type == RegisterType::i16 ? 1 : 2; }

double RegisterChannel::value(std::span<const std::uint16_t> words) const {
    const auto scaled = [&](auto raw) { return static_cast<double>(raw) * scale + bias; };
    if (type == RegisterType::u16) return scaled(words[0]);
    if (type == RegisterType::i16) return scaled(static_cast<std::int16_t>(words[0]));
    const bool low_first = order == ByteOrder::cdab || order == ByteOrder::dcba;
    const bool swapped = order == ByteOrder::badc || order == ByteOrder::dcba;
    const auto word = [&](std::size_t i) -> std::uint32_t {
        const std::uint32_t w = words[i];
        return swapped ? (w >> 8 | (w & 0xff) << 8) : w;
    };
    const std::uint32_t bits = word(low_first ? 1 : 0) << 16 | word(low_first ? 0 : 1);
    if (type == RegisterType::u32) return scaled(bits);
    if (type == RegisterType::i32) return scaled(static_cast<std::int32_t>(bits));
    return scaled(std::bit_cast<float>(bits));
}

std::vector<RegisterChannel> read_register_map(const std::string& path) {
    const TomlFile file(path);
    file.allow(file.root(), {"slave", "channel"});
    const int slave = read_slave(file, file.root(), 1);
    const toml::array* entries = file.tables(file.root(), "channel");
    if (entries == nullptr) file.fail("no [[channel]]");
    std::vector<RegisterChannel> channels;
    for (const toml::node& node : *entries) {
        RegisterChannel channel = read_channel(file, path, *node.as_table(), slave);
        for (const RegisterChannel& other : channels) {
            if (other.name == channel.name) file.fail(node, "channel '" + channel.name + "' appears twice");
        }
        channels.push_back(std::move(channel));
    }
    return channels;
}

std::vector<RegisterBlock> blocks_of(std::span<const RegisterChannel> channels) {
    std::vector<std::size_t> sorted(channels.size());
    for (std::size_t i = 0; i < sorted.size(); ++i) sorted[i] = i;
    const auto place = [&](std::size_t i) {
        const RegisterChannel& c = channels[i];
        return std::tuple(c.slave, c.function, c.address, i);
    };
    std::sort(sorted.begin(), sorted.end(), [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
    std::vector<RegisterBlock> blocks;
    for (const std::size_t i : sorted) {
        const RegisterChannel& channel = channels[i];
        const int end = channel.address + channel.registers();
        const bool joins = !blocks.empty() && blocks.back().slave == channel.slave &&
                           blocks.back().function == channel.function &&
                           channel.address <= blocks.back().address + blocks.back().count &&
                           end - blocks.back().address <= most_registers;
        if (!joins) blocks.push_back({channel.slave, channel.function, channel.address, 0, {}});
        blocks.back().count = std::max(blocks.back().count, end - blocks.back().address);
        blocks.back().channels.push_back(i);
    }
    return blocks;
}

}  // namespace clsurf::io
