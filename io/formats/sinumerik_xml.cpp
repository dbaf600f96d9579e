// SINUMERIK Operate: trace sessions as XML (docs/formats/scopes.md).
//
// A trace session:
//   <traceSession> … <traceData> <dataFrame>
//     <frameHeader startTime="…" stopInc="…" dropOuts="0"/>
//     <dataSignal id="f1" name="/Nck/!SD/nckServoDataActPos1stEnc64 [u1, 1]" interval="0.002" …/>
//     <rec time="0.002" f1="12.5"/>        a signal that has not changed is left out
// A missing value is an integer that exceeds the bit pattern of an infinite double.
#include "io/formats/known_formats.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <exception>
#include <unordered_map>

#include <expat.h>
#include <fmt/format.h>

#include "core/error.h"
#include "core/not_finite.h"
#include "io/formats/owned_columns.h"
#include "io/formats/text_mapping.h"

namespace clsurf::io {
namespace {

/// Operate traces have some 20 signals. The limit bounds memory: a record of 15 bytes takes the memory of all signals.
constexpr std::size_t most_signals = 64;
constexpr std::size_t deepest = 64;  ///< nested elements; sessions have five
constexpr double not_measured = 9.2e18;
constexpr std::size_t piece_bytes = std::size_t{1} << 20;

/// NC variables, by the last part of their name without "64" or "32" at its end.
struct Variable {
    std::string_view name;
    std::string_view channel;  ///< with a final dot: the axis letter is appended
    std::string_view unit;
};
constexpr auto variables = std::to_array<Variable>({
    {"cmdContrPos", "cmd.", "mm"},
    {"nckServoDataActPos1stEnc", "fb.", "mm"},
    {"nckServoDataActPos2ndEnc", "act.", "mm"},
    {"nckServoDataActCurr", "current.", "A"},
    {"nckServoDataDrvLoad", "load.", "%"},
    {"nckServoDataCmdTorque", "torque.", "N·m"},
    {"actLineNumber", "line", ""},
});

/// "/Nck/!SD/nckServoDataActPos1stEnc64 [u1, 2]" → fb.y: machine axes 1 to 3 are taken as X, Y, Z.
ColumnPlan known_variable(const std::string& name) {
    const std::size_t bracket = std::min(name.find('['), name.size());
    std::string_view leaf = std::string_view(name).substr(0, bracket);
    while (!leaf.empty() && leaf.back() == ' ') leaf.remove_suffix(1);
    leaf = leaf.substr(leaf.rfind('/') == std::string_view::npos ? 0 : leaf.rfind('/') + 1);
    if (leaf.ends_with("64") || leaf.ends_with("32")) leaf.remove_suffix(2);
    std::size_t at = name.find_first_of(",;", bracket);
    int axis = 0;
    if (at != std::string::npos) {
        at = std::min(name.find_first_not_of(' ', at + 1), name.size());
        std::from_chars(name.data() + at, name.data() + name.size(), axis);
    }
    for (const Variable& variable : variables) {
        if (variable.name != leaf) continue;
        if (!variable.channel.ends_with('.'))
            return {.name = std::string(variable.channel), .unit = std::string(variable.unit)};
        if (axis >= 1 && axis <= 3)
            return {.name = std::string(variable.channel) + "xyz"[axis - 1], .unit = std::string(variable.unit)};
    }
    return {.name = name, .unit = {}};
}

struct Signal {
    SourceColumn column;
    double now = missing<double>;
    std::vector<double> values;
};

class Reader {
public:
    explicit Reader(const Source& source) : source_(source), parser_(XML_ParserCreate(nullptr), XML_ParserFree) {
        if (!parser_) throw std::bad_alloc();
        XML_SetUserData(parser_.get(), this);
        XML_SetElementHandler(
            parser_.get(),
            // Exceptions must not pass through the C library: they are stored and rethrown after it returns.
            [](void* self, const XML_Char* name, const XML_Char** attributes) {
                static_cast<Reader*>(self)->guard([&](Reader& r) { r.open(name, attributes); });
            },
            [](void* self, const XML_Char* name) {
                static_cast<Reader*>(self)->guard([&](Reader& r) { r.close(name); });
            });
        // A trace declares no entities; one that does is an expansion attack.
        XML_SetEntityDeclHandler(parser_.get(), [](void* self, const XML_Char*, int, const XML_Char*, int,
                                                   const XML_Char*, const XML_Char*, const XML_Char*, const XML_Char*) {
            static_cast<Reader*>(self)->guard(
                [](Reader& r) { r.fail("declares an XML entity, which a trace never does"); });
        });
    }

