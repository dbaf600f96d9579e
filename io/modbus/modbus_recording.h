#pragma once
// A recording: the registers of a map, read at a steady rate into a BIIP log with a channel each, and `time`.

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
    std::optional<double> duration = {};      ///< [s]; none: until it is stopped
    double timeout = 0.5;                     ///< [s] of an answer
    double patience = 30;                     ///< [s] without any answer that end the recording
    std::function<bool()> stopped = nullptr;  ///< asked many times a second; true ends the recording
    Progress progress = nullptr;              ///< with a duration
};

enum class RecordingEnd : std::uint8_t { duration, stopped, disconnected };
[[nodiscard]] std::string_view name_of(RecordingEnd end);  ///< "duration"

struct Recording {
    RecordingEnd end = RecordingEnd::duration;
    std::string reason;   ///< of the last request without an answer
    std::string started;  ///< time 0, UTC
    PointIndex records = 0;
    double duration = 0;              ///< [s] from the first record to the last
    std::int64_t missed_records = 0;  ///< whose time passed while an answer was waited for
    std::vector<PointIndex> gaps;     ///< of each channel: records without its value
    std::int64_t requests = 0, late = 0, exceptions = 0, damaged = 0, disconnected = 0;
    double longest_answer = 0;  ///< [s]

    [[nodiscard]] std::int64_t answered() const { return requests - late - exceptions - damaged - disconnected; }
};

/// Records until the duration is over, rules.stopped() says so, or no answer came for rules.patience. In each case the
/// log is then whole and named `output`; until then it is `output`.part, and has all but the last second whatever ends
/// the program. A value that was not answered is NaN. Throws, without a file: SystemError (no connection or no answer at
/// all at the beginning), InputError at the map's channel (registers that the device does not have), UsageError
/// (`output`.part is there). SystemError later on: the disk is full; the part stays.
[[nodiscard]] Recording record_modbus(const ModbusAddress& address, const std::vector<RegisterChannel>& channels,
                                      const RecordingRules& rules, const std::string& output);

}  // namespace clsurf::io
