// Foreign fixed-record logs, described by a layout file (docs/formats/layout.md).
#include "io/formats/known_formats.h"

#include <array>

#include <fmt/format.h>

#include "core/error.h"
#include "core/spelling.h"
#include "io/files/toml_table.h"

namespace clsurf::io {
namespace {

constexpr std::array<std::string_view, 10> type_names{"i8",  "u8",  "i16", "u16", "i32",
                                                      "u32", "i64", "u64", "f32", "f64"};
constexpr std::int64_t most_bytes = std::int64_t{1} << 31;

ScalarType type_of(const TomlFile& file, const toml::table& entry) {
    const std::optional<std::string> name = file.text(entry, "type");
    if (!name) file.fail(entry, "channel without 'type'");
    for (std::size_t i = 0; i < type_names.size(); ++i) {
        if (*name == type_names[i]) return static_cast<ScalarType>(i + 1);
    }
    file.fail(*entry.get("type"), "unknown type '" + *name + "'", did_you_mean(*name, type_names));
}

Channel read_channel(const TomlFile& file, const toml::table& entry, std::int64_t record_bytes) {
    file.allow(entry, {"name", "type", "offset", "unit", "scale", "bias"});
    Channel channel;
    channel.name = file.text(entry, "name").value_or("");
    if (channel.name.empty()) file.fail(entry, "channel without 'name'");
    channel.unit = file.text(entry, "unit").value_or("");
    channel.values.type = type_of(file, entry);
    const std::optional<std::int64_t> offset = file.integer(entry, "offset", 0, most_bytes);
    if (!offset) file.fail(entry, "channel without 'offset'");
    if (*offset + static_cast<std::int64_t>(size_of(channel.values.type)) > record_bytes) {
        file.fail(entry, fmt::format("channel '{}' at byte {} does not fit a record of {} bytes", channel.name, *offset,
                                     record_bytes));
    }
    channel.values.stride = static_cast<std::size_t>(*offset);  // the offset in the record, until the data are known
    channel.values.scale = file.number(entry, "scale").value_or(1.0);
    channel.values.bias = file.number(entry, "bias").value_or(0.0);
    return channel;
}

/// Certain if the user names a layout: plain records cannot be recognised.
int probe_layout(std::span<const std::byte>, const LogOptions& options) { return options.layout.empty() ? 0 : 99; }

/// Channels are views on the records, as the layout describes. Throws InputError; adds `log.unclosed` for left-over bytes.
Log open_layout(const Source& source, const LogOptions& options) {
    const TomlFile file(options.layout);
    file.allow(file.root(), {"log", "channel"});
    const toml::table* head = file.section(file.root(), "log");
    if (head == nullptr) file.fail("no [log] table");
    file.allow(*head, {"endian", "header_bytes", "record_bytes", "period_s"});
    const std::string endian = file.text(*head, "endian").value_or("little");
    if (endian != "little" && endian != "big")
        file.fail(*head->get("endian"), "'endian' is '" + endian + "', expected \"little\" or \"big\"");
    const std::int64_t header_bytes = file.integer(*head, "header_bytes", 0, most_bytes).value_or(0);
    const std::optional<std::int64_t> record_bytes = file.integer(*head, "record_bytes", 1, most_bytes);
    if (!record_bytes) file.fail(*head, "no 'record_bytes'");
    const std::optional<double> period = file.number(*head, "period_s");
    if (!period && !options.period) file.fail(*head, "no 'period_s'");

    Log log;
    log.name = source.name;
    log.format = "layout";
    log.period = options.period.value_or(period.value_or(0));
    if (!(log.period > 0)) file.fail(*head->get("period_s"), "'period_s' must be greater than 0");
    log.keep_alive = source.keep_alive;
    if (source.bytes.size() < static_cast<std::size_t>(header_bytes)) {
        throw InputError(Place::of_file(source.name),
                         fmt::format("file of {} bytes is shorter than the layout's header of {} bytes",
                                     source.bytes.size(), header_bytes));
    }
    const std::size_t data = source.bytes.size() - static_cast<std::size_t>(header_bytes);
    log.records = static_cast<PointIndex>(data / static_cast<std::size_t>(*record_bytes));
    if (const std::size_t left = data % static_cast<std::size_t>(*record_bytes); left != 0) {
        log.closed = false;
        log.diagnostics.add(
            {Severity::warning, "log.unclosed", Place::of_byte(source.name, source.bytes.size() - left),
             fmt::format("{} bytes are left over after {} whole records of {} bytes", left, log.records, *record_bytes),
             "check record_bytes of the layout"});
    }
    const toml::array* channels = file.tables(file.root(), "channel");
    if (channels == nullptr) file.fail("no [[channel]]");
    for (const toml::node& node : *channels) {
        Channel channel = read_channel(file, *node.as_table(), *record_bytes);
        if (log.find(channel.name) != nullptr) file.fail(node, "channel '" + channel.name + "' appears twice");
        channel.values.first = source.bytes.data() + header_bytes + channel.values.stride;
        channel.values.stride = static_cast<std::size_t>(*record_bytes);
        channel.values.count = log.records;
        channel.values.big_endian = endian == "big";
        log.channels.push_back(std::move(channel));
    }
    return log;
}

RecordFrame frame_layout(const Source& beginning, const LogOptions& options) {
    (void)open_layout(beginning, options);
    const TomlFile file(options.layout);
    const toml::table& head = *file.section(file.root(), "log");
    RecordFrame frame;
    frame.head_bytes = static_cast<std::size_t>(file.integer(head, "header_bytes", 0, most_bytes).value_or(0));
    frame.record_bytes = static_cast<std::size_t>(file.integer(head, "record_bytes", 1, most_bytes).value_or(1));
    return frame;
}

}  // namespace

const LogFormat layout_format{"layout", "fixed binary records, described by --layout FILE", probe_layout, open_layout,
                              frame_layout};

}  // namespace clsurf::io