    void read() {
        const std::string_view text = source_.text();
        for (std::size_t at = 0; at < text.size() || at == 0;) {
            const std::size_t size = std::min(piece_bytes, text.size() - at);
            const bool last = at + size == text.size();
            const XML_Status status = XML_Parse(parser_.get(), text.data() + at, static_cast<int>(size), last ? 1 : 0);
            if (thrown_) std::rethrow_exception(thrown_);
            if (status == XML_STATUS_ERROR) {
                // Truncated: a token or an element is still open at the end.
                const XML_Error error = XML_GetErrorCode(parser_.get());
                const bool cut = last && (error == XML_ERROR_NO_ELEMENTS || error == XML_ERROR_UNCLOSED_TOKEN ||
                                          error == XML_ERROR_PARTIAL_CHAR);
                if (!cut || time.empty()) fail(fmt::format("is not valid XML: {}", XML_ErrorString(error)));
                diagnostics.add(
                    {Severity::warning,
                     "log.unclosed",
                     place(),
                     fmt::format("the trace is incomplete and ends here; {} complete records were read", time.size()),
                     {}});
                closed = false;
                return;
            }
            at += size;
            if (last) return;
        }
    }

    std::vector<Signal> signals;
    std::vector<double> time;
    double interval = 0;  ///< [s] the shortest sampling interval of the signals
    std::size_t frames = 0;
    bool closed = true;
    Diagnostics diagnostics;

private:
    template <typename Act>
    void guard(const Act& act) {
        if (thrown_) return;
        try {
            act(*this);
        } catch (...) {
            thrown_ = std::current_exception();
            XML_StopParser(parser_.get(), XML_FALSE);
        }
    }

    [[nodiscard]] Place place() const {
        return Place::of_line(source_.name, XML_GetCurrentLineNumber(parser_.get()),
                              static_cast<std::uint32_t>(XML_GetCurrentColumnNumber(parser_.get()) + 1));
    }
    [[noreturn]] void fail(const std::string& what) const { throw InputError(place(), what); }

    void open(std::string_view name, const XML_Char** attributes) {
        if (++depth_ > deepest) fail(fmt::format("elements nested deeper than {}", deepest));
        if (depth_ == 1 && name != "traceSession")
            fail(fmt::format("the outermost element is '{}', expected 'traceSession'", name.substr(0, 40)));
        if (name == "dataFrame")
            ++frames;
        else if (name == "frameHeader")
            add_frame(attributes);
        else if (name == "dataSignal")
            add_signal(attributes);
        else if (name == "rec")
            add_record(attributes);
    }
    void close(std::string_view) { --depth_; }

    void add_frame(const XML_Char** attributes) {
        for (; *attributes != nullptr; attributes += 2) {
            if (std::string_view(attributes[0]) != "dropOuts") continue;
            const double lost = number(attributes[0], attributes[1]);
            if (lost > 0)
                diagnostics.add({Severity::warning,
                                 "log.overrun",
                                 place(),
                                 fmt::format("the trace lost {:g} records (dropOuts)", lost),
                                 {}});
        }
    }

    void add_signal(const XML_Char** attributes) {
        std::string id, name, description;
        double own_interval = 0;
        for (; *attributes != nullptr; attributes += 2) {
            const std::string_view key = attributes[0];
            if (key == "id")
                id = attributes[1];
            else if (key == "name")
                name = attributes[1];
            else if (key == "description")
                description = attributes[1];
            else if (key == "interval")
                own_interval = number(key, attributes[1]);
        }
        if (id.empty()) fail("a dataSignal without 'id'");
        if (own_interval > 0 && (interval == 0 || own_interval < interval)) interval = own_interval;
        if (name.empty()) name = id;
        const auto [found, is_new] = by_id_.try_emplace(id, signals.size());
        if (!is_new) {
            // Further frames repeat the signals of the first.
            if (frames < 2 || signals[found->second].column.name != name)
                fail(fmt::format("signal '{}' appears twice", id));
            return;
        }
        if (signals.size() == most_signals) fail(fmt::format("more than {} signals", most_signals));
        if (!time.empty()) fail(fmt::format("signal '{}' is declared after the first record", id));
        signals.push_back({{name, description, known_variable(name)}, missing<double>, {}});
    }

