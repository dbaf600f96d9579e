#pragma once
// BIIP, version 1: the project's own log container (docs/formats/biip.md), as it is written; known_formats.h has its reader.

#include <string>
#include <vector>

#include "io/files/atomic_file.h"
#include "log/log.h"

namespace clsurf::io {

/// How a channel is stored; value = raw · scale.
struct StoredChannel {
    std::string name;  ///< at most 23 bytes
    std::string unit;  ///< UTF-8, at most 8 bytes
    ScalarType type = ScalarType::f64;
    double scale = 1.0;
};

/// A log written block by block, in the memory of a block. The file appears with close().
class BiipWriter {
public:
    /// `metadata` is a JSON object's text. Throws UsageError (no channels, a name or unit too long),
    /// SystemError.
    BiipWriter(const std::string& path, const std::vector<StoredChannel>& channels, double period,
               const std::string& metadata, Unfinished unfinished = Unfinished::vanishes);

    [[nodiscard]] std::size_t record_bytes() const { return record_bytes_; }
    /// Where a channel stands in its record.
    [[nodiscard]] std::size_t offset_of(std::size_t channel) const { return offsets_[channel]; }

    /// Appends whole records, raw values where offset_of() says. Throws SystemError (disk full).
    void append(std::span<const std::byte> records);
    /// Hands what was appended to the system: a log that stays unfinished has it. Throws SystemError.
    void save() { file_.save(); }
    /// Writes the number of records and gives the file its name. Throws SystemError.
    void close();

private:
    AtomicFile file_;
    std::vector<std::size_t> offsets_;
    std::size_t record_bytes_ = 0;
    std::uint64_t records_ = 0;
};

/// Shortens names of channels to the 23 bytes that BIIP has for them, and leaves out units of more than
/// 8; each is a note `log.name`.
[[nodiscard]] Diagnostics fit_biip(Log& log);

/// Writes channels of a log as BIIP: stored types and scales are kept, big-endian values turned, and
/// channels with a bias become f64. `metadata` is a JSON object's text. O(records), by blocks.
/// Throws SystemError (disk full), UsageError (a name or unit too long).
void write_biip(const std::string& path, const std::vector<Channel>& channels, PointIndex records, double period,
                const std::string& metadata);

}  // namespace clsurf::io
