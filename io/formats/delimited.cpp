// Text logs (docs/formats/csv.md): CSV and TSV with a header of channel names, and LinuxCNC's halsampler text. A mapping file
// names, scales and converts columns if the log does not.
//
// One record per line. Separator: tab, semicolon, comma or blanks, detected from the first data
// lines. With semicolons a decimal comma is allowed. Comments: text_table.h.
// halsampler writes "sample value value …" separated by blanks, and "overrun" if it lost samples.
#include "io/formats/known_formats.h"

#include <algorithm>

#include "core/error.h"
#include "io/formats/text_head.h"
#include "io/formats/text_mapping.h"
#include "log/channel.h"

namespace clsurf::io {
namespace {

/// Dense columns. A bad number becomes NaN with a diagnostic that names line and column
/// (`log.bad-number`); a short or long row has the diagnostic `log.ragged-row`. Throws InputError: no
/// channels, no period. O(bytes), parallel by sections of the text.
Log open_text(const Source& source, const LogOptions& options, const char* format) {
    const std::optional<Mapping> mapping = mapping_of(options);
    const Mapping* map = mapping ? &*mapping : nullptr;
    TextPlan plan = plan_text(source, map);
    plan.overruns = mapping && mapping->halsampler;
    Log log = read_table(source, plan, format);
    set_period(log, options, map);
    add_event_lines(log, map, plan.day);
    return log;
}

int probe_delimited(std::span<const std::byte> head, const LogOptions& options) {
    if (head.empty() || !is_text(head)) return 0;
    // A mapping describes the log: the program that is given with it must not be taken for a log.
    if (!options.mapping.empty()) {
        const std::vector<std::string> first = read_head(text_of(head)).first;
        return std::any_of(first.begin(), first.end(), is_value) ? 60 : 0;
    }
    // A log has a position column with a role in its name, or x, y and z without roles.
    // For a lathe, two of these and a clock suffice.
    std::size_t axes = 0;
    bool clock = false;
    for (const ColumnPlan& column : read_head(text_of(head)).columns) {
        const std::string name = normalised_name(column.name);
        if (is_position(name)) return 80;
        axes += name == "x" || name == "y" || name == "z" ? 1 : 0;
        clock = clock || name == "time";
    }
    return axes == 3 || (axes == 2 && clock) ? 70 : 0;
}

int probe_halsampler(std::span<const std::byte> head, const LogOptions& options) {
    if (head.empty() || !is_text(head)) return 0;
    std::string_view rest = text_of(head);
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

/// The frame of a growing log in either text format.
RecordFrame frame_text(const Source& beginning, const LogOptions& options) {
    const std::optional<Mapping> mapping = mapping_of_growing(options);
    return {plan_text(beginning, mapping ? &*mapping : nullptr).data_begin, 0, mapping && mapping->halsampler, {}};
}

}  // namespace

const LogFormat halsampler_format{"halsampler", "LinuxCNC halsampler text, columns named by --mapping FILE",
                                  probe_halsampler, open_halsampler, frame_text};
const LogFormat delimited_format{"delimited", "CSV or TSV with a header of channel names, or with --mapping FILE",
                                 probe_delimited, open_delimited, frame_text};

}  // namespace clsurf::io
