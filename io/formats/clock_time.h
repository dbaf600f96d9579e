#pragma once
// Times of day in text logs: ISO 8601 with or without a date, and the German date.
// Used inside io only.

#include <cstdint>
#include <optional>
#include <string_view>

namespace clsurf::io {

/// Day and time of day are separate: seconds since 1970 in one double are rounded to 0.24 µs, which
/// is visible in differences at 1 ms.
struct ClockTime {
    std::optional<std::int64_t> day;  ///< days since 1970-01-01, UTC if the text has an offset
    double second = 0;                ///< second of the day; beyond the day if an offset shifts it there

    /// Seconds since midnight of `first_day`; without a date, since midnight.
    [[nodiscard]] double since(std::int64_t first_day) const {
        return second + 86400.0 * static_cast<double>(day ? *day - first_day : 0);
    }
};

/// "2024-05-01T12:00:00.125Z", "2024/05/01 12:00:00,125 +02:00", "01.05.2024 12:00:00", "12:00:00.125"; otherwise nothing.
[[nodiscard]] std::optional<ClockTime> parse_clock(std::string_view field);

}  // namespace clsurf::io
