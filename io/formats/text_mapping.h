#pragma once
// Mapping files (docs/formats/csv.md): which columns of a log become which channels, and where its
// block events stand when they are in a second file.
// Used inside io only.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/place.h"
#include "io/formats/log_format.h"
#include "io/formats/text_table.h"

namespace clsurf::io {

/// Block events in a text of their own: from `at` on, a line of the program is active.
struct EventFile {
    std::string path;
    char separator = '\0';    ///< '\0': detected
    bool at_records = false;  ///< `at` counts records from 0; else it is a time as the log's own
    std::string at;           ///< column: its name in the header, or its number from 0
    std::string line;         ///< column of the line in the program
    double scale = 1.0;       ///< at · scale + bias is the log's clock
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
    std::optional<EventFile> events;
};

/// Reads a mapping file. Throws InputError with its line.
[[nodiscard]] Mapping read_mapping(const std::string& path);

/// The mapping of the options, where they name one.
[[nodiscard]] std::optional<Mapping> mapping_of(const LogOptions& options);

/// A column as the file names it, and what it is called here without a mapping.
struct SourceColumn {
    std::string name;   ///< as the file has it
    std::string other;  ///< a second name by which a mapping may call it; may be empty
    ColumnPlan known;   ///< its own name and no unit where nothing is known
};

/// What the columns become: with a mapping what it says, and only that; without one what is known.
/// A known name that an earlier column has leaves the column its own. Throws InputError at `place`
/// where the mapping names a column that is not there.
[[nodiscard]] std::vector<ColumnPlan> plan_columns(std::span<const SourceColumn> columns, const Mapping* mapping,
                                                   const Place& place);

/// A text with or without a header of column names. Columns whose first record holds a time of day are
/// clocks; without a mapping, unknown columns of words are passed over. Throws InputError with the line: no header and no
/// mapping, a column that is not there, a clock that is to be scaled.
[[nodiscard]] TextPlan plan_text(const Source& source, const Mapping* mapping);

/// The mapping of a log that still grows. Throws UsageError: it names block events, which a second file would have to keep up with.
[[nodiscard]] std::optional<Mapping> mapping_of_growing(const LogOptions& options);

/// Sets the period: that of the options, else the mapping's, else leaves it.
void set_period(Log& log, const LogOptions& options, const Mapping* mapping);

/// Adds the channel `line` from the events that the mapping names, where it names any. `day`: from whose
/// midnight the log's clock counts; else that of the first event. Events outside the log are a note `log.events-outside`.
/// Throws InputError.
void add_event_lines(Log& log, const Mapping* mapping, std::optional<std::int64_t> day = {});

}  // namespace clsurf::io
