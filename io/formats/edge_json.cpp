// SINUMERIK Edge (Capture4Analysis): high-frequency recordings as JSON (docs/formats/edge.md).
//
// A recording is one JSON object:
//   Header.SignalListHFData[]   the columns: Name ("DES_POS|1"), Axis ("X1")
//   Header.CycleTimeMs          the sampling period
//   Payload[]                   in order of time, one of
//     HFData          rows of numbers; the first column counts cycles (CYCLE)
//     HFBlockEvent    HFProbeCounter: cycle from which the block runs; SeekOffset: its line
//     HFCallEvent     CallStackLevel, Path: this program runs at that level, at line SeekOffset
//     HFTimestamp, LFData         read over
#include "core/letter_case.h"
#include "io/formats/known_formats.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "core/error.h"
#include "core/units.h"
#include "io/formats/edge_recording.h"
#include "io/formats/line_events.h"
#include "io/formats/owned_columns.h"
#include "io/formats/program_identity.h"
#include "io/formats/text_mapping.h"

namespace clsurf::io {
namespace {

constexpr double seconds_per_millisecond = 1e-3;
constexpr std::int64_t deepest_call = 64;
constexpr const char* unknown_program = "(not recorded)";
constexpr double turn_play = 0.05;  ///< [deg] noise of an encoder

/// Signals with a known channel; the axis letter is appended.
struct Known {
    std::string_view signal;
    std::string_view channel;
    std::string_view unit;
    std::string_view rotary_unit;
    bool position = false;
};
constexpr auto known_signals = std::to_array<Known>({
    {"DES_POS", "cmd.", "mm", "deg", true},
    {"ENC_POS", "fb.", "mm", "deg", true},
    {"LOAD", "load.", "%", "%"},
    {"CURRENT", "current.", "A", "A"},
    {"TORQUE", "torque.", "N·m", "N·m"},
});

/// nullptr: its channel is not known.
const Known* known_of(const EdgeRecording::Signal& signal) {
    const std::size_t bar = signal.name.find('|');
    if (bar == std::string::npos) return nullptr;
    const auto* found = std::ranges::find(known_signals, std::string_view(signal.name).substr(0, bar), &Known::signal);
    return found == known_signals.end() ? nullptr : found;
}

/// "X1" → 'x'; '\0': a spindle or an unknown name.
char axis_letter(std::string_view axis) {
    constexpr std::string_view letters = "XYZABCUVW";
    if (axis.empty() || letters.find(axis[0]) == std::string_view::npos) return '\0';
    const bool digits = std::all_of(axis.begin() + 1, axis.end(), [](char c) { return c >= '0' && c <= '9'; });
    return digits ? lower_case(axis[0]) : '\0';
}

bool is_rotary(char letter) { return letter >= 'a' && letter <= 'c'; }

/// Whether a position jumps from one end of a turn to the other: a step differs by a full turn from the steps
/// before and after it. A linear axis never does, whatever its name. Only steps of one cycle count: after a gap the
/// axis may be anywhere.
bool wraps_at_a_turn(const std::vector<double>& position, const std::vector<double>& cycles) {
    for (std::size_t i = 2; i + 1 < position.size(); ++i) {
        const double step = position[i] - position[i - 1];
        if (!(std::abs(step) > deg_per_turn / 2) || cycles[i + 1] - cycles[i - 2] != 3) continue;
        // The next step may jump back over the end of the turn.
        const auto [low, high] = std::minmax({std::remainder(position[i - 1] - position[i - 2], deg_per_turn),
                                              std::remainder(position[i + 1] - position[i], deg_per_turn)});
        const double moved = step - std::copysign(deg_per_turn, step);
        if (moved >= low - turn_play && moved <= high + turn_play) return true;
    }
    return false;
}

/// Rotary axes that have the name of a linear one, for example a spindle Z1.
std::set<std::string> turning_axes(const EdgeRecording& recording, const std::vector<double>& cycles, Log& log) {
    std::set<std::string> axes;
    for (std::size_t i = 0; i < recording.signals.size(); ++i) {
        const EdgeRecording::Signal& signal = recording.signals[i];
        const Known* known = known_of(signal);
        const char letter = axis_letter(signal.axis);
        if (known == nullptr || !known->position || letter == '\0' || is_rotary(letter)) continue;
        if (!wraps_at_a_turn(recording.columns[i], cycles) || !axes.insert(signal.axis).second) continue;
        log.diagnostics.add(
            {Severity::note,
             "log.rotary-axis",
             Place::of_file(log.name),
             fmt::format(
                 "axis '{}' turns: {} jumps by 360 while it moves on. It is not {}: its signals keep their names",
                 signal.axis, signal.name, static_cast<char>(std::toupper(static_cast<unsigned char>(letter)))),
             {}});
    }
    return axes;
}

SourceColumn column_of(const EdgeRecording::Signal& signal, bool turns) {
    SourceColumn column{signal.name, {}, {.name = signal.name, .unit = {}}};
    const char letter = axis_letter(signal.axis);
    const Known* known = known_of(signal);
    if (known == nullptr || letter == '\0') return column;
    column.known.unit = turns || is_rotary(letter) ? known->rotary_unit : known->unit;
    if (!turns) column.known.name = std::string(known->channel) + letter;
    return column;
}

/// Converts events to lines: a block belongs to the innermost program that has been called.
class CallStack {
public:
    explicit CallStack(Log& log) : log_(log) {}