    void add_record(const XML_Char** attributes) {
        double now = missing<double>;
        for (; *attributes != nullptr; attributes += 2) {
            const std::string key = attributes[0];
            if (key == "time") {
                now = number(key, attributes[1]);
                continue;
            }
            const auto found = by_id_.find(key);
            if (found == by_id_.end())
                fail(fmt::format("a record has a value of '{}', which no dataSignal names", key.substr(0, 40)));
            const double value = number(key, attributes[1]);
            signals[found->second].now = std::abs(value) > not_measured ? missing<double> : value;
        }
        if (!std::isfinite(now)) fail("a record without 'time'");
        time.push_back(now);
        for (Signal& signal : signals) signal.values.push_back(signal.now);
    }

    /// NaN, with a diagnostic, if it is not a number.
    double number(std::string_view key, const char* text) {
        bool bad = false;
        const double value = parse_number(text, false, bad);
        if (bad) {
            diagnostics.add({Severity::warning,
                             "log.bad-number",
                             place(),
                             fmt::format("'{}' of '{}' is not a number and counts as missing",
                                         std::string_view(text).substr(0, 40), key.substr(0, 40)),
                             {}});
        }
        return value;
    }

    const Source& source_;
    std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser_;
    std::exception_ptr thrown_;
    std::unordered_map<std::string, std::size_t> by_id_;
    std::size_t depth_ = 0;
};

/// Frames count time from their own start. Each is appended one period after the previous one.
void join_frames(std::vector<double>& time, double period) {
    double offset = 0;
    for (std::size_t i = 1; i < time.size(); ++i) {
        if (time[i] + offset < time[i - 1]) offset = time[i - 1] + period - time[i];
        time[i] += offset;
    }
}

int probe_sinumerik_xml(std::span<const std::byte> head, const LogOptions&) {
    const std::string_view text = text_of(head);
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos || text[first] != '<') return 0;
    return text.find("<traceSession") != std::string_view::npos ? 95 : 0;
}

/// One record per `rec`; a missing value keeps the previous one. A truncated trace is read
/// as far as it goes (`log.unclosed`). Throws InputError with line and column.
Log open_sinumerik_xml(const Source& source, const LogOptions& options) {
    const std::optional<Mapping> mapping = mapping_of(options);
    const Mapping* map = mapping ? &*mapping : nullptr;
    Reader reader(source);
    reader.read();
    if (reader.time.empty()) throw InputError(Place::of_file(source.name), "contains no records");

    Log log;
    log.name = source.name;
    log.format = "sinumerik-xml";
    log.closed = reader.closed;
    log.records = static_cast<PointIndex>(reader.time.size());
    log.diagnostics = std::move(reader.diagnostics);
    log.period = reader.interval;
    set_period(log, options, map);
    if (reader.frames > 1) {
        log.diagnostics.add(
            {Severity::note,
             "log.frames",
             Place::of_file(source.name),
             fmt::format(
                 "{} frames of data follow each other; the time between them is not known and taken as one period",
                 reader.frames),
             {}});
        join_frames(reader.time, log.period);
    }
    OwnedColumns owned(log);
    std::vector<SourceColumn> columns;
    for (const Signal& signal : reader.signals) columns.push_back(signal.column);
    const std::vector<ColumnPlan> plans = plan_columns(columns, map, Place::of_file(source.name));
    bool axes_taken = false;
    for (std::size_t i = 0; i < plans.size(); ++i) {
        const ColumnPlan& plan = plans[i];
        if (plan.name.empty()) continue;
        if (log.find(plan.name) != nullptr)
            throw InputError(Place::of_file(source.name), "channel '" + plan.name + "' appears twice");
        axes_taken =
            axes_taken || (map == nullptr && plan.name.find('.') != std::string::npos && plan.name != columns[i].name);
        for (double& value : reader.signals[i].values) value = value * plan.scale + plan.bias;
        owned.add(plan.name, plan.unit, std::move(reader.signals[i].values));
    }
    if (axes_taken) {
        log.diagnostics.add({Severity::note, "log.axes", Place::of_file(source.name),
                             "machine axes 1, 2 and 3 are assumed to be X, Y and Z",
                             "name others with --mapping FILE"});
    }
    if (log.find("time") == nullptr) owned.add("time", "s", std::move(reader.time));
    add_event_lines(log, map);
    return log;
}

}  // namespace

const LogFormat sinumerik_xml_format{"sinumerik-xml", "SINUMERIK Operate trace session (XML)", probe_sinumerik_xml,
                                     open_sinumerik_xml};

}  // namespace clsurf::io
