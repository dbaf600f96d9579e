#pragma once
// TwinCAT Scope: text exports (docs/formats/scopes.md).

#include "io/formats/log_format.h"

namespace clsurf::io {

[[nodiscard]] int probe_twincat(std::span<const std::byte> head, const LogOptions& options);

/// One record per sample of the channels with the shortest sampling time; slower channels keep their
/// last value in between (note `log.held`). Throws InputError with the line.
[[nodiscard]] Log open_twincat(const Source& source, const LogOptions& options);

}  // namespace clsurf::io