    void add(const EdgeEvent& event) {
        if (event.cycle < 0) {
            ++incomplete_;
            return;
        }
        if (event.call) {
            if (event.level < 0 || event.level > deepest_call) {
                ++incomplete_;
                return;
            }
            // The programs called from this level have ended.
            paths_.resize(static_cast<std::size_t>(event.level) + 1);
            paths_.back() = event.path;
        }
        if (event.line < 0 || event.line > most_line) {
            ++incomplete_;
            return;
        }
        lines_.push_back({static_cast<double>(event.cycle), static_cast<LineNumber>(event.line), program()});
    }

    std::vector<LineEvent> finish() {
        if (incomplete_ > 0) {
            log_.diagnostics.add(
                {Severity::warning,
                 "log.bad-event",
                 Place::of_file(log_.name),
                 fmt::format("{} block or call events lack their cycle, line or level and are ignored", incomplete_),
                 {}});
        }
        return std::move(lines_);
    }

private:
    static constexpr std::int64_t most_line = 0xfffffffe;

    std::uint32_t program() {
        std::string path = paths_.empty() ? std::string() : paths_.back();
        if (path.empty()) path = unknown_program;
        const auto [found, is_new] = numbers_.try_emplace(path, static_cast<std::uint32_t>(log_.programs.size()));
        if (is_new) log_.programs.push_back({path, {}, {}, {}});
        return found->second;
    }

