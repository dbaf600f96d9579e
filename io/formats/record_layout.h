#pragma once
// Foreign fixed-record logs, described by a layout file (docs/formats/layout.md).

#include "io/formats/log_format.h"

namespace clsurf::io {

/// Certain where the user names a layout, no otherwise: bare records tell nothing.
[[nodiscard]] int probe_layout(std::span<const std::byte> head, const LogOptions& options);

/// Views on the records as the layout says. Throws InputError; adds `log.unclosed` for left-over bytes.
[[nodiscard]] Log open_layout(const Source& source, const LogOptions& options);

/// Throws InputError.
[[nodiscard]] RecordFrame frame_layout(const Source& beginning, const LogOptions& options);

}  // namespace clsurf::io
