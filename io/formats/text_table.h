#pragma once
// Text with one record a line, read into columns: what delimited text, halsampler and halscope files
// and TwinCAT exports have in common. A reader finds out where the records begin and what the columns
// mean (TextPlan); the records are read here, in parallel sections.
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

/// What a column becomes: value · scale + bias, in `unit`.
struct ColumnPlan {
    std::string name;  ///< empty: the column is passed over
    std::string unit;
    double scale = 1.0;
    double bias = 0.0;
    bool clock = false;  ///< holds times of day (io/formats/clock_time.h), which become seconds since TextPlan::day
};

/// Where the records lie, how they are separated and what their columns mean.
struct TextPlan {
    char separator = ',';  ///< ' ': any number of blanks and tabs
    bool decimal_comma = false;
    bool overruns = false;       ///< "overrun" stands where the sampler lost records
    std::size_t data_begin = 0;  ///< byte
    std::size_t data_end = std::string_view::npos;
    std::uint64_t first_data_line = 1;
    std::int64_t day = 0;  ///< since 1970, from whose midnight clocks with a date count
    std::vector<ColumnPlan> columns;
    std::vector<std::string> words;  ///< columns that are passed over, since they hold words
};

/// The first line of `rest` without its end; `rest` goes on behind it.
[[nodiscard]] std::string_view first_line(std::string_view& rest);
/// Empty, or begins with "#", "%", "//" or "sep=".
[[nodiscard]] bool is_comment(std::string_view line);
/// Tab, semicolon or comma where the line has one outside quotes, in this order; else a blank.
[[nodiscard]] char detect_separator(std::string_view line);

/// The fields of a line, without blanks and quotes around them; at most most_channels + 1.
[[nodiscard]] std::vector<std::string> split(std::string_view line, char separator);
/// A number as text logs write it, or NaN: where the field is empty or says so, and where it is no
/// number (`bad` is set).
[[nodiscard]] double parse_number(std::string_view field, bool decimal_comma, bool& bad);
/// The field is a number, with a decimal point or comma.
[[nodiscard]] bool looks_like_number(std::string_view field);
/// A number or a time of day.
[[nodiscard]] bool is_value(std::string_view field);
/// "cmd.x [mm]", "Time (ms)" → name and unit.
[[nodiscard]] ColumnPlan plan_from_header(std::string_view field);
/// No control characters but tabs and ends of lines.
[[nodiscard]] bool is_text(std::span<const std::byte> head);
/// The text without a byte order mark.
[[nodiscard]] std::string_view text_of(std::span<const std::byte> bytes);

/// Reads the records of a text. Bad and missing fields are NaN and diagnostics `log.bad-number`,
/// `log.ragged-row` with line and column; columns of words are a note `log.words`. Throws InputError: no records, a channel that is there
/// twice, rows that lack nearly all fields. Memory: at most some 80 bytes per byte of text.
[[nodiscard]] Log read_table(const Source& source, const TextPlan& plan, const char* format);

}  // namespace clsurf::io