    Log& log_;
    std::vector<std::string> paths_;  ///< index: call level
    std::map<std::string, std::uint32_t> numbers_;
    std::vector<LineEvent> lines_;
    std::size_t incomplete_ = 0;
};

void add_lines(Log& log, OwnedColumns& owned, std::vector<EdgeEvent>& events, const std::vector<double>& cycles) {
    // Events can be repeated and out of order.
    std::stable_sort(events.begin(), events.end(),
                     [](const EdgeEvent& a, const EdgeEvent& b) { return a.cycle < b.cycle; });
    CallStack stack(log);
    for (const EdgeEvent& event : events) stack.add(event);
    std::vector<LineEvent> lines = stack.finish();
    if (lines.empty()) return;
    std::vector<std::uint32_t> line(cycles.size(), 0);
    std::vector<std::uint32_t> program(cycles.size(), lines.front().program);
    const std::size_t outside = for_each_event(
        lines, log.records, [&](PointIndex i) { return cycles[static_cast<std::size_t>(i)]; },
        [&](PointIndex i, const LineEvent* event) {
            if (event == nullptr) return;
            line[static_cast<std::size_t>(i)] = event->line;
            program[static_cast<std::size_t>(i)] = event->program;
        });
    if (outside > 0) {
        log.diagnostics.add(
            {Severity::note,
             "log.events-outside",
             Place::of_file(log.name),
             fmt::format("{} of {} block and call events lie outside the records", outside, lines.size()),
             {}});
    }
    owned.add("line", "", std::move(line));
    owned.add("program", "", std::move(program));
}

int probe_edge(std::span<const std::byte> head, const LogOptions&) {
    const std::string_view text = text_of(head);
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos || text[first] != '{') return 0;
    return text.find("\"SignalListHFData\"") != std::string_view::npos ||
                   text.find("\"HFData\"") != std::string_view::npos
               ? 95
               : 0;
}

/// One record per row of HFData. `line` and `program` come from the block and call events: the line of
/// the innermost active program. A truncated recording is read as far as it goes
/// (`log.unclosed`). Throws InputError with the line of the file. Memory: proportional to the rows.
Log open_edge(const Source& source, const LogOptions& options) {
    const std::optional<Mapping> mapping = mapping_of(options);
    const Mapping* map = mapping ? &*mapping : nullptr;
    EdgeRecording recording = read_edge_recording(source);
    if (recording.rows == 0) throw InputError(Place::of_file(source.name), "contains no records");

    Log log;
    log.name = source.name;
    log.format = "edge";
    log.closed = recording.closed;
    log.records = static_cast<PointIndex>(recording.rows);
    log.diagnostics = std::move(recording.diagnostics);
    OwnedColumns owned(log);
    const auto cycle_signal = std::ranges::find(recording.signals, "CYCLE", &EdgeRecording::Signal::name);
    const auto cycle_column = static_cast<std::size_t>(cycle_signal - recording.signals.begin());
    if (cycle_column == recording.signals.size())
        throw InputError(Place::of_file(source.name), "there is no signal 'CYCLE', which counts the records",
                         "expected it in Header.SignalListHFData");
    const std::vector<double> cycles = recording.columns[cycle_column];
    // A mapping defines the axes itself.
    const std::set<std::string> turning =
        map == nullptr ? turning_axes(recording, cycles, log) : std::set<std::string>{};
    std::vector<SourceColumn> columns;
    for (const EdgeRecording::Signal& signal : recording.signals)
        columns.push_back(column_of(signal, turning.contains(signal.axis)));
    const std::vector<ColumnPlan> plans = plan_columns(columns, map, Place::of_file(source.name));
    for (std::size_t i = 0; i < plans.size(); ++i) {
        if (plans[i].name.empty() || (i == cycle_column && map == nullptr)) continue;
        if (log.find(plans[i].name) != nullptr)
            throw InputError(Place::of_file(source.name), "channel '" + plans[i].name + "' appears twice");
        for (double& value : recording.columns[i]) value = value * plans[i].scale + plans[i].bias;
        owned.add(plans[i].name, plans[i].unit, std::move(recording.columns[i]));
    }
    log.period = recording.cycle_ms * seconds_per_millisecond;
    set_period(log, options, map);
    if (log.find("time") == nullptr && log.period > 0) {
        const auto first = std::ranges::find_if(cycles, [](double cycle) { return std::isfinite(cycle); });
        if (first != cycles.end()) {
            std::vector<double> time(cycles.size());
            for (std::size_t i = 0; i < time.size(); ++i) time[i] = (cycles[i] - *first) * log.period;
            owned.add("time", "s", std::move(time));
        }
    }
    add_event_lines(log, map);
    if (log.find("line") == nullptr) add_lines(log, owned, recording.events, cycles);
    log.metadata = with_programs(recording.about, log.programs);
    return log;
}

}  // namespace

const LogFormat edge_format{"edge", "SINUMERIK Edge high-frequency recording (JSON)", probe_edge, open_edge};

}  // namespace clsurf::io
