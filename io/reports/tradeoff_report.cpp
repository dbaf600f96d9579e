#include "io/reports/tradeoff_report.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/units.h"
#include "io/files/json_value.h"

namespace clsurf::io {
namespace {

/// "3.2 % more time", "41.0 % less mismatch"
std::string change_text(double value, double reference, std::string_view of) {
    if (!(reference > 0)) return fmt::format("as much {}", of);
    const double percent = 100 * (value / reference - 1);
    return fmt::format("{:.1f} % {} {}", std::abs(percent), percent > 0 ? "more" : "less", of);
}

std::string chosen_text(const TradeoffFront& front) {
    if (!front.chosen) return {};
    const TradeoffRow& row = front.rows[*front.chosen];
    const MotionQuality &is = row.quality, &was = front.rows.front().quality;
    const std::string by = front.weight ? fmt::format(" by weight {:g}", *front.weight) : std::string();
    if (*front.chosen == 0) return fmt::format("chosen{}: 1, {}\n", by, row.name);
    return fmt::format("chosen{}: {}, {}: {}, {}, {}\n", by, *front.chosen + 1, row.name,
                       change_text(is.duration, was.duration, "time"),
                       change_text(is.mismatch, was.mismatch, "mismatch"), change_text(is.jerk, was.jerk, "jerk"));
}

}  // namespace

std::string tradeoff_text(const TradeoffFront& front, const TradeoffWords& words) {
    constexpr const char* heads = "{:>2}{:>4} {:>9} {:>9} {:>9} {:>9} {:>9} {:>8} {:>8}  {}\n";
    std::string text =
        fmt::format(fmt::runtime(heads), "", "", "time", "mismatch", "", "jerk", "", "deepest", "defects", words.name);
    text += fmt::format(fmt::runtime(heads), "", "", "s", "p95", "rms", "p95", "rms", "mark", "", "");
    text += fmt::format(fmt::runtime(heads), "", "", "", "mm/min", "mm/min", "mm/s³", "mm/s³", "µm", "", "");
    for (std::size_t k = 0; k < front.rows.size(); ++k) {
        const TradeoffRow& row = front.rows[k];
        const bool is_chosen = front.chosen == k;
        if (words.only_front && !row.on_front && !is_chosen && k > 0) continue;
        const MotionQuality& q = row.quality;
        text += fmt::format("{}{}{:>4} {:>9.3f} {:>9.1f} {:>9.1f} {:>9.0f} {:>9.0f} {:>8.2f} {:>8}  {}\n",
                            row.on_front ? '*' : ' ', is_chosen ? '>' : ' ', k + 1, q.duration,
                            q.mismatch * seconds_per_minute, q.mismatch_rms * seconds_per_minute, q.jerk, q.jerk_rms,
                            row.deepest * um_per_mm, row.defects, row.name);
    }
    text += fmt::format("{} of {} {} are on the front (*): no other one is better in time, mismatch p95 and jerk p95\n",
                        std::ranges::count(front.rows, true, &TradeoffRow::on_front), front.rows.size(), words.rows);
    return text + chosen_text(front);
}

std::string tradeoff_csv(const TradeoffFront& front) {
    std::string text =
        "number,front,chosen,time [s],speed_difference_p95 [mm/min],speed_difference_rms [mm/min],jerk_p95 "
        "[mm/s³],jerk_rms [mm/s³],deepest [µm],defects,name\n";
    for (std::size_t k = 0; k < front.rows.size(); ++k) {
        const TradeoffRow& row = front.rows[k];
        const MotionQuality& q = row.quality;
        text += fmt::format("{},{:d},{:d},{:.6f},{:.3f},{:.3f},{:.1f},{:.1f},{:.3f},{},\"{}\"\n", k + 1, row.on_front,
                            front.chosen == k, q.duration, q.mismatch * seconds_per_minute,
                            q.mismatch_rms * seconds_per_minute, q.jerk, q.jerk_rms, row.deepest * um_per_mm,
                            row.defects, row.name);
    }
    return text;
}

std::string tradeoff_json(const TradeoffFront& front, std::span<const PlanSettings> settings,
                          const Diagnostics& diagnostics) {
    Json rows = Json::array();
    for (std::size_t k = 0; k < front.rows.size(); ++k) {
        const TradeoffRow& row = front.rows[k];
        const MotionQuality& q = row.quality;
        rows.push_back({{"number", k + 1},
                        {"name", row.name},
                        {"front", row.on_front},
                        {"chosen", front.chosen == k},
                        {"time_s", number(q.duration, 6)},
                        {"speed_difference_p95_mm_min", number(q.mismatch * seconds_per_minute, 3)},
                        {"speed_difference_rms_mm_min", number(q.mismatch_rms * seconds_per_minute, 3)},
                        {"jerk_p95_mm_s3", number(q.jerk, 1)},
                        {"jerk_rms_mm_s3", number(q.jerk_rms, 1)},
                        {"deepest_um", number(row.deepest * um_per_mm, 3)},
                        {"defects", row.defects}});
        if (settings.empty()) continue;
        rows.back()["settings"] = {{"jerk_percent", number(100 * settings[k].jerk, 6)},
                                   {"acceleration_percent", number(100 * settings[k].acceleration, 6)},
                                   {"feed_percent", number(100 * settings[k].feed, 6)},
                                   {"feed", settings[k].intervals ? "intervals" : "programmed"}};
    }
    return dump(Json{{"rows", std::move(rows)},
                     {"weight", front.weight ? number(*front.weight) : Json(nullptr)},
                     {"chosen", front.chosen ? Json(*front.chosen + 1) : Json(nullptr)},
                     {"diagnostics", list(diagnostics)}});
}

}  // namespace clsurf::io
