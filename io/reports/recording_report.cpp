#include "io/reports/recording_report.h"

#include <fmt/format.h>

#include "io/files/json_value.h"

namespace clsurf::io {

std::string recording_text(const Recording& recording, const std::vector<RegisterChannel>& channels,
                           const RecordingRules& rules, const std::string& output) {
    std::string text = fmt::format("{}: {} records over {:.1f} s, one every {:g} ms, from {}\n", output,
                                   recording.records, recording.duration, 1e3 / rules.rate, recording.started);
    for (std::size_t c = 0; c < channels.size(); ++c) {
        text += fmt::format("  {}{}: {} values, {} gaps\n", channels[c].name,
                            channels[c].unit.empty() ? "" : " [" + channels[c].unit + "]",
                            recording.records - recording.gaps[c], recording.gaps[c]);
    }
    text += fmt::format("{} of {} requests answered, the slowest after {:.1f} ms", recording.answered(),
                        recording.requests, 1e3 * recording.longest_answer);
    const auto add = [&](std::int64_t count, const char* what) {
        if (count > 0) text += fmt::format("; {} {}", count, what);
    };
    add(recording.late, "not in time");
    add(recording.exceptions, "refused by the device");
    add(recording.damaged, "answered by a damaged or a wrong frame");
    add(recording.disconnected, "without a connection");
    text += "\n";
    if (recording.missed_records > 0)
        text += fmt::format("{} records missed: the device is too slow for {:g} a second, or did not answer\n",
                            recording.missed_records, rules.rate);
    return text;
}

std::string recording_json(const Recording& recording, const std::vector<RegisterChannel>& channels,
                           const RecordingRules& rules, const std::string& output) {
    Json list = Json::array();
    for (std::size_t c = 0; c < channels.size(); ++c)
        list.push_back({{"name", channels[c].name}, {"unit", channels[c].unit}, {"gaps", recording.gaps[c]}});
    return dump(Json{{"output", output},
                     {"end", name_of(recording.end)},
                     {"records", recording.records},
                     {"missed_records", recording.missed_records},
                     {"duration_s", number(recording.duration)},
                     {"period_s", number(1 / rules.rate)},
                     {"recorded", recording.started},
                     {"channels", std::move(list)},
                     {"requests", Json{{"sent", recording.requests},
                                       {"answered", recording.answered()},
                                       {"late", recording.late},
                                       {"exceptions", recording.exceptions},
                                       {"damaged", recording.damaged},
                                       {"disconnected", recording.disconnected}}},
                     {"longest_answer_s", number(recording.longest_answer)}});
}

}  // namespace clsurf::io
