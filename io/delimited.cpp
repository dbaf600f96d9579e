// Text with one record a line. Separator: tab, semicolon, comma or blanks, whichever the first data
// lines have. With semicolons a decimal comma is understood. Lines that begin with '#' are comments.
// halsampler writes "sample value value …" separated by blanks, and "overrun" where it lost samples.
#include "io/delimited.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

#include <fmt/format.h>

#include "core/error.h"
#include "core/parallel.h"
#include "core/spelling.h"
#include "io/toml_table.h"

namespace clsurf::io {
namespace {

constexpr std::size_t stretch_bytes = std::size_t{4} << 20;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

struct ColumnPlan {
    std::string name;  ///< empty: the column is passed over
    std::string unit;
    double scale = 1.0;
    double bias = 0.0;
};

struct Mapping {
    char separator = '\0';  ///< '\0': detected
    std::optional<double> period;
    bool halsampler = false;
    struct Entry {
        std::string column;  ///< name in the header, or its number from 0
        ColumnPlan plan;
    };
    std::vector<Entry> entries;
};

Mapping read_mapping(const std::string& path) {
    const TomlFile file(path);
    file.allow(file.root(), {"log", "column"});
    Mapping mapping;
    if (const toml::table* log = file.section(file.root(), "log")) {
        file.allow(*log, {"format", "separator", "period_s"});
        const std::string separator = file.text(*log, "separator").value_or("");
        if (separator.size() > 1) file.fail(*log->get("separator"), "'separator' must be one character");
        if (!separator.empty()) mapping.separator = separator[0];
        mapping.period = file.number(*log, "period_s");
        if (mapping.period && !(*mapping.period > 0)) file.fail(*log->get("period_s"), "'period_s' must be greater than 0");
        const std::string format = file.text(*log, "format").value_or("delimited");
        if (format != "delimited" && format != "halsampler") file.fail(*log->get("format"), "'format' is '" + format + "', expected \"delimited\" or \"halsampler\"");
        mapping.halsampler = format == "halsampler";
    }
    const toml::array* columns = file.tables(file.root(), "column");
    if (columns == nullptr) file.fail("no [[column]]");
    for (const toml::node& node : *columns) {
        const toml::table& entry = *node.as_table();
        file.allow(entry, {"from", "name", "unit", "scale", "bias"});
        Mapping::Entry read;
        const toml::node* from = entry.get("from");
        if (from == nullptr) file.fail(entry, "column without 'from' (its name in the header, or its number from 0)");
        if (from->is_integer()) {
            read.column = fmt::format("{}", *file.integer(entry, "from", 0, 1'000'000));
        } else {
            read.column = *file.text(entry, "from");
        }
        read.plan.name = file.text(entry, "name").value_or("");
        if (read.plan.name.empty()) file.fail(entry, "column without 'name'");
        read.plan.unit = file.text(entry, "unit").value_or("");
        read.plan.scale = file.number(entry, "scale").value_or(1.0);
        read.plan.bias = file.number(entry, "bias").value_or(0.0);
        mapping.entries.push_back(std::move(read));
    }
    return mapping;
}

std::string_view first_line(std::string_view& rest) {
    const std::size_t end = rest.find('\n');
    std::string_view line = rest.substr(0, end);
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

bool is_comment(std::string_view line) {
    const std::size_t at = line.find_first_not_of(" \t");
    return at == std::string_view::npos || line[at] == '#';
}

char detect_separator(std::string_view line) {
    for (const char c : {'\t', ';', ','}) {
        if (line.find(c) != std::string_view::npos) return c;
    }
    return ' ';
}

/// The next field of a line, without blanks and quotes; false: no more.
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

std::vector<std::string> split(std::string_view line, char separator) {
    std::vector<std::string> fields;
    std::string_view field;
    std::size_t at = 0;
    while (next_field(line, at, separator, field)) fields.emplace_back(field);
    return fields;
}

/// A number as text logs write it; NaN where it is none (and `bad` set, unless the field says so).
double parse_number(std::string_view field, bool decimal_comma, bool& bad) {
    bad = false;
    if (!field.empty() && field.front() == '+') field.remove_prefix(1);
    if (field.empty() || field == "nan" || field == "NaN" || field == "-nan") return not_a_number;
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
        return not_a_number;
    }
    return value;
}

bool looks_like_number(std::string_view field) {
    bool bad = false;
    (void)parse_number(field, true, bad);
    return !bad && !field.empty();
}

/// "cmd.x [mm]" → name and unit.
ColumnPlan plan_from_header(std::string_view field) {
    ColumnPlan plan;
    const std::size_t open = field.find('[');
    if (open != std::string_view::npos && field.ends_with(']')) {
        plan.unit = std::string(field.substr(open + 1, field.size() - open - 2));
        field = field.substr(0, open);
        while (!field.empty() && field.back() == ' ') field.remove_suffix(1);
    }
    plan.name = std::string(field);
    return plan;
}

/// Where the data begins, how it is separated and what its columns mean.
struct TextPlan {
    char separator = ',';
    bool decimal_comma = false;
    std::size_t data_begin = 0;        ///< byte
    std::uint64_t first_data_line = 1;
    std::vector<ColumnPlan> columns;
};

TextPlan plan_text(const Source& source, const Mapping* mapping) {
    const std::string_view text = source.text();
    std::string_view rest = text;
    if (rest.starts_with("\xef\xbb\xbf")) rest.remove_prefix(3);
    TextPlan plan;
    std::uint64_t line_number = 0;
    std::string_view line;
    std::string_view before = rest;
    do {
        before = rest;
        line = first_line(rest);
        ++line_number;
    } while (is_comment(line) && !rest.empty());
    plan.separator = mapping != nullptr && mapping->separator != '\0' ? mapping->separator : detect_separator(line);
    plan.decimal_comma = plan.separator != ',';
    const std::vector<std::string> fields = split(line, plan.separator);
    const bool header = std::any_of(fields.begin(), fields.end(), [](const std::string& f) { return !f.empty() && !looks_like_number(f); });
    std::vector<ColumnPlan> named;
    named.reserve(fields.size());
    for (const std::string& field : fields) named.push_back(header ? plan_from_header(field) : ColumnPlan{});
    plan.data_begin = static_cast<std::size_t>((header ? rest.data() : before.data()) - text.data());
    if (header && rest.empty()) plan.data_begin = text.size();
    plan.first_data_line = header ? line_number + 1 : line_number;
    if (mapping == nullptr) {
        if (!header) {
            throw InputError(Place::of_line(source.name, line_number), "no header of channel names",
                             "name the columns with --mapping FILE");
        }
        plan.columns = std::move(named);
        return plan;
    }
    plan.columns.resize(fields.size());
    std::vector<std::string_view> names;
    names.reserve(named.size());
    for (const ColumnPlan& c : named) names.push_back(c.name);
    for (const Mapping::Entry& entry : mapping->entries) {
        std::size_t column = fields.size();
        for (std::size_t i = 0; i < fields.size(); ++i) {
            if (header && (named[i].name == entry.column || fields[i] == entry.column)) column = i;
        }
        if (column == fields.size()) {
            std::size_t number = 0;
            const auto [end, error] = std::from_chars(entry.column.data(), entry.column.data() + entry.column.size(), number);
            if (error == std::errc() && end == entry.column.data() + entry.column.size()) column = number;
        }
        if (column >= fields.size()) {
            throw InputError(Place::of_line(source.name, line_number),
                             fmt::format("the mapping names column '{}', the log has {} columns", entry.column, fields.size()),
                             header ? did_you_mean(entry.column, names) : std::string());
        }
        plan.columns[column] = entry.plan;
    }
    return plan;
}

/// What one stretch of the text holds.
struct Stretch {
    std::size_t begin = 0, end = 0;
    std::uint64_t lines = 0;
    std::vector<std::vector<double>> columns;
    std::size_t rows = 0;
    Diagnostics diagnostics;
};

void read_stretch(const Source& source, const TextPlan& plan, bool halsampler, Stretch& stretch) {
    std::string_view rest = source.text().substr(stretch.begin, stretch.end - stretch.begin);
    stretch.columns.resize(plan.columns.size());
    std::uint64_t number = 0;  // of the line in this stretch
    while (!rest.empty()) {
        const std::string_view line = first_line(rest);
        ++number;
        if (is_comment(line)) continue;
        if (halsampler && line.starts_with("overrun")) {
            stretch.diagnostics.add({Severity::warning, "log.overrun", Place::of_line(source.name, number),
                                     "the sampler lost records here (overrun)", {}});
            continue;
        }
        std::size_t at = 0;
        std::size_t column = 0;
        std::string_view field;
        while (next_field(line, at, plan.separator, field)) {
            if (column >= plan.columns.size()) {
                ++column;
                continue;
            }
            const ColumnPlan& c = plan.columns[column];
            if (!c.name.empty()) {
                bool bad = false;
                const double value = parse_number(field, plan.decimal_comma, bad);
                if (bad) {
                    stretch.diagnostics.add({Severity::warning, "log.bad-number",
                                             Place::of_line(source.name, number, static_cast<std::uint32_t>(field.data() - line.data() + 1)),
                                             fmt::format("'{}' of channel '{}' is no number; taken as missing", field.substr(0, 40), c.name), {}});
                }
                stretch.columns[column].push_back(value * c.scale + c.bias);
            }
            ++column;
        }
        if (column != plan.columns.size()) {
            stretch.diagnostics.add({Severity::warning, "log.ragged-row", Place::of_line(source.name, number),
                                     fmt::format("{} fields, expected {}; missing ones are taken as missing", column, plan.columns.size()), {}});
            for (; column < plan.columns.size(); ++column) {
                if (!plan.columns[column].name.empty()) stretch.columns[column].push_back(not_a_number);
            }
        }
        ++stretch.rows;
    }
    stretch.lines = number;
}

std::vector<Stretch> cut(std::string_view text, std::size_t begin) {
    std::vector<Stretch> stretches;
    while (begin < text.size()) {
        std::size_t end = std::min(text.size(), begin + stretch_bytes);
        if (end < text.size()) {
            end = text.find('\n', end);
            end = end == std::string_view::npos ? text.size() : end + 1;
        }
        stretches.push_back({});
        stretches.back().begin = begin;
        stretches.back().end = end;
        begin = end;
    }
    return stretches;
}

/// Columns that the log owns.
using OwnedColumns = std::vector<std::vector<double>>;

Log open_text(const Source& source, const LogOptions& options, const char* format) {
    std::optional<Mapping> mapping;
    if (!options.mapping.empty()) mapping = read_mapping(options.mapping);
    const TextPlan plan = plan_text(source, mapping ? &*mapping : nullptr);
    const bool halsampler = mapping && mapping->halsampler;
    std::vector<Stretch> stretches = cut(source.text(), plan.data_begin);
    parallel_for(static_cast<std::int64_t>(stretches.size()), 1, [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t k = first; k < last; ++k) read_stretch(source, plan, halsampler, stretches[static_cast<std::size_t>(k)]);
    });
    Log log;
    log.name = source.name;
    log.format = format;
    std::size_t rows = 0;
    std::uint64_t line_offset = plan.first_data_line - 1;
    for (const Stretch& stretch : stretches) {
        rows += stretch.rows;
        Diagnostics placed;
        for (Diagnostic d : stretch.diagnostics.kept()) {
            d.where.number += line_offset;
            placed.add(std::move(d));
        }
        log.diagnostics.append(placed);
        line_offset += stretch.lines;
    }
    if (rows == 0) throw InputError(Place::of_file(source.name), "holds no records");
    log.records = static_cast<PointIndex>(rows);
    auto owned = std::make_shared<OwnedColumns>(plan.columns.size());
    for (std::size_t c = 0; c < plan.columns.size(); ++c) {
        if (plan.columns[c].name.empty()) continue;
        if (log.find(plan.columns[c].name) != nullptr) {
            throw InputError(Place::of_line(source.name, plan.first_data_line), "channel '" + plan.columns[c].name + "' is there twice");
        }
        std::vector<double>& column = (*owned)[c];
        column.reserve(rows);
        for (Stretch& stretch : stretches) {
            column.insert(column.end(), stretch.columns[c].begin(), stretch.columns[c].end());
            stretch.columns[c] = {};
        }
        Channel channel;
        channel.name = plan.columns[c].name;
        channel.unit = plan.columns[c].unit;
        channel.values = {reinterpret_cast<const std::byte*>(column.data()), sizeof(double), log.records, ScalarType::f64, false, 1.0, 0.0};
        log.channels.push_back(std::move(channel));
    }
    log.keep_alive = owned;
    if (options.period) log.period = *options.period;
    else if (mapping && mapping->period) log.period = *mapping->period;
    return log;
}

bool is_text(std::span<const std::byte> head) {
    return std::none_of(head.begin(), head.end(), [](std::byte b) {
        const auto c = static_cast<unsigned char>(b);
        return c < 0x20 && c != '\n' && c != '\r' && c != '\t';
    });
}

std::string_view head_text(std::span<const std::byte> head) { return {reinterpret_cast<const char*>(head.data()), head.size()}; }

}  // namespace

