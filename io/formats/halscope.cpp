// LinuxCNC's halscope: the output of "Save log" (docs/formats/scopes.md).
//
// There are two kinds of files (scope_files.c of LinuxCNC):
//   2.10:      "# Sampling period is 1000000 ns", then names and values separated by semicolons, with
//              lines "# Position:" and "# Scale:" about the screen
//   up to 2.9: "Sampling period is 1000000 ns" (or nSec), then "NAME +1.5 NAME +2.5 " for each record
#include "io/formats/known_formats.h"

#include <array>
#include <charconv>

#include "core/error.h"
#include "io/formats/text_mapping.h"

namespace clsurf::io {
namespace {

constexpr std::string_view opening = "Sampling period is ";
constexpr double seconds_per_nanosecond = 1e-9;

/// Pins of motion and joints, by the end of their name.
struct Pin {
    std::string_view name;
    std::string_view channel;  ///< with a final dot: the axis letter is appended
    std::string_view unit;
};
constexpr auto pins = std::to_array<Pin>({
    {"motor-pos-cmd", "cmd.", "mm"},
    {"pos-cmd", "cmd.", "mm"},
    {"motor-pos-fb", "fb.", "mm"},
    {"pos-fb", "fb.", "mm"},
    {"program-line", "line", ""},
    {"current-vel", "speed", "mm/s"},
    {"requested-vel", "requested", "mm/s"},
    {"distance-to-go", "togo", "mm"},
    {"motion-type", "motion", ""},
});

/// The axis of "joint.0.…" (in the order X Y Z A B C U V W; "axis.0.…" up to 2.7) or "axis.x.…"; '\0': none.
char axis_of(std::string_view pin) {
    constexpr std::string_view axes = "xyzabcuvw";
    for (const std::string_view prefix : {"joint.", "axis."}) {
        if (!pin.starts_with(prefix) || pin.size() < prefix.size() + 2 || pin[prefix.size() + 1] != '.') continue;
        const char c = pin[prefix.size()];
        if (prefix == "axis." && axes.find(c) != std::string_view::npos) return c;
        if (c >= '0' && c <= '8') return axes[static_cast<std::size_t>(c - '0')];
    }
    return '\0';
}

ColumnPlan known_pin(const std::string& name) {
    const std::size_t dot = name.rfind('.');
    const std::string_view end = std::string_view(name).substr(dot == std::string::npos ? 0 : dot + 1);
    for (const Pin& pin : pins) {
        if (pin.name != end) continue;
        if (!pin.channel.ends_with('.')) return {.name = std::string(pin.channel), .unit = std::string(pin.unit)};
        if (const char axis = axis_of(name); axis != '\0') {
            const bool rotary = axis >= 'a' && axis <= 'c';
            return {.name = std::string(pin.channel) + axis, .unit = rotary ? "deg" : std::string(pin.unit)};
        }
    }
    return {.name = name, .unit = {}};
}

SourceColumn column_of_pin(const std::string& name) { return {name, {}, known_pin(name)}; }

/// The sampling period [s] of the first line. Throws InputError.
double period_of(std::string_view line, const Source& source) {
    const std::size_t begin = line.find(opening);
    std::int64_t nanoseconds = 0;
    if (begin != std::string_view::npos) {
        const std::string_view number = line.substr(begin + opening.size());
        std::from_chars(number.data(), number.data() + number.size(), nanoseconds);
    }
    if (nanoseconds <= 0) {
        throw InputError(Place::of_line(source.name, 1),
                         "the sampling period is not a whole number of nanoseconds greater than 0");
    }
    return static_cast<double>(nanoseconds) * seconds_per_nanosecond;
}

/// Up to 2.9 each value follows its name; the columns of the names are skipped.
TextPlan plan_named_values(const Source& source, std::string_view rest, const Mapping* mapping) {
    TextPlan plan;
    plan.separator = ' ';
    plan.first_data_line = 2;
    std::string_view line;
    std::string_view before = rest;
    while (!rest.empty()) {
        before = rest;
        line = first_line(rest);
        if (!is_comment(line)) break;
        ++plan.first_data_line;
    }
    plan.data_begin = static_cast<std::size_t>(before.data() - source.text().data());
    const Place place = Place::of_line(source.name, plan.first_data_line);
    const std::vector<std::string> fields = split(line, ' ');
    if (fields.size() < 2 || fields.size() % 2 != 0)
        throw InputError(place, "expected a name and a value of each channel");
    std::vector<SourceColumn> columns;
    for (std::size_t i = 0; i < fields.size(); i += 2) columns.push_back(column_of_pin(fields[i]));
    for (ColumnPlan& column : plan_columns(columns, mapping, place)) {
        plan.columns.emplace_back();
        plan.columns.push_back(std::move(column));
    }
    return plan;
}

TextPlan plan_table(const Source& source, const Mapping* mapping) {
    TextPlan plan = plan_text(source, nullptr);
    plan.decimal_comma = false;
    std::vector<SourceColumn> columns;
    for (const ColumnPlan& column : plan.columns) columns.push_back(column_of_pin(column.name));
    plan.columns = plan_columns(columns, mapping, Place::of_line(source.name, plan.first_data_line - 1));
    return plan;
}

TextPlan plan_of(const Source& source, const Mapping* mapping) {
    std::string_view rest = text_of(source.bytes);
    const std::string_view line = first_line(rest);
    return line.starts_with('#') ? plan_table(source, mapping) : plan_named_values(source, rest, mapping);
}

int probe_halscope(std::span<const std::byte> head, const LogOptions&) {
    if (head.empty() || !is_text(head)) return 0;
    const std::string_view text = text_of(head);
    return text.starts_with(opening) || (text.starts_with("# ") && text.substr(2).starts_with(opening)) ? 95 : 0;
}

/// Channels have the names of their HAL pins, or those of a mapping. Throws InputError with the line.
Log open_halscope(const Source& source, const LogOptions& options) {
    const std::optional<Mapping> mapping = mapping_of(options);
    const Mapping* map = mapping ? &*mapping : nullptr;
    std::string_view rest = text_of(source.bytes);
    const double period = period_of(first_line(rest), source);
    Log log = read_table(source, plan_of(source, map), "halscope");
    log.period = period;
    set_period(log, options, map);
    add_event_lines(log, map);
    return log;
}

RecordFrame frame_halscope(const Source& beginning, const LogOptions& options) {
    const std::optional<Mapping> mapping = mapping_of_growing(options);
    return {plan_of(beginning, mapping ? &*mapping : nullptr).data_begin, 0, false, {}};
}

}  // namespace

const LogFormat halscope_format{"halscope", "LinuxCNC halscope's saved log", probe_halscope, open_halscope,
                                frame_halscope};

}  // namespace clsurf::io
