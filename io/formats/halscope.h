#pragma once
// LinuxCNC's halscope: what "Save log" writes (docs/formats/scopes.md).

#include "io/formats/log_format.h"

namespace clsurf::io {

[[nodiscard]] int probe_halscope(std::span<const std::byte> head, const LogOptions& options);

/// Channels are named after their HAL pins, or by a mapping. Throws InputError with the line.
[[nodiscard]] Log open_halscope(const Source& source, const LogOptions& options);

/// Throws InputError; UsageError: the mapping names block events.
[[nodiscard]] RecordFrame frame_halscope(const Source& beginning, const LogOptions& options);

}  // namespace clsurf::io
