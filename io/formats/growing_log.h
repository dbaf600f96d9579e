#pragma once
// GrowingLog: a log that another program is still writing, read record by record. It keeps the head of the log and the last
// records, as many as needed; together they are a log that the reader of the format opens (LogFormat::frame).

#include <cstddef>
#include <string>
#include <vector>

#include "core/point.h"
#include "io/files/growing_file.h"
#include "io/formats/log_format.h"
#include "log/log.h"

namespace clsurf::io {

class GrowingLog {
public:
    /// `options` must outlive the object. Throws InputError, SystemError as GrowingFile does.
    GrowingLog(const std::string& path, const LogOptions& options);

    /// Reads the bytes that were written since the last call: at most `most` records, of text approximately. An incomplete
    /// record waits for its rest. Returns the number of bytes. Throws InputError: as GrowingFile; the head changed; a format
    /// that cannot be followed; UsageError: a mapping that cannot be followed.
    std::size_t read(PointIndex most);
    /// No more records will come: the stream was closed, the file was removed or renamed, or the log is marked as closed.
    [[nodiscard]] bool ended() const;
    void wait(double seconds) const { file_.wait(seconds); }

    /// Whether the head is complete, so that records can be read.
    [[nodiscard]] bool known() const { return format_ != nullptr; }
    [[nodiscard]] PointIndex first() const { return first_; }  ///< number of the first record that is kept
    [[nodiscard]] PointIndex end() const { return end_; }      ///< number of the next record
    /// The kept records as a log. Domain: known(), first() < end(). Throws InputError.
    [[nodiscard]] Log window() const;
    /// Drops the records before that number.
    void forget(PointIndex before);

    /// All bytes so far.
    [[nodiscard]] Source whole() const { return file_.whole(); }
    /// The same without an incomplete record at the end.
    [[nodiscard]] Source whole_records() const;

private:
    void find_frame();
    void check_head() const;
    void take_records();
    void take_lines();

    GrowingFile file_;
    const LogOptions& options_;
    const LogFormat* format_ = nullptr;  ///< nullptr: not known yet
    RecordFrame frame_;
    std::vector<std::byte> head_;
    std::vector<std::byte> kept_;      ///< complete records from first_ on, and the bytes after them
    std::size_t whole_bytes_ = 0;      ///< bytes of kept_ in complete records
    std::size_t forgotten_bytes_ = 0;  ///< size of the records before first_
    std::vector<std::size_t> starts_;  ///< for text: the offset of each record in kept_
    PointIndex first_ = 0, end_ = 0;
};

}  // namespace clsurf::io
