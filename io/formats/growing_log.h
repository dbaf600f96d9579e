#pragma once
// GrowingLog: a log that another program is still writing, read record by record. It keeps the head of the log and the last
// records, as many as are wanted; what it keeps is a log that the reader of its format opens (LogFormat::frame).

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
    /// `options` must outlive it. Throws InputError, SystemError: as GrowingFile.
    GrowingLog(const std::string& path, const LogOptions& options);

    /// Takes what was written since, some `most` records of it or, of text, about as many; half a record waits for its other
    /// half. Returns how many bytes came. Throws InputError: as GrowingFile; the head changed; a format that cannot be
    /// followed; UsageError: a mapping that cannot.
    std::size_t read(PointIndex most);
    /// No more will come: the stream was closed, the file has no name any more, or the log says that it is closed.
    [[nodiscard]] bool ended() const;
    void wait(double seconds) const { file_.wait(seconds); }

    /// Its head is there, and so records can be.
    [[nodiscard]] bool known() const { return format_ != nullptr; }
    [[nodiscard]] PointIndex first() const { return first_; }  ///< number of the first record that is kept
    [[nodiscard]] PointIndex end() const { return end_; }      ///< number of the next record
    /// The records that are kept, as a log of their own. Domain: known(), first() < end(). Throws InputError.
    [[nodiscard]] Log window() const;
    /// Keeps no records before that number any more.
    void forget(PointIndex before);

    /// All bytes that there are now.
    [[nodiscard]] Source whole() const { return file_.whole(); }
    /// The same without half a record at the end.
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
    std::vector<std::byte> kept_;      ///< whole records from first_ on, and what came behind them
    std::size_t whole_bytes_ = 0;      ///< of kept_, in whole records
    std::size_t forgotten_bytes_ = 0;  ///< of the records before first_
    std::vector<std::size_t> starts_;  ///< of text: where in kept_ each record begins
    PointIndex first_ = 0, end_ = 0;
};

}  // namespace clsurf::io
