#include "io/formats/text_table.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/counted.h"
#include "core/error.h"
#include "core/not_finite.h"
#include "core/parallel.h"
#include "io/formats/clock_time.h"
#include "io/formats/owned_columns.h"

namespace clsurf::io {
namespace {

constexpr std::size_t chunk_bytes = std::size_t{4} << 20;
/// Missing fields per byte of text. The limit bounds memory: a header of a million columns above empty rows would
/// otherwise ask for any amount.
constexpr std::size_t most_missing_of_byte = 8;

/// The next field of a line, without blanks and quotes; false: no more fields.
bool next_field(std::string_view line, std::size_t& at, char separator, std::string_view& field) {
    if (separator == ' ') {
        while (at < line.size() && (line[at] == ' ' || line[at] == '\t')) ++at;
        if (at >= line.size()) return false;
        const std::size_t begin = at;
        while (at < line.size() && line[at] != ' ' && line[at] != '\t') ++at;
        field = line.substr(begin, at - begin);
        return true;
    }
    if (at > line.size()) return false;
    std::size_t end = at;
    if (end < line.size() && line[end] == '"') {
        end = line.find('"', end + 1);
        end = end == std::string_view::npos ? line.size() : end + 1;
    }
    end = std::min(line.find(separator, end), line.size());
    field = line.substr(at, end - at);
    at = end + 1;
    while (!field.empty() && (field.front() == ' ' || field.front() == '"')) field.remove_prefix(1);
    while (!field.empty() && (field.back() == ' ' || field.back() == '"')) field.remove_suffix(1);
    return true;
}

/// Seconds since midnight of a day, or NaN.
double parse_time(std::string_view field, std::int64_t day, bool& bad) {
    const std::optional<ClockTime> time = parse_clock(field);
    bad = !time && !field.empty();
    return time ? time->since(day) : missing<double>;
}

/// A clock without a date restarts at midnight.
void go_on_after_midnight(std::vector<double>& seconds) {
    constexpr double day = 86400;
    double days = 0;
    double before = missing<double>;
    for (double& second : seconds) {
        second += days;
        if (second < before - 0.5 * day) {
            days += day;
            second += day;
        }
        if (std::isfinite(second)) before = second;
    }
}

/// The content of one section of the text.
struct Chunk {
    std::size_t begin = 0, end = 0;
    std::uint64_t lines = 0;
    std::vector<std::vector<double>> columns;
    std::size_t rows = 0;
    std::size_t missing = 0;         ///< fields that are missing in rows
    std::size_t wide = 0;            ///< rows that have more fields than columns …
    std::uint64_t first_wide = 0;    ///< … the line of the first one in this section …
    std::size_t fields_of_wide = 0;  ///< … and its fields
    Diagnostics diagnostics;
};

/// Whether a line is the last one of a text, without a line end and with fewer fields than the others: its writer was
/// interrupted. `rest`: the text after the line.
bool is_cut(std::string_view text, std::string_view rest, std::string_view line, const TextPlan& plan) {
    if (!rest.empty() || line.data() + line.size() != text.data() + text.size()) return false;
    std::size_t at = 0;
    std::size_t fields = 0;
    std::string_view field;
    while (next_field(line, at, plan.separator, field)) ++fields;
    return fields < plan.columns.size();
}

/// Throws if most rows have more fields than the header.
void refuse_wide_rows(const Source& source, const TextPlan& plan, const std::vector<Chunk>& chunks) {
    std::size_t wide = 0, rows = 0;
    for (const Chunk& chunk : chunks) {
        wide += chunk.wide;
        rows += chunk.rows;
    }
    if (2 * wide <= rows) return;
    std::uint64_t before = plan.first_data_line - 1;
    for (const Chunk& chunk : chunks) {
        if (chunk.wide > 0)
            throw InputError(
                Place::of_line(source.name, before + chunk.first_wide),
                fmt::format("a row has {} fields, the header {}", chunk.fields_of_wide, plan.columns.size()),
                plan.separator == ',' ? "with decimal commas the separator cannot be a comma" : "");
        before += chunk.lines;
    }
}

/// Reads the fields of a row into the columns. Returns their number; `wide`: there are values beyond the last column.
std::size_t read_row(const Source& source, const TextPlan& plan, std::string_view line, std::uint64_t number,
                     Chunk& chunk, bool& wide) {
    std::size_t at = 0;
    std::size_t column = 0;
    std::string_view field;
    wide = false;
    for (; next_field(line, at, plan.separator, field); ++column) {
        if (column >= plan.columns.size()) {
            wide = wide || !field.empty();
            continue;
        }
        const ColumnPlan& c = plan.columns[column];
        if (c.name.empty()) continue;
        bool bad = false;
        const double value = c.clock ? parse_time(field, plan.day, bad) : parse_number(field, plan.decimal_comma, bad);
        if (bad) {
            chunk.diagnostics.add(
                {Severity::warning,
                 "log.bad-number",
                 Place::of_line(source.name, number, static_cast<std::uint32_t>(field.data() - line.data() + 1)),
                 fmt::format("'{}' of channel '{}' is not a {} and counts as missing", field.substr(0, 40), c.name,
                             c.clock ? "time of day" : "number"),
                 {}});
        }
        chunk.columns[column].push_back(value * c.scale + c.bias);
    }
    return column;
}

void read_chunk(const Source& source, const TextPlan& plan, Chunk& chunk) {
    std::string_view rest = source.text().substr(chunk.begin, chunk.end - chunk.begin);
    chunk.columns.resize(plan.columns.size());
    const std::size_t columns = plan.columns.size();
    std::uint64_t number = 0;  // number of the line in this section
    const auto warn = [&](const char* code, std::string text) {
        chunk.diagnostics.add({Severity::warning, code, Place::of_line(source.name, number), std::move(text), {}});
    };
    while (!rest.empty()) {
        const std::string_view line = first_line(rest);
        ++number;
        if (is_comment(line)) continue;
        if (plan.overruns && line.starts_with("overrun")) {
            warn("log.overrun", "the sampler lost records here (overrun)");
            continue;
        }
        if (is_cut(source.text(), rest, line, plan)) {
            warn("log.incomplete", "the last line is incomplete and is left out");
            continue;
        }
        bool wide = false;
        std::size_t column = read_row(source, plan, line, number, chunk, wide);
        if (column != columns) {
            warn("log.ragged-row", fmt::format("{}, expected {}; {}", counted(column, "field"), columns,
                                               column > columns ? "the last ones are ignored"
                                                                : "those that are not there count as missing"));
            if (wide && chunk.wide++ == 0) {
                chunk.first_wide = number;
                chunk.fields_of_wide = column;
            }
            for (; column < columns; ++column) {
                if (plan.columns[column].name.empty()) continue;
                if (++chunk.missing > most_missing_of_byte * (chunk.end - chunk.begin)) return;
                chunk.columns[column].push_back(missing<double>);
            }
        }
        ++chunk.rows;
    }
    chunk.lines = number;
}

std::vector<Chunk> cut(std::string_view text, std::size_t begin) {
    std::vector<Chunk> chunks;
    while (begin < text.size()) {
        std::size_t end = std::min(text.size(), begin + chunk_bytes);
        if (end < text.size()) {
            end = text.find('\n', end);
            end = end == std::string_view::npos ? text.size() : end + 1;
        }
        chunks.push_back({});
        chunks.back().begin = begin;
        chunks.back().end = end;
        begin = end;
    }
    return chunks;
}

}  // namespace

std::string_view first_line(std::string_view& rest) {
    const std::size_t end = rest.find('\n');
    std::string_view line = rest.substr(0, end);
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

bool is_comment(std::string_view line) {
    const std::size_t at = line.find_first_not_of(" \t");
    if (at == std::string_view::npos || line[at] == '#' || line[at] == '%') return true;
    return line.substr(at).starts_with("//") || line.starts_with("sep=");  // Excel's separator
}

char detect_separator(std::string_view line) {
    constexpr std::string_view separators = "\t;,";
    std::size_t best = separators.size();
    bool quoted = false;
    char before = separators.front();
    for (const char c : line) {
        const bool begins_field = before == ' ' || separators.find(before) != std::string_view::npos;
        if (c == '"' && (quoted || begins_field)) quoted = !quoted;
        if (!quoted) best = std::min(best, separators.find(c));
        before = c;
    }
    return best < separators.size() ? separators[best] : ' ';
}

std::vector<std::string> split(std::string_view line, char separator) {
    std::vector<std::string> fields;
    std::string_view field;
    std::size_t at = 0;
    while (fields.size() <= most_channels && next_field(line, at, separator, field)) fields.emplace_back(field);
    return fields;
}

/// A number as text logs write it; NaN if it is not one (then `bad` is set, unless the field says NaN).
double parse_number(std::string_view field, bool decimal_comma, bool& bad) {
    bad = false;
    if (!field.empty() && field.front() == '+') field.remove_prefix(1);
    if (field.empty() || field == "nan" || field == "NaN" || field == "-nan") return missing<double>;
    std::array<char, 64> buffer;
    if (decimal_comma && field.size() < buffer.size() && field.find(',') != std::string_view::npos) {
        std::copy(field.begin(), field.end(), buffer.begin());
        std::replace(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(field.size()), ',', '.');
        field = {buffer.data(), field.size()};
    }
    double value = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(value)) {
        bad = true;
        return missing<double>;
    }
    return value;
}

bool looks_like_number(std::string_view field) {
    bool bad = false;
    (void)parse_number(field, true, bad);
    return !bad && !field.empty();
}

bool is_value(std::string_view field) { return looks_like_number(field) || parse_clock(field); }

/// "cmd.x [mm]", "Time (ms)" → name and unit.
ColumnPlan plan_from_header(std::string_view field) {
    ColumnPlan plan;
    const char close = field.empty() ? ' ' : field.back();
    const std::size_t open = close == ']' ? field.rfind('[') : close == ')' ? field.rfind('(') : std::string_view::npos;
    if (open != std::string_view::npos) {
        plan.unit = std::string(field.substr(open + 1, field.size() - open - 2));
        field = field.substr(0, open);
        while (!field.empty() && field.back() == ' ') field.remove_suffix(1);
    }
    plan.name = std::string(field);
    return plan;
}

bool is_text(std::span<const std::byte> head) {
    return std::none_of(head.begin(), head.end(), [](std::byte b) {
        const auto c = static_cast<unsigned char>(b);
        return c < 0x20 && c != '\n' && c != '\r' && c != '\t';
    });
}

std::string_view text_of(std::span<const std::byte> bytes) {
    std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    return text;
}

Log read_table(const Source& source, const TextPlan& plan, const char* format) {
    refuse_too_many_channels(plan.columns.size(), Place::of_line(source.name, plan.first_data_line));
    std::vector<Chunk> chunks = cut(source.text().substr(0, plan.data_end), plan.data_begin);
    parallel_for(static_cast<std::int64_t>(chunks.size()), 1, [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t k = first; k < last; ++k) read_chunk(source, plan, chunks[static_cast<std::size_t>(k)]);
    });
    Log log;
    log.name = source.name;
    log.format = format;
    std::size_t rows = 0;
    std::uint64_t line_offset = plan.first_data_line - 1;
    for (Chunk& chunk : chunks) {
        rows += chunk.rows;
        chunk.diagnostics.move_places(line_offset);
        if (chunk.missing > most_missing_of_byte * (chunk.end - chunk.begin)) {
            throw InputError(
                chunk.diagnostics.kept().front().where,
                fmt::format("most rows lack nearly all of the {} columns that the header names", plan.columns.size()));
        }
        log.diagnostics.append(chunk.diagnostics);
        line_offset += chunk.lines;
    }
    refuse_wide_rows(source, plan, chunks);
    if (rows == 0) throw InputError(Place::of_file(source.name), "contains no records");
    log.records = static_cast<PointIndex>(rows);
    if (!plan.words.empty()) {
        const std::string more = plan.words.size() > 1 ? fmt::format(" (and {} more)", plan.words.size() - 1) : "";
        log.diagnostics.add(
            {Severity::note,
             "log.words",
             Place::of_line(source.name, plan.first_data_line),
             fmt::format("column '{}'{} begins with a word and is ignored", plan.words.front().substr(0, 40), more),
             {}});
    }
    OwnedColumns owned(log);
    for (std::size_t c = 0; c < plan.columns.size(); ++c) {
        if (plan.columns[c].name.empty()) continue;
        if (log.find(plan.columns[c].name) != nullptr) {
            throw InputError(Place::of_line(source.name, plan.first_data_line),
                             "channel '" + plan.columns[c].name + "' appears twice");
        }
        std::vector<double> column;
        column.reserve(rows);
        for (Chunk& chunk : chunks) {
            column.insert(column.end(), chunk.columns[c].begin(), chunk.columns[c].end());
            chunk.columns[c] = {};
        }
        if (plan.columns[c].clock) go_on_after_midnight(column);
        owned.add(plan.columns[c].name, plan.columns[c].unit, std::move(column));
    }
    return log;
}

}  // namespace clsurf::io