int probe_delimited(std::span<const std::byte> head, const LogOptions& options) {
    if (head.empty() || !is_text(head)) return 0;
    if (!options.mapping.empty()) return 60;
    std::string_view rest = head_text(head);
    if (rest.starts_with("\xef\xbb\xbf")) rest.remove_prefix(3);
    std::string_view line;
    do {
        line = first_line(rest);
    } while (is_comment(line) && !rest.empty());
    // A header that names at least one axis position.
    for (const std::string& field : split(line, detect_separator(line))) {
        const std::string name = plan_from_header(field).name;
        if (name.size() > 2 && (name.starts_with("cmd.") || name.starts_with("fb.") || name.starts_with("act."))) return 80;
    }
    return 0;
}

int probe_halsampler(std::span<const std::byte> head, const LogOptions& options) {
    if (head.empty() || !is_text(head)) return 0;
    std::string_view rest = head_text(head);
    const std::vector<std::string> first = split(first_line(rest), ' ');
    const std::vector<std::string> second = split(first_line(rest), ' ');
    if (first.size() < 4 || first.size() != second.size()) return 0;
    for (const std::string& field : first) {
        if (!looks_like_number(field)) return 0;
    }
    // The sampler counts its samples in the first column.
    bool bad = false;
    const double step = parse_number(second[0], false, bad) - parse_number(first[0], false, bad);
    if (step != 1) return 0;
    return options.mapping.empty() ? 40 : 70;
}

Log open_delimited(const Source& source, const LogOptions& options) { return open_text(source, options, "delimited"); }

Log open_halsampler(const Source& source, const LogOptions& options) {
    if (options.mapping.empty()) {
        throw InputError(Place::of_file(source.name), "halsampler text has no names for its columns",
                         "name them with --mapping FILE (docs/formats/csv.md)");
    }
    return open_text(source, options, "halsampler");
}

}  // namespace clsurf::io
