#pragma once
// Text logs: CSV and TSV with a header of channel names, LinuxCNC's halsampler text; columns named,
// scaled and converted by a mapping file where the log does not do so (docs/formats/csv.md).

#include "io/formats/log_format.h"

namespace clsurf::io {

[[nodiscard]] int probe_delimited(std::span<const std::byte> head, const LogOptions& options);
[[nodiscard]] int probe_halsampler(std::span<const std::byte> head, const LogOptions& options);

/// Dense columns; a bad number becomes NaN with a diagnostic that names line and column
/// (`log.bad-number`), a short or long row likewise (`log.ragged-row`). Throws InputError: no
/// channels, no period. O(bytes), parallel by sections of the text.
[[nodiscard]] Log open_delimited(const Source& source, const LogOptions& options);
[[nodiscard]] Log open_halsampler(const Source& source, const LogOptions& options);

/// Of both. Throws InputError; UsageError: the mapping names block events.
[[nodiscard]] RecordFrame frame_text(const Source& beginning, const LogOptions& options);

}  // namespace clsurf::io
