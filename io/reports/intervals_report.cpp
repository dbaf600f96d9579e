#include "io/reports/intervals_report.h"

#include <fmt/format.h>

#include "core/units.h"
#include "io/files/json_value.h"

namespace clsurf::io {

std::string intervals_text(const ProgramIntervals& all) {
    constexpr const char* heads = "{:>5} {:>15} {:>9} {:>12} {:>12} {:>8} {:>8} {:>8}\n";
    std::string text =
        fmt::format(fmt::runtime(heads), "pass", "lines", "length", "curvature", "greatest", "feed", "own", "planned");
    text += fmt::format(fmt::runtime(heads), "", "", "mm", "1/mm", "1/mm", "mm/min", "mm/min", "mm/min");
    for (const ProgramInterval& i : all.intervals) {
        text += fmt::format("{:>5} {:>15} {:>9.3f} {:>12.4f} {:>12.4f} {:>8.0f} {:>8.0f} {:>8.0f}\n", i.pass,
                            fmt::format("{}-{}", i.first_line, i.last_line), i.length, i.mean_curvature,
                            i.greatest_curvature, i.feed * seconds_per_minute, i.own_speed * seconds_per_minute,
                            i.speed * seconds_per_minute);
    }
    text += fmt::format("\n{} intervals on {} passes\n", all.intervals.size(), all.passes);
    if (all.passes == 0)
        text +=
            "no finishing pass has two cutting motions in a row: there is nothing to divide; a finishing pass has others next "
            "to it, one step-over away\n";
    return text;
}

std::string intervals_csv(const ProgramIntervals& all) {
    std::string text =
        "pass,first_line,last_line,length [mm],mean_curvature [1/mm],greatest_curvature [1/mm],feed [mm/min],"
        "own_speed [mm/min],speed [mm/min]\n";
    for (const ProgramInterval& i : all.intervals) {
        text += fmt::format("{},{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", i.pass, i.first_line, i.last_line,
                            i.length, i.mean_curvature, i.greatest_curvature, i.feed * seconds_per_minute,
                            i.own_speed * seconds_per_minute, i.speed * seconds_per_minute);
    }
    return text;
}

std::string intervals_json(const ProgramIntervals& all, const Diagnostics& diagnostics) {
    Json intervals = Json::array();
    for (const ProgramInterval& i : all.intervals) {
        intervals.push_back({{"pass", i.pass},
                             {"lines", Json::array({i.first_line, i.last_line})},
                             {"length_mm", number(i.length, 4)},
                             {"mean_curvature_per_mm", number(i.mean_curvature, 6)},
                             {"greatest_curvature_per_mm", number(i.greatest_curvature, 6)},
                             {"feed_mm_min", number(i.feed * seconds_per_minute, 2)},
                             {"own_speed_mm_min", number(i.own_speed * seconds_per_minute, 2)},
                             {"speed_mm_min", number(i.speed * seconds_per_minute, 2)}});
    }
    Json summary{
        {"passes", all.passes}, {"intervals", all.intervals.size()}, {"step_over_mm", number(all.step_over, 5)}};
    return dump(
        Json{{"intervals", std::move(intervals)}, {"summary", std::move(summary)}, {"diagnostics", list(diagnostics)}});
}

}  // namespace clsurf::io
