#pragma once
// Mapping files (docs/formats/csv.md): which columns of a log become which channels, and the columns of
// block events in a second file.
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

/// Block events in a separate text: from `at` on, a line of the program is active.
struct EventFile {
    std::string path;
    char separator = '\0';    ///< '\0': detected
    bool at_records = false;  ///< `at` counts records from 0; otherwise it is a time like those of the log
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

/// The mapping that the options name, if any.
[[nodiscard]] std::optional<Mapping> mapping_of(const LogOptions& options);

/// A column with its name in the file and its channel without a mapping.
struct SourceColumn {
    std::string name;   ///< as in the file
    std::string other;  ///< a second name by which a mapping may call it; may be empty
    ColumnPlan known;   ///< its channel; if none is known, its own name without a unit
};

/// The channels of the columns: with a mapping exactly those that it lists, otherwise the known ones.
/// If an earlier column has the same known name, a column keeps its own name. Throws InputError at `place`
/// if the mapping names a column that does not exist.
[[nodiscard]] std::vector<ColumnPlan> plan_columns(std::span<const SourceColumn> columns, const Mapping* mapping,
                                                   const Place& place);

/// The plan of a text with or without a header of column names. Columns whose first record is a time of day are
/// clocks; without a mapping, unknown columns of words are skipped. Throws InputError with the line: no header and no
/// mapping, a missing column, a clock with a scale.
[[nodiscard]] TextPlan plan_text(const Source& source, const Mapping* mapping);

/// The mapping of a growing log. Throws UsageError: it names block events, whose file would have to grow in step.
[[nodiscard]] std::optional<Mapping> mapping_of_growing(const LogOptions& options);

/// Sets the period from the options, otherwise from the mapping; without either it is not changed.
void set_period(Log& log, const LogOptions& options, const Mapping* mapping);

/// Adds the channel `line` from the events that the mapping names, if any. `day`: the day from whose
/// midnight the log's clock counts; otherwise that of the first event. Events outside the log are a note
/// `log.events-outside`. Throws InputError.
void add_event_lines(Log& log, const Mapping* mapping, std::optional<std::int64_t> day = {});

}  // namespace clsurf::io
