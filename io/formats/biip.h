#pragma once
// BIIP, version 1: the writer of the project's own log container (docs/formats/biip.md). The reader is in known_formats.h.

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

/// Writes a log block by block, in the memory of one block. The file appears with close().
class BiipWriter {
public:
    /// `metadata`: the text of a JSON object. Throws UsageError (no channels, a name or unit too long),
    /// SystemError.
    BiipWriter(const std::string& path, const std::vector<StoredChannel>& channels, double period,
               const std::string& metadata, Unfinished unfinished = Unfinished::vanishes);

    [[nodiscard]] std::size_t record_bytes() const { return record_bytes_; }
    /// The offset of a channel in its record.
    [[nodiscard]] std::size_t offset_of(std::size_t channel) const { return offsets_[channel]; }

    /// Appends complete records with raw values at offset_of(). Throws SystemError (disk full).
    void append(std::span<const std::byte> records);
    /// Passes the appended records to the system: a log that is never finished contains them. Throws SystemError.
    void save() { file_.save(); }
    /// Writes the number of records and names the file. Throws SystemError.
    void close();

private:
    AtomicFile file_;
    std::vector<std::size_t> offsets_;
    std::size_t record_bytes_ = 0;
    std::uint64_t records_ = 0;
};

/// Shortens channel names to the 23 bytes that BIIP allows, and drops units of more than 8 bytes.
/// Each change is a note `log.name`.
[[nodiscard]] Diagnostics fit_biip(Log& log);

/// Writes channels of a log as BIIP. Stored types and scales are kept, big-endian values are converted, and
/// channels with a bias become f64. `metadata`: the text of a JSON object. O(records), in blocks.
/// Throws SystemError (disk full), UsageError (a name or unit too long).
void write_biip(const std::string& path, const std::vector<Channel>& channels, PointIndex records, double period,
                const std::string& metadata);

}  // namespace clsurf::io
