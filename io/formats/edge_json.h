#pragma once
// SINUMERIK Edge (Capture4Analysis): high-frequency recordings as JSON (docs/formats/edge.md).

#include "io/formats/log_format.h"

namespace clsurf::io {

[[nodiscard]] int probe_edge(std::span<const std::byte> head, const LogOptions& options);

/// One record per row of HFData. `line` and `program` come from the block and call events: the line of
/// the innermost program that runs. A recording that ends in the middle is read as far as it goes
/// (`log.unclosed`). Throws InputError with the line of the file. Memory: proportional to the rows.
[[nodiscard]] Log open_edge(const Source& source, const LogOptions& options);

}  // namespace clsurf::io
