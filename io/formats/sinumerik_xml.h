#pragma once
// SINUMERIK Operate: trace sessions as XML (docs/formats/scopes.md).

#include "io/formats/log_format.h"

namespace clsurf::io {

[[nodiscard]] int probe_sinumerik_xml(std::span<const std::byte> head, const LogOptions& options);

/// One record per `rec`; a value that is not repeated holds. A trace that ends in the middle is read
/// as far as it goes (`log.unclosed`). Throws InputError with line and column.
[[nodiscard]] Log open_sinumerik_xml(const Source& source, const LogOptions& options);

}  // namespace clsurf::io
