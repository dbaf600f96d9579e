#pragma once
// Text with one record per line, read into columns: the common part of delimited text, halsampler and halscope files
// and TwinCAT exports. A format's reader finds the start of the records and the meaning of the columns (TextPlan).
// The records are read here, in parallel sections.
// Used inside io only.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/files/mapped_file.h"
#include "log/log.h"

namespace clsurf::io {

/// The channel of a column: value · scale + bias, in `unit`.
struct ColumnPlan {
    std::string name;  ///< empty: the column is skipped
    std::string unit;
    double scale = 1.0;
    double bias = 0.0;
    bool clock = false;  ///< times of day (io/formats/clock_time.h), converted to seconds since TextPlan::day
};

/// Where the records begin, how they are separated and what their columns mean.
struct TextPlan {
    char separator = ',';  ///< ' ': any number of blanks and tabs
    bool decimal_comma = false;
    bool overruns = false;       ///< the sampler writes "overrun" when it lost records
    std::size_t data_begin = 0;  ///< byte
    std::size_t data_end = std::string_view::npos;
    std::uint64_t first_data_line = 1;
    std::int64_t day = 0;  ///< since 1970; clocks with a date count from its midnight
    std::vector<ColumnPlan> columns;
    std::vector<std::string> words;  ///< skipped columns of words
};

/// The first line of `rest` without its end; `rest` then begins after it.
[[nodiscard]] std::string_view first_line(std::string_view& rest);
/// Empty, or begins with "#", "%", "//" or "sep=".
[[nodiscard]] bool is_comment(std::string_view line);
/// Tab, semicolon or comma, the first of these that the line has outside quotes; otherwise a blank.
[[nodiscard]] char detect_separator(std::string_view line);

/// The fields of a line, without blanks and quotes around them; at most most_channels + 1.
[[nodiscard]] std::vector<std::string> split(std::string_view line, char separator);
/// A number as text logs write it. NaN if the field is empty or says NaN, and if it is not a
/// number (then `bad` is set).
[[nodiscard]] double parse_number(std::string_view field, bool decimal_comma, bool& bad);
/// Whether the field is a number, with a decimal point or comma.
[[nodiscard]] bool looks_like_number(std::string_view field);
/// A number or a time of day.
[[nodiscard]] bool is_value(std::string_view field);
/// "cmd.x [mm]", "Time (ms)" → name and unit.
[[nodiscard]] ColumnPlan plan_from_header(std::string_view field);
/// Whether there are no control characters except tabs and line ends.
[[nodiscard]] bool is_text(std::span<const std::byte> head);
/// The text without a byte order mark.
[[nodiscard]] std::string_view text_of(std::span<const std::byte> bytes);

/// Reads the records of a text. Bad and missing fields become NaN with a diagnostic `log.bad-number` or
/// `log.ragged-row` with line and column; columns of words are a note `log.words`. Throws InputError: no records, a
/// duplicate channel, rows that lack nearly all fields. Memory: at most some 80 bytes per byte of text.
[[nodiscard]] Log read_table(const Source& source, const TextPlan& plan, const char* format);

}  // namespace clsurf::io
