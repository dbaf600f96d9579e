#pragma once
// A recording: the registers of a map, read at a fixed rate into a BIIP log with one channel each, and `time`.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/point.h"
#include "core/progress.h"
#include "io/modbus/modbus_address.h"
#include "io/modbus/register_map.h"

namespace clsurf::io {

struct RecordingRules {
    double rate = 10;                         ///< [Hz]
    std::optional<double> duration = {};      ///< [s]; none: until stopped
    double timeout = 0.5;                     ///< [s] longest wait for an answer
    double patience = 30;                     ///< [s] the recording ends after this time without any answer
    std::function<bool()> stopped = nullptr;  ///< polled many times per second; true ends the recording
    Progress progress = nullptr;              ///< only if a duration is given
};

enum class RecordingEnd : std::uint8_t { duration, stopped, disconnected };
[[nodiscard]] std::string_view name_of(RecordingEnd end);  ///< "duration"

struct Recording {
    RecordingEnd end = RecordingEnd::duration;
    std::string reason;   ///< why the last failed request has no answer
    std::string started;  ///< time 0, UTC
    PointIndex records = 0;
    double duration = 0;              ///< [s] time from the first record to the last
    std::int64_t missed_records = 0;  ///< records skipped while waiting for an answer
    std::vector<PointIndex> gaps;     ///< per channel: records without a value
    std::int64_t requests = 0, late = 0, exceptions = 0, damaged = 0, disconnected = 0;
    double longest_answer = 0;  ///< [s]

    [[nodiscard]] std::int64_t answered() const { return requests - late - exceptions - damaged - disconnected; }
};

/// Records until the duration is over, rules.stopped() returns true, or no answer came for rules.patience. The
/// log is then complete and named `output`. Until then it is `output`.part; if the program is killed, that file lacks at
/// most the last second. A missing answer is NaN. Throws, without leaving a file: SystemError (no connection or no answer
/// at the beginning), InputError at the map's channel (registers that the device does not have), UsageError
/// (`output`.part exists). Later SystemError: the disk is full; the .part file is kept.
[[nodiscard]] Recording record_modbus(const ModbusAddress& address, const std::vector<RegisterChannel>& channels,
                                      const RecordingRules& rules, const std::string& output);

}  // namespace clsurf::io
