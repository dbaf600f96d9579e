#pragma once
// The extension of an output's name selects its format or is an error: one table per kind of output.

#include <span>
#include <string>
#include <string_view>

namespace clsurf::cli {

/// One format of an output.
struct OutputFormat {
    std::string_view name;     ///< "csv", as in --format
    std::string_view endings;  ///< ".jpg .jpeg", lower case; empty: none, only selected by --format
    bool binary = false;       ///< must not be written to a terminal
};

/// The formats of one kind of output. The first one is for names without extension: "-", devices, pipes.
using OutputFormats = std::span<const OutputFormat>;

[[nodiscard]] OutputFormats picture_formats();  ///< the formats that viz::encode_image() writes
[[nodiscard]] OutputFormats drawing_formats();  ///< formats of pictures, plus SVG and PDF
[[nodiscard]] OutputFormats front_formats();    ///< drawings, and tables of a Pareto front: CSV and JSON
[[nodiscard]] OutputFormats page_formats();
[[nodiscard]] OutputFormats log_formats();
[[nodiscard]] OutputFormats table_formats();   ///< formats of per-point columns
[[nodiscard]] OutputFormats report_formats();  ///< text, json, csv, sarif
[[nodiscard]] OutputFormats toml_formats();    ///< mappings, machine files
[[nodiscard]] OutputFormats motion_formats();  ///< one row per motion, as CSV

/// ".png, .jpg or .jpeg"
[[nodiscard]] std::string endings_of(OutputFormats formats);

/// The format for the extension of `path`, in upper or lower case. `chosen`, the value of --format, is used if
/// the extension is not known. `option` is the name for messages. Throws UsageError: an extension that is not in the table
/// or contradicts `chosen`; a binary format on a terminal.
[[nodiscard]] const OutputFormat& output_format(const std::string& path, OutputFormats formats,
                                                std::string_view chosen = {}, std::string_view option = "-o");

/// Throws UsageError if a program would be written to a file of another kind: "better.png".
void require_program_ending(const std::string& path);

/// Whether a path is "-", /dev/stdout, a device or a pipe.
[[nodiscard]] bool is_stream(const std::string& path);
/// Whether a path is standard output, which must not contain other text.
[[nodiscard]] bool is_standard_output(const std::string& path);

}  // namespace clsurf::cli
