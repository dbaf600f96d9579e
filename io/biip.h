#pragma once
// BIIP, version 1: the project's own log container (docs/formats/biip.md).

#include <string>
#include <vector>

#include "io/log_format.h"

namespace clsurf::io {

[[nodiscard]] int probe_biip(std::span<const std::byte> head, const LogOptions& options);

/// Every rule of the format page; channels are views on the mapping. Throws InputError; adds
/// `log.unclosed`, `log.minor-version`.
[[nodiscard]] Log open_biip(const Source& source, const LogOptions& options);

/// Writes channels of a log as BIIP: stored types and scales are kept, big-endian values turned, and
/// channels with a bias become f64. `metadata` is a JSON object's text. O(records), by blocks.
/// Throws SystemError (disk full), UsageError (a name or unit too long).
void write_biip(const std::string& path, const std::vector<Channel>& channels, PointIndex records,
                double period, const std::string& metadata);

}  // namespace clsurf::io
