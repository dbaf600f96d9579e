#include "io/formats/text_mapping.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <unordered_set>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"
#include "core/spelling.h"
#include "io/files/compressed.h"
#include "io/files/toml_table.h"
#include "io/formats/clock_time.h"
#include "io/formats/line_events.h"
#include "io/formats/owned_columns.h"
#include "io/formats/text_head.h"
#include "log/channel.h"

namespace clsurf::io {
namespace {

/// The separator in a table; '\0': none.
char separator_of(const TomlFile& file, const toml::table& table) {
    const std::string separator = file.text(table, "separator").value_or("");
    if (separator.size() > 1) file.fail(*table.get("separator"), "'separator' must be one character");
    return separator.empty() ? '\0' : separator[0];
}

/// A column of a text: its name, or its number from 0.
std::string column_of(const TomlFile& file, const toml::table& table, std::string_view key) {
    const toml::node* node = table.get(key);
    if (node == nullptr)
        file.fail(table, fmt::format("no '{}' (a column: its name in the header, or its number from 0)", key));
    if (node->is_integer()) return fmt::format("{}", *file.integer(table, key, 0, 1'000'000));
    return *file.text(table, key);
}

EventFile read_events(const TomlFile& file, const toml::table& table, const std::string& mapping_path) {
    file.allow(table, {"file", "separator", "at", "from", "line", "scale", "bias"});
    EventFile events;
    const std::optional<std::string> name = file.text(table, "file");
    if (!name || name->empty()) file.fail(table, "events without 'file'");
    events.path = (std::filesystem::path(mapping_path).parent_path() / *name).string();
    events.separator = separator_of(file, table);
    const std::string at = file.text(table, "at").value_or("time");
    if (at != "time" && at != "record")
        file.fail(*table.get("at"), "'at' is '" + at + "', expected \"time\" or \"record\"");
    events.at_records = at == "record";
    events.at = column_of(file, table, "from");
    events.line = column_of(file, table, "line");
    events.scale = file.number(table, "scale").value_or(1.0);
    events.bias = file.number(table, "bias").value_or(0.0);
    return events;
}

}  // namespace

Mapping read_mapping(const std::string& path) {
    const TomlFile file(path);
    file.allow(file.root(), {"log", "column", "events"});
    Mapping mapping;
    if (const toml::table* log = file.section(file.root(), "log")) {
        file.allow(*log, {"format", "separator", "period_s"});
        mapping.separator = separator_of(file, *log);
        mapping.period = file.number(*log, "period_s");
        if (mapping.period && !(*mapping.period > 0))
            file.fail(*log->get("period_s"), "'period_s' must be greater than 0");
        const std::string format = file.text(*log, "format").value_or("delimited");
        if (format != "delimited" && format != "halsampler")
            file.fail(*log->get("format"), "'format' is '" + format + "', expected \"delimited\" or \"halsampler\"");
        mapping.halsampler = format == "halsampler";
    }
    if (const toml::table* events = file.section(file.root(), "events"))
        mapping.events = read_events(file, *events, path);
    const toml::array* columns = file.tables(file.root(), "column");
    if (columns == nullptr) file.fail("no [[column]]");
    for (const toml::node& node : *columns) {
        const toml::table& entry = *node.as_table();
        file.allow(entry, {"from", "name", "unit", "scale", "bias"});
        Mapping::Entry read;
        read.column = column_of(file, entry, "from");
        read.plan.name = file.text(entry, "name").value_or("");
        if (read.plan.name.empty()) file.fail(entry, "column without 'name'");
        read.plan.unit = file.text(entry, "unit").value_or("");
        read.plan.scale = file.number(entry, "scale").value_or(1.0);
        read.plan.bias = file.number(entry, "bias").value_or(0.0);
        mapping.entries.push_back(std::move(read));
    }
    return mapping;
}

std::optional<Mapping> mapping_of(const LogOptions& options) {
    if (options.mapping.empty()) return std::nullopt;
    return read_mapping(options.mapping);
}

std::vector<ColumnPlan> plan_columns(std::span<const SourceColumn> columns, const Mapping* mapping,
                                     const Place& place) {
    refuse_too_many_channels(columns.size(), place);
    std::vector<ColumnPlan> plans(columns.size());
    if (mapping == nullptr) {
        std::unordered_set<std::string> taken;
        for (std::size_t i = 0; i < columns.size(); ++i) {
            plans[i] = columns[i].known;
            if (!taken.insert(plans[i].name).second) {
                plans[i] = {.name = columns[i].name, .unit = {}};
                taken.insert(plans[i].name);
            }
        }
        return plans;
    }
    for (const Mapping::Entry& entry : mapping->entries) {
        std::size_t found = columns.size();
        for (std::size_t i = 0; i < columns.size(); ++i) {
            if (!columns[i].name.empty() && (columns[i].name == entry.column || columns[i].other == entry.column))
                found = i;
        }
        if (found == columns.size()) {
            std::size_t number = 0;
            const auto [end, error] =
                std::from_chars(entry.column.data(), entry.column.data() + entry.column.size(), number);
            if (error == std::errc() && end == entry.column.data() + entry.column.size()) found = number;
        }
        if (found >= columns.size()) {
            std::vector<std::string_view> names;
            for (const SourceColumn& c : columns) names.push_back(c.name);
            throw InputError(
                place,
                fmt::format("the mapping names column '{}', the log has {} columns", entry.column, columns.size()),
                did_you_mean(entry.column, names));
        }
        plans[found] = entry.plan;
    }
    return plans;
}

namespace {

/// Finds columns of times of day, by the first record.
void find_clocks(const TextHead& head, TextPlan& plan, const Place& place) {
    for (std::size_t i = 0; i < std::min(head.first.size(), plan.columns.size()); ++i) {
        ColumnPlan& column = plan.columns[i];
        const std::optional<ClockTime> time = column.name.empty() ? std::nullopt : parse_clock(head.first[i]);
        if (!time) continue;
        if (column.scale != 1)
            throw InputError(place,
                             fmt::format("the mapping scales column '{}', which holds times of day", column.name));
        column.clock = true;
        column.unit = "s";
        if (time->day) plan.day = *time->day;
    }
}

/// Skips columns that are not known and whose first value is a word: a program's name, a mode, a date.
void pass_over_words(const TextHead& head, TextPlan& plan) {
    for (std::size_t i = 0; i < std::min(head.first.size(), plan.columns.size()); ++i) {
        ColumnPlan& column = plan.columns[i];
        bool is_word = false;
        (void)parse_number(head.first[i], true, is_word);
        if (is_word && !parse_clock(head.first[i]) && !is_known_name(column.name))
            plan.words.push_back(std::exchange(column.name, {}));
    }
}

/// Without line feeds all lines would be read as one.
void refuse_cr_line_ends(const Source& source) {
    const std::string_view text = source.text();
    if (text.find('\n') == std::string_view::npos && text.find('\r') != std::string_view::npos)
        throw InputError(Place::of_file(source.name), "its lines end with CR alone, expected LF or CR LF",
                         "convert it first, as with tr '\\r' '\\n'");
}

}  // namespace

TextPlan plan_text(const Source& source, const Mapping* mapping) {
    refuse_cr_line_ends(source);
    const TextHead head = read_head(source.text(), mapping != nullptr ? mapping->separator : '\0');
    const Place place = Place::of_line(source.name, head.line);
    TextPlan plan;
    plan.separator = head.separator;
    plan.decimal_comma = true;  // a comma that does not separate is inside quotes
    plan.data_begin = head.data_begin;
    plan.first_data_line = head.first_data_line;
    if (mapping == nullptr) {
        if (!head.named) throw InputError(place, "no header of channel names", "name the columns with --mapping FILE");
        // Duplicate column names are an error here, without a guess: read_table() reports it.
        plan.columns = head.columns;
        pass_over_words(head, plan);
    } else {
        std::vector<SourceColumn> columns;
        columns.reserve(head.columns.size());
        for (std::size_t i = 0; i < head.columns.size(); ++i)
            columns.push_back({head.titles[i], head.columns[i].name, head.columns[i]});
        plan.columns = plan_columns(columns, mapping, place);
    }
    find_clocks(head, plan, place);
    return plan;
}

std::optional<Mapping> mapping_of_growing(const LogOptions& options) {
    std::optional<Mapping> mapping = mapping_of(options);
    if (mapping && mapping->events)
        throw UsageError(
            fmt::format("{} names block events in a file of their own: such a log cannot be followed", options.mapping),
            "judge it when it is complete, without --follow");
    return mapping;
}

void set_period(Log& log, const LogOptions& options, const Mapping* mapping) {
    if (options.period)
        log.period = *options.period;
    else if (mapping != nullptr && mapping->period)
        log.period = *mapping->period;
}

void add_event_lines(Log& log, const Mapping* mapping, std::optional<std::int64_t> day) {
    if (mapping == nullptr || !mapping->events) return;
    const EventFile& file = *mapping->events;
    if (log.find("line") != nullptr)
        throw InputError(Place::of_file(log.name), "the mapping has both events and a column 'line'");
    Mapping columns;
    columns.separator = file.separator;
    columns.entries = {{file.at, {.name = "at", .unit = {}, .scale = file.scale, .bias = file.bias}},
                       {file.line, {.name = "line", .unit = {}}}};
    // A mapping may come from elsewhere: it must not cause endless reading of a device or a pipe.
    std::error_code error;
    if (std::filesystem::exists(file.path, error) && !std::filesystem::is_regular_file(file.path, error)) {
        throw InputError(Place::of_file(file.path), "is not a regular file, expected block events");
    }
    const Source source = open_source(file.path);
    if (source.bytes.empty()) throw InputError(Place::of_file(source.name), "is empty, expected block events");
    TextPlan plan = plan_text(source, &columns);
    plan.day = day.value_or(plan.day);
    const Log read = read_table(source, plan, "events");
    log.diagnostics.append(read.diagnostics);
    const Channel* at = read.find("at");
    const Channel* line = read.find("line");
    if (at == nullptr || line == nullptr)
        throw InputError(Place::of_file(source.name), "'from' and 'line' of the events are the same column");
    std::vector<LineNumber> lines(static_cast<std::size_t>(read.records));
    copy_block(line->values, 0, lines, 0);
    std::vector<LineEvent> events;
    for (PointIndex i = 0; i < read.records; ++i) {
        const double moment = at->values.at(i);
        if (std::isfinite(moment)) events.push_back({moment, lines[static_cast<std::size_t>(i)], 0});
    }
    const Channel* time = log.find("time");
    if (!file.at_records && time == nullptr && !(log.period > 0)) {
        throw InputError(Place::of_file(log.name),
                         "the events have times, the log has neither a channel 'time' nor a period",
                         "count records with at = \"record\", or give period_s");
    }
    const auto moment_of = [&](PointIndex i) {
        if (file.at_records) return static_cast<double>(i);
        return time != nullptr ? time->values.at(i) : static_cast<double>(i) * log.period;
    };
    std::vector<std::uint32_t> line_of(static_cast<std::size_t>(log.records), 0);
    const std::size_t outside =
        for_each_event(events, log.records, moment_of, [&](PointIndex i, const LineEvent* event) {
            if (event != nullptr) line_of[static_cast<std::size_t>(i)] = event->line;
        });
    if (outside > 0) {
        log.diagnostics.add({Severity::note,
                             "log.events-outside",
                             Place::of_file(source.name),
                             fmt::format("{} of {} block events lie outside the log", outside, events.size()),
                             {}});
    }
    OwnedColumns(log).add("line", "", std::move(line_of));
}

}  // namespace clsurf::io
