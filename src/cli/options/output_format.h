#pragma once
// The ending of an output's name chooses its format, or is an error: one table a kind of output.

#include <span>
#include <string>
#include <string_view>

namespace clsurf::cli {

/// One form of an output.
struct OutputFormat {
    std::string_view name;     ///< "csv", as --format has it
    std::string_view endings;  ///< ".jpg .jpeg", lower case; empty: none, only --format asks for it
    bool binary = false;       ///< not for a terminal
};

/// The forms of one kind of output. The first one is that of names that have no ending: "-", devices, pipes.
using OutputFormats = std::span<const OutputFormat>;

[[nodiscard]] OutputFormats picture_formats();  ///< those that viz::encode_image() writes
[[nodiscard]] OutputFormats drawing_formats();  ///< these, and SVG and PDF
[[nodiscard]] OutputFormats front_formats();    ///< drawings, and tables of a Pareto front: CSV and JSON
[[nodiscard]] OutputFormats page_formats();
[[nodiscard]] OutputFormats log_formats();
[[nodiscard]] OutputFormats table_formats();   ///< of per-point columns
[[nodiscard]] OutputFormats report_formats();  ///< text, json, csv, sarif
[[nodiscard]] OutputFormats toml_formats();    ///< mappings, machine files
[[nodiscard]] OutputFormats motion_formats();  ///< rows a motion, as CSV

/// ".png, .jpg or .jpeg"
[[nodiscard]] std::string endings_of(OutputFormats formats);

/// The form that the ending of `path` stands for, upper or lower case. `chosen`, the word of --format, holds where
/// the ending says nothing. `option` names it in messages. Throws UsageError: an ending that is not in the table or
/// contradicts `chosen`; a binary form on a terminal.
[[nodiscard]] const OutputFormat& output_format(const std::string& path, OutputFormats formats,
                                                std::string_view chosen = {}, std::string_view option = "-o");

/// Throws UsageError where a program is to be written into a file of another kind: "better.png".
void require_program_ending(const std::string& path);

/// "-", /dev/stdout, a device or a pipe.
[[nodiscard]] bool is_stream(const std::string& path);
/// The output is standard output, where no other text may come between.
[[nodiscard]] bool is_standard_output(const std::string& path);

}  // namespace clsurf::cli
