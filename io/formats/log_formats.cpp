#include <algorithm>
#include <array>

#include "core/error.h"
#include "io/files/compressed.h"
#include "io/formats/foreign_content.h"
#include "io/formats/known_formats.h"
#include "io/formats/log_format.h"
#include "log/channel.h"
#include "log/turns.h"

namespace clsurf::io {
namespace {

/// Warns of position axes without a channel. A lathe has no Y, but a typing error in a mapping looks the same.
void note_still_axes(Log& log) {
    for (const Role role : {Role::commanded, Role::feedback, Role::actual}) {
        if (!log.has(role)) continue;
        for (const char* axis : {".x", ".y", ".z"}) {
            const std::string name = std::string(prefix_of(role)) + axis;
            if (log.find(name) != nullptr) continue;
            log.diagnostics.add({Severity::warning,
                                 "log.axis-missing",
                                 Place::of_file(log.name),
                                 "no channel '" + name + "': this axis is assumed to stay at 0",
                                 {}});
        }
    }
}

constexpr std::size_t probed_bytes = 65536;

}  // namespace

std::span<const LogFormat> log_formats() {
    static const auto table = std::to_array<LogFormat>({
#define LOG_FORMAT(name, source) name##_format,
#include "io/formats/log_formats.def"
#undef LOG_FORMAT
    });
    return table;
}

const LogFormat* recognise_log(const Source& source, const LogOptions& options) {
    const std::span<const std::byte> head = source.bytes.first(std::min(probed_bytes, source.bytes.size()));
    const LogFormat* best = nullptr;
    int best_score = 0;
    for (const std::span<const LogFormat> formats : {log_formats(), options.more_formats}) {
        for (const LogFormat& format : formats) {
            const int score = format.probe(head, options);
            if (score > best_score) {
                best_score = score;
                best = &format;
            }
        }
    }
    return best;
}

Log open_log(const std::string& path, const LogOptions& options) { return open_log(open_source(path), options); }

Log open_log(const Source& source, const LogOptions& options) {
    if (source.bytes.empty()) throw InputError(Place::of_file(source.name), "is empty, expected a log");
    const LogFormat* format = recognise_log(source, options);
    if (format == nullptr) {
        const std::string_view text(reinterpret_cast<const char*>(source.bytes.data()), source.bytes.size());
        if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) {
            throw InputError(Place::of_file(source.name), "is UTF-16 text, expected ASCII or UTF-8",
                             "convert it first, as with iconv -f UTF-16 -t UTF-8");
        }
        if (const std::optional<ForeignTable> table = recognise_table(source))
            throw InputError(Place::of_file(source.name),
                             "is a table of " + describe(*table) + "; no column is named like a position",
                             "use --mapping FILE; clsurf info --suggest-mapping " + source.name +
                                 " -o mapping.toml writes a first version");
        std::string names;
        for (const std::span<const LogFormat> formats : {log_formats(), options.more_formats})
            for (const LogFormat& f : formats) names += (names.empty() ? "" : ", ") + std::string(f.name);
        throw InputError(Place::of_file(source.name), "is not a log in a known format (" + names + ")",
                         "binary records need --layout FILE, a text without channel names needs --mapping FILE");
    }
    return open_log_as(*format, source, options);
}

Log open_log_as(const LogFormat& format, const Source& source, const LogOptions& options) {
    Log log = format.open(source, options);
    normalise_names(log);
    normalise_units(log);
    count_turns_on(log);
    note_still_axes(log);
    if (!(log.period > 0)) log.period = log.measured_period();
    if (!(log.period > 0)) {
        throw InputError(Place::of_file(source.name),
                         "the sampling period is not known: there is no increasing channel 'time'",
                         "give it with --period S, or as period_s in a mapping");
    }
    return log;
}

}  // namespace clsurf::io
