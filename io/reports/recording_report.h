#pragma once
// The output of `record`.

#include <string>
#include <vector>

#include "io/modbus/modbus_recording.h"

namespace clsurf::io {

[[nodiscard]] std::string recording_text(const Recording& recording, const std::vector<RegisterChannel>& channels,
                                         const RecordingRules& rules, const std::string& output);

/// Keys: output, end, records, missed_records, duration_s, period_s, recorded, channels[{name, unit, gaps}],
/// requests{sent, answered, late, exceptions, damaged, disconnected}, longest_answer_s.
[[nodiscard]] std::string recording_json(const Recording& recording, const std::vector<RegisterChannel>& channels,
                                         const RecordingRules& rules, const std::string& output);

}  // namespace clsurf::io
