#pragma once
// Times of day as text logs write them: ISO 8601 with or without a date, and the German date.
// Used inside io only.

#include <cstdint>
#include <optional>
#include <string_view>

namespace clsurf::io {

/// Day and time of day are kept apart: seconds since 1970 in one double are rounded to 0.24 µs, which
/// differences at 1 ms would show.
struct ClockTime {
    std::optional<std::int64_t> day;  ///< since 1970-01-01, UTC where the text has an offset
    double second = 0;                ///< of the day; beyond it where an offset takes it there

    /// Seconds since midnight before a day; without a date, of the day.
    [[nodiscard]] double since(std::int64_t first_day) const {
        return second + 86400.0 * static_cast<double>(day ? *day - first_day : 0);
    }
};

/// "2024-05-01T12:00:00.125Z", "2024/05/01 12:00:00,125 +02:00", "01.05.2024 12:00:00", "12:00:00.125"; else nothing.
[[nodiscard]] std::optional<ClockTime> parse_clock(std::string_view field);

}  // namespace clsurf::io
