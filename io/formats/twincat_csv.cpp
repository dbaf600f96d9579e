// TwinCAT Scope: text exports (docs/formats/scopes.md).
//
// The text export of TwinCAT Scope has some lines about the file, an empty line, a header of the
// channels with one property per line, an empty line, and the records. In the lines of the header, a cell that
// repeats the name of the property is above a column of times; the cells after it are the channels with
// these times:
//   Name<tab>cmd.x<tab>cmd.y<tab>Name<tab>load
//   SampleTime[ms]<tab>1<tab>1<tab>SampleTime[ms]<tab>10
//   <empty>
//   0<tab>1,5<tab>2<tab>0<tab>17
// Times are milliseconds from the start, or 100 ns since 1601 ("full timestamp"). The last line may be EOF.
#include "io/formats/known_formats.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/error.h"
#include "io/formats/owned_columns.h"
#include "io/formats/text_mapping.h"
#include "log/held_values.h"

namespace clsurf::io {
namespace {

constexpr std::uint64_t most_header_lines = 200;
constexpr double least_file_time = 1e15;  ///< longer than any recording [ms]: units of 100 ns since 1601
constexpr double file_time_per_millisecond = 1e4;
constexpr double seconds_per_millisecond = 1e-3;

struct ScopeHeader {
    TextPlan plan;
    std::vector<std::size_t>
        time_column;         ///< index of the time column of each column; its own index: a column of times
    double sample_time = 0;  ///< [ms] the shortest; 0: not given
};

/// "mm (Length)" → "mm"; "(None)" → nothing.
std::string unit_text(const std::string& cell) { return cell.substr(0, std::min(cell.find('('), cell.find(" ("))); }

/// The cells of the header lines, beginning with the channel names.
struct HeaderRows {
    std::vector<std::vector<std::string>> rows;
    std::uint64_t name_line = 0;
};

/// Reads the header; sets the separator and the start of the records in `plan`.
HeaderRows read_rows(const Source& source, TextPlan& plan) {
    const std::string_view text = source.text();
    std::string_view rest = text_of(source.bytes);
    plan.separator = rest.size() > 4 ? rest[4] : '\t';  // the character after "Name"
    plan.decimal_comma = plan.separator != ',';
    HeaderRows header;
    std::uint64_t number = 0;
    bool data = false;
    std::string_view before = rest;
    while (!rest.empty() && !data) {
        before = rest;
        const std::string_view line = first_line(rest);
        if (++number > most_header_lines) break;
        const std::size_t end = std::min(line.find(plan.separator), line.size());
        data = looks_like_number(line.substr(0, end));
        if (data) break;
        // The first "Name" is that of the file; the channels begin at the second.
        if (number > 1 && line.substr(0, end) == "Name") {
            header.rows.clear();
            header.name_line = number;
        }
        if (header.name_line > 0 && end > 0) header.rows.push_back(split(line, plan.separator));
    }
    if (header.name_line == 0)
        throw InputError(Place::of_line(source.name, std::min<std::uint64_t>(number, most_header_lines)),
                         "no line of channel names (\"Name\") in the header of a TwinCAT Scope export");
    if (!data) throw InputError(Place::of_line(source.name, number), "no records follow the header");
    plan.data_begin = static_cast<std::size_t>(before.data() - text.data());
    plan.first_data_line = number;
    return header;
}

/// The properties of column i. `sample_time` [ms]: reduced to the sample time of the column if that is shorter.
SourceColumn read_column(const std::vector<std::vector<std::string>>& rows, std::size_t i, double& sample_time) {
    const std::string& name = rows[0][i];
    SourceColumn column{name, {}, {.name = name, .unit = {}}};
    for (const std::vector<std::string>& row : rows) {
        if (i >= row.size()) continue;
        if (row[0] == "Unit") column.known.unit = unit_text(row[i]);
        if (row[0] == "SymbolName") column.other = row[i];
        if (row[0] == "SampleTime[ms]" || row[0] == "SampleTime") {
            bool bad = false;
            const double t = parse_number(row[i], true, bad);
            if (t > 0 && (sample_time == 0 || t < sample_time)) sample_time = t;
        }
    }
    return column;
}

ScopeHeader read_header(const Source& source, const Mapping* mapping) {
    ScopeHeader header;
    const auto [rows, name_line] = read_rows(source, header.plan);
    std::vector<SourceColumn> columns;
    std::size_t time = 0;
    for (std::size_t i = 0; i < rows[0].size(); ++i) {
        const std::string& name = rows[0][i];
        if (name == "Name") time = i;
        header.time_column.push_back(time);
        if (name == "Name" || name.empty()) {  // some exports end their lines with a separator
            columns.emplace_back();
            continue;
        }
        columns.push_back(read_column(rows, i, header.sample_time));
    }
    const Place place = Place::of_line(source.name, name_line);
    header.plan.columns = plan_columns(columns, mapping, place);
    for (std::size_t i = 0; i < columns.size(); ++i) {
        ColumnPlan& column = header.plan.columns[i];
        const bool is_time = header.time_column[i] == i;
        if (is_time)
            column = {.name = fmt::format("time column {}", i), .unit = "ms"};
        else if (columns[i].name.empty())
            column.name.clear();
    }
    return header;
}

/// The end of the records: the position of the last line EOF, or of its beginning in a truncated file.
std::size_t end_of_records(std::string_view text) {
    std::size_t end = text.size();
    while (end > 0 && (text[end - 1] == '\n' || text[end - 1] == '\r')) --end;
    const std::size_t line = text.substr(0, end).rfind('\n') + 1;
    return std::string_view("EOF").starts_with(text.substr(line, end - line)) ? line : text.size();
}

/// The times of a column as written. NaN: an empty or damaged cell.
std::vector<double> written_times(const Channel& channel) {
    std::vector<double> t(static_cast<std::size_t>(channel.values.count));
    copy_block(channel.values, 0, t);
    return t;
}

bool is_known(double time) { return std::isfinite(time); }

/// Milliseconds are not changed. File times become milliseconds since the first time of all file time columns.
void count_from_first(std::vector<std::vector<double>>& columns) {
    const auto first_of = [](const std::vector<double>& times) {
        const auto first = std::ranges::find_if(times, is_known);
        return first == times.end() ? -std::numeric_limits<double>::infinity() : *first;
    };
    double origin = std::numeric_limits<double>::infinity();
    for (const std::vector<double>& times : columns) {
        if (first_of(times) > least_file_time) origin = std::min(origin, first_of(times));
    }
    for (std::vector<double>& times : columns) {
        if (!(first_of(times) > least_file_time)) continue;
        for (double& time : times) time = (time - origin) / file_time_per_millisecond;
    }
}

/// The time per record between the first two records with times; infinity: fewer than two records have times.
double first_step(const std::vector<double>& times) {
    const auto first = std::find_if(times.begin(), times.end(), is_known);
    if (first == times.end()) return std::numeric_limits<double>::infinity();
    const auto second = std::find_if(first + 1, times.end(), is_known);
    if (second == times.end()) return std::numeric_limits<double>::infinity();
    return (*second - *first) / static_cast<double>(second - first);
}

/// Replaces each missing time by the previous one: all that is known of a damaged time is that it is not earlier.
std::vector<double> filled(std::vector<double> times) {
    for (std::size_t i = 1; i < times.size(); ++i) {
        if (!std::isfinite(times[i])) times[i] = times[i - 1];
    }
    return times;
}

/// A log that has only these times [ms].
Log clock_of(std::vector<double> times) {
    Log log;
    log.records = static_cast<PointIndex>(times.size());
    OwnedColumns(log).add("time", "ms", std::move(times));
    return log;
}

/// Times of the records [ms], for each column of times; the others are empty.
struct TimeColumns {
    std::vector<std::vector<double>> of;
    std::size_t fastest = 0;  ///< the column with the smallest first step, whose records are used
};

TimeColumns read_times(const Source& source, const ScopeHeader& header, const Log& read) {
    TimeColumns times;
    times.of.resize(header.plan.columns.size());
    bool found = false;
    double least_step = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < header.time_column.size(); ++i) {
        if (header.time_column[i] == i) times.of[i] = written_times(*read.find(header.plan.columns[i].name));
    }
    count_from_first(times.of);
    for (std::size_t i = 0; i < header.time_column.size(); ++i) {
        if (header.time_column[i] != i) continue;
        const double step = first_step(times.of[i]);
        if (!found || step < least_step) {
            found = true;
            times.fastest = i;
            least_step = step;
        }
    }
    if (!found) throw InputError(Place::of_line(source.name, header.plan.first_data_line), "no column of times");
    return times;
}

int probe_twincat(std::span<const std::byte> head, const LogOptions&) {
    const std::string_view text = text_of(head);
    if (!text.starts_with("Name") || text.size() < 5 || (text[4] != '\t' && text[4] != ';' && text[4] != ',')) return 0;
    for (const std::string_view word : {"Starttime of export", "StartRecord"}) {
        if (text.find(word) < 2000) return 95;
    }
    return 0;
}

/// One record per sample of the channels with the shortest sampling time; slower channels keep their
/// last value until the next one (note `log.held`). Throws InputError with the line.
Log open_twincat(const Source& source, const LogOptions& options) {
    const std::optional<Mapping> mapping = mapping_of(options);
    const Mapping* map = mapping ? &*mapping : nullptr;
    ScopeHeader header = read_header(source, map);
    header.plan.data_end = end_of_records(source.text());
    const Log read = read_table(source, header.plan, "twincat");

    const TimeColumns times = read_times(source, header, read);
    const std::vector<double>& base = times.of[times.fastest];

    Log log;
    log.name = source.name;
    log.format = "twincat";
    log.records = read.records;
    log.diagnostics = read.diagnostics;
    OwnedColumns owned(log);
    const Log clock = clock_of(filled(base));
    const HoldRule hold{0, std::numeric_limits<double>::infinity()};
    std::size_t held_channels = 0;
    for (std::size_t i = 0; i < header.plan.columns.size(); ++i) {
        const ColumnPlan& column = header.plan.columns[i];
        if (column.name.empty() || header.time_column[i] == i) continue;
        const Channel& channel = *read.find(column.name);
        const std::vector<double>& own = times.of[header.time_column[i]];
        if (header.time_column[i] == times.fastest || own == base) {
            std::vector<double> values(static_cast<std::size_t>(log.records));
            copy_block(channel.values, 0, values);
            owned.add(column.name, column.unit, std::move(values));
        } else {
            ++held_channels;
            owned.add(column.name, column.unit, held_values(clock_of(own), channel, clock, hold));
        }
    }
    if (held_channels > 0) {
        log.diagnostics.add(
            {Severity::note,
             "log.held",
             Place::of_line(source.name, header.plan.first_data_line),
             held_channels == 1
                 ? std::string(
                       "1 channel has different times from the fastest one; between its samples it keeps the last value")
                 : fmt::format(
                       "{} channels have different times from the fastest one; between their samples they keep the last value",
                       held_channels),
             {}});
    }
    if (log.find("time") == nullptr) owned.add("time", "ms", base);
    if (header.sample_time > 0) log.period = header.sample_time * seconds_per_millisecond;
    set_period(log, options, map);
    add_event_lines(log, map);
    return log;
}

}  // namespace

const LogFormat twincat_format{"twincat", "TwinCAT Scope's text export", probe_twincat, open_twincat};

}  // namespace clsurf::io
