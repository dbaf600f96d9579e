#pragma once
// Compressed inputs: gzip (RFC 1952), Zstandard (RFC 8878) and xz, recognised by their first bytes, not by
// their names. Logs and programs are read through open_source(), so every format can be compressed.

#include <string>

#include "io/files/mapped_file.h"

namespace clsurf::io {

/// The source itself if it is not compressed, otherwise its unpacked bytes under the same name. Several
/// consecutive members are one text, as `cat a.gz b.gz` makes them.
/// Throws InputError with the byte: damaged or cut data; more than 256 MiB + 100 times the input
/// (a decompression bomb); a missing dictionary. Memory: bounded by that limit.
[[nodiscard]] Source unpacked(const Source& source);

/// Whether the bytes begin like a compressed file.
[[nodiscard]] bool is_compressed(std::span<const std::byte> bytes);

/// Maps a file and unpacks it if it is compressed. Throws InputError.
[[nodiscard]] Source open_source(const std::string& path);

}  // namespace clsurf::io
