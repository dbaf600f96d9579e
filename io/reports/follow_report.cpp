#include "io/reports/follow_report.h"

#include <utility>

#include <fmt/format.h>

#include "io/files/json_value.h"
#include "io/reports/defect_json.h"
#include "io/reports/line_ranges.h"
#include "io/reports/quality_words.h"

namespace clsurf::io {
namespace {

constexpr std::size_t most_ranges = 3;

/// An object in one line, with the schema version.
std::string line_of(const Json& event) {
    Json versioned{{"schema_version", schema_version}};
    versioned.update(event);
    return dump_compact(versioned) + "\n";
}

Json ranks_of(const std::vector<std::size_t>& indices) {
    Json ranks = Json::array();
    for (const std::size_t index : indices) ranks.push_back(index + 1);
    return ranks;
}

std::string ranks_text(const std::vector<std::size_t>& indices) {
    std::string text;
    for (const std::size_t index : indices) text += fmt::format("{}{}", text.empty() ? "" : ", ", index + 1);
    return (indices.size() == 1 ? "rank " : "ranks ") + text;
}

}  // namespace

std::string_view name_of(FollowEnd end) {
    switch (end) {
        case FollowEnd::closed: return "closed";
        case FollowEnd::timeout: return "timeout";
        case FollowEnd::interrupted: return "interrupted";
    }
    return "";
}

std::string finding_text(const ProvisionalDefect& found, double period) {
    const Defect& d = found.defect;
    return fmt::format("{:.3f} s, finding {} (provisional): {}, {}; {}, {}, {}\n",
                       static_cast<double>(d.point) * period, found.number, sentence_of(d),
                       named_line_ranges(d, most_ranges), name_of_severity(d.severity), name_of(d.cause),
                       place_text(d.place));
}

std::string finding_json(const ProvisionalDefect& found, double period) {
    Json defect = list_defects({found.defect}, 0).front();
    for (const char* key : {"id", "rank", "depth_scallops"}) defect.erase(key);  // only meaningful in a list or report
    return line_of({{"event", "finding"},
                    {"number", found.number},
                    {"provisional", true},
                    {"time_s", number(static_cast<double>(found.defect.point) * period, 6)},
                    {"needed_point", found.needed},
                    {"records", found.recorded},
                    {"defect", std::move(defect)}});
}

std::string end_text(FollowEnd end, PointIndex records, double timeout) {
    const std::string why = end == FollowEnd::closed    ? "its writer closed it"
                            : end == FollowEnd::timeout ? fmt::format("it did not grow for {:g} s", timeout)
                                                        : "interrupted";
    return fmt::format("The log ends after {} records: {}.\n", records, why);
}

std::string end_json(FollowEnd end, PointIndex records) {
    return line_of({{"event", "end"}, {"reason", name_of(end)}, {"records", records}});
}

std::string resolved_text(const ResolvedFindings& resolved) {
    std::string confirmed, withdrawn;
    for (std::size_t k = 0; k < resolved.defects.size(); ++k) {
        const std::vector<std::size_t>& there = resolved.defects[k];
        std::string& list = there.empty() ? withdrawn : confirmed;
        list += list.empty() ? "" : there.empty() ? ", " : "; ";
        list += there.empty() ? fmt::format("{}", k + 1) : fmt::format("{} ({})", k + 1, ranks_text(there));
    }
    const std::size_t all = resolved.defects.size();
    std::string text = all == 0
                           ? "There were no findings while the log was written.\n"
                           : fmt::format("The complete log confirms {} of {} findings{}{}.\n",
                                         all - resolved.withdrawn(), all, confirmed.empty() ? "" : ": ", confirmed);
    if (!withdrawn.empty()) text += fmt::format("Withdrawn: {}. The complete log shows no defect there.\n", withdrawn);
    if (!resolved.late.empty()) text += fmt::format("Found in the complete log only: {}.\n", ranks_text(resolved.late));
    return text;
}

std::string resolved_json(const ResolvedFindings& resolved) {
    std::string text;
    for (std::size_t k = 0; k < resolved.defects.size(); ++k) {
        const std::vector<std::size_t>& there = resolved.defects[k];
        text += line_of(
            {{"event", there.empty() ? "withdrawn" : "confirmed"}, {"number", k + 1}, {"ranks", ranks_of(there)}});
    }
    return text;
}

std::string verdict_json(const ResolvedFindings& resolved, const std::string& report, ExitCode code) {
    return line_of({{"event", "verdict"},
                    {"exit_code", static_cast<int>(code)},
                    {"confirmed", resolved.defects.size() - resolved.withdrawn()},
                    {"withdrawn", resolved.withdrawn()},
                    {"late_ranks", ranks_of(resolved.late)},
                    {"report", Json::parse(report)}});
}

}  // namespace clsurf::io
