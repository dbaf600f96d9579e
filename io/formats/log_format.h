#pragma once
// LogFormat: one row per readable log format. The format is recognised by content, not by file name.
// To add a format to clsurf: io/formats/<format>.cpp with its row, named in log_formats.def. Other programs add
// theirs with LogOptions::more_formats.

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "io/files/mapped_file.h"
#include "log/log.h"

namespace clsurf::io {

struct LogOptions;

/// The position of the first record and the length of each: what is needed to read a growing log.
struct RecordFrame {
    std::size_t head_bytes = 0;           ///< number of bytes before the first record
    std::size_t record_bytes = 0;         ///< size of each record; 0: a record is a line of text that is not a comment
    bool overruns = false;                ///< lines "overrun" are not records
    std::optional<std::size_t> count_at;  ///< byte of the number of records (u64), 0 until the log is closed
};

struct LogFormat {
    std::string_view name;
    std::string_view summary;
    /// 0: certainly not … 100: certain.
    int (*probe)(std::span<const std::byte> head, const LogOptions& options);
    /// Throws InputError with the place.
    Log (*open)(const Source& source, const LogOptions& options);
    /// The frame of a log from its beginning: the head and some records. Throws InputError: the head is incomplete or
    /// wrong. nullptr: the format can only be read when the log is complete.
    RecordFrame (*frame)(const Source& beginning, const LogOptions& options) = nullptr;
    bool names_parameters = false;  ///< the metadata of its logs may name parameters of the run (run_parameters.h)
};

/// What the user states about a log.
struct LogOptions {
    std::string layout;            ///< file: layout of a foreign fixed-record log (TOML); empty: none
    std::string mapping;           ///< file: column mapping of a text log (TOML); empty: none
    std::optional<double> period;  ///< [s]; overrides the log, its layout and its mapping
    std::span<const LogFormat> more_formats =
        {};  ///< besides log_formats(), recognised like them; must outlive the call
};

/// Whether a layout or a mapping determines how the bytes are read: any file can then be a log.
[[nodiscard]] inline bool forces_log(const LogOptions& options) {
    return !options.layout.empty() || !options.mapping.empty();
}

/// The built-in formats, in the order of the help text.
[[nodiscard]] std::span<const LogFormat> log_formats();

/// The most likely format of the content, built in or from options.more_formats; nullptr: none.
[[nodiscard]] const LogFormat* recognise_log(const Source& source, const LogOptions& options);

/// Opens a log in that format. Throws InputError.
[[nodiscard]] Log open_log_as(const LogFormat& format, const Source& source, const LogOptions& options);

/// Opens a log of any format. Throws InputError; for unknown content the error names the formats that were tried.
[[nodiscard]] Log open_log(const std::string& path, const LogOptions& options);
[[nodiscard]] Log open_log(const Source& source, const LogOptions& options);

}  // namespace clsurf::io
