#include "io/files/utc.h"

#include <sys/stat.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <ctime>

#include <fmt/format.h>

#include "core/error.h"

namespace clsurf::io {
namespace {

using SystemTime = std::chrono::sys_seconds;

std::string utc_text(SystemTime time) {
    const auto day = std::chrono::floor<std::chrono::days>(time);
    const std::chrono::year_month_day date(day);
    const std::chrono::hh_mm_ss clock(time - day);
    return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", static_cast<int>(date.year()),
                       static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()), clock.hours().count(),
                       clock.minutes().count(), clock.seconds().count());
}

/// "+01:00" → 3600 s; "Z" and "" → 0. False: neither.
bool read_zone(const std::string& text, std::chrono::seconds& ahead) {
    if (text.empty() || text == "Z" || text == "z") return true;
    int hours = 0;
    int minutes = 0;
    int size = 0;
    if ((text[0] != '+' && text[0] != '-') ||
        std::sscanf(text.c_str() + 1, "%2d:%2d%n", &hours, &minutes, &size) != 2 ||
        static_cast<std::size_t>(size) + 1 != text.size() || hours > 14 || minutes > 59)
        return false;
    ahead = std::chrono::seconds((text[0] == '-' ? -1 : 1) * (3600 * hours + 60 * minutes));
    return true;
}

}  // namespace

std::string utc_now() { return utc_text(std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now())); }

std::string utc_with_milliseconds(std::chrono::system_clock::time_point time) {
    const auto second = std::chrono::floor<std::chrono::seconds>(time);
    const auto rest = std::chrono::floor<std::chrono::milliseconds>(time - second);
    std::string text = utc_text(second);
    text.pop_back();
    return text + fmt::format(".{:03}Z", rest.count());
}

std::string utc_of_file(const std::string& path) {
    struct stat status {};
    if (::stat(path.c_str(), &status) != 0)
        throw InputError(Place::of_file(path), std::string("cannot open: ") + std::strerror(errno));
    return utc_text(SystemTime(std::chrono::seconds(status.st_mtim.tv_sec)));
}

std::string parse_utc(const std::string& text, const std::string& option) {
    int year = 0;
    unsigned month = 0;
    unsigned day = 0;
    int hour = 0;
    int minute = 0;
    int second = 0;
    int date = -1;
    int hours = -1;
    int whole = -1;
    const int read = std::sscanf(text.c_str(), "%4d-%2u-%2u%n%*1[T ]%2d:%2d%n:%2d%n", &year, &month, &day, &date, &hour,
                                 &minute, &hours, &second, &whole);
    const int size = read >= 6 ? whole : read >= 5 ? hours : date;
    std::chrono::seconds ahead{0};
    const std::chrono::year_month_day calendar{std::chrono::year(year), std::chrono::month(month),
                                               std::chrono::day(day)};
    const bool good = read >= 3 && size > 0 && calendar.ok() && hour >= 0 && hour < 24 && minute >= 0 && minute < 60 &&
                      second >= 0 && second < 60 && read_zone(text.substr(static_cast<std::size_t>(size)), ahead);
    if (!good)
        throw UsageError(
            fmt::format("{}: '{}' is not a time such as 2026-11-24 or 2026-11-24T07:30:00+01:00", option, text));
    return utc_text(std::chrono::sys_days(calendar) + std::chrono::hours(hour) + std::chrono::minutes(minute) +
                    std::chrono::seconds(second) - ahead);
}

}  // namespace clsurf::io
