#include "io/formats/clock_time.h"

#include <charconv>
#include <chrono>

namespace clsurf::io {
namespace {

/// Consumes a text from its front; if a part does not match, nothing is consumed.
class Scanner {
public:
    explicit Scanner(std::string_view text) : rest_(text) {}

    [[nodiscard]] bool at_end() const { return rest_.empty(); }
    [[nodiscard]] char front() const { return rest_.empty() ? '\0' : rest_.front(); }
    /// A number of `least` to `most` digits.
    [[nodiscard]] std::optional<int> digits(std::size_t least, std::size_t most) {
        std::size_t count = 0;
        while (count < rest_.size() && count < most && rest_[count] >= '0' && rest_[count] <= '9') ++count;
        if (count < least) return std::nullopt;
        int value = 0;
        std::from_chars(rest_.data(), rest_.data() + count, value);
        rest_.remove_prefix(count);
        return value;
    }
    /// One of these characters.
    bool any_of(std::string_view wanted) {
        if (rest_.empty() || wanted.find(rest_.front()) == std::string_view::npos) return false;
        rest_.remove_prefix(1);
        return true;
    }
    /// ".125" or ",125"; 0 if there is none.
    [[nodiscard]] double fraction() {
        double value = 0;
        if (!any_of(".,")) return 0;
        for (double unit = 0.1; front() >= '0' && front() <= '9'; unit *= 0.1) {
            value += unit * (front() - '0');
            rest_.remove_prefix(1);
        }
        return value;
    }

private:
    std::string_view rest_;
};

/// 2024-05-01, 2024/05/01, 01.05.2024. Dates with the month first are not read: they look like dates with the day first.
std::optional<std::int64_t> date(Scanner& scan) {
    const std::optional<int> first = scan.digits(1, 4);
    const char separator = scan.front();
    if (!first || !scan.any_of("-/.")) return std::nullopt;
    const std::optional<int> month = scan.digits(1, 2);
    if (!month || !scan.any_of({&separator, 1})) return std::nullopt;
    const std::optional<int> last = scan.digits(1, 4);
    const bool year_first = separator != '.';
    if (!last || (year_first ? *first : *last) < 1000) return std::nullopt;
    const std::chrono::year_month_day day{std::chrono::year(year_first ? *first : *last),
                                          std::chrono::month(static_cast<unsigned>(*month)),
                                          std::chrono::day(static_cast<unsigned>(year_first ? *last : *first))};
    if (!day.ok()) return std::nullopt;
    return std::chrono::sys_days(day).time_since_epoch().count();
}

/// "Z", "+02:00", "-0530", "+01": seconds to subtract. Also true without an offset; false: malformed.
bool offset(Scanner& scan, double& seconds) {
    if (scan.any_of("Zz")) return true;
    const bool west = scan.front() == '-';
    if (!scan.any_of("+-")) return true;
    const std::optional<int> hours = scan.digits(2, 2);
    const bool colon = scan.any_of(":");
    const std::optional<int> minutes = scan.digits(2, 2);
    if (!hours || (colon && !minutes)) return false;
    seconds = (west ? -1 : 1) * (3600.0 * *hours + 60.0 * minutes.value_or(0));
    return true;
}

}  // namespace

std::optional<ClockTime> parse_clock(std::string_view field) {
    ClockTime time;
    const std::size_t colon = field.find(':');
    if (colon == std::string_view::npos) return std::nullopt;
    Scanner scan(field);
    if (field.substr(0, colon).find_first_of("-/.") != std::string_view::npos) {
        time.day = date(scan);
        if (!time.day || !scan.any_of("Tt ")) return std::nullopt;
    }
    const std::optional<int> hours = scan.digits(1, 2);
    if (!hours || *hours > 23 || !scan.any_of(":")) return std::nullopt;
    const std::optional<int> minutes = scan.digits(2, 2);
    if (!minutes || *minutes > 59 || !scan.any_of(":")) return std::nullopt;
    const std::optional<int> seconds = scan.digits(2, 2);
    if (!seconds || *seconds > 60) return std::nullopt;
    time.second = 3600.0 * *hours + 60.0 * *minutes + *seconds + scan.fraction();
    (void)scan.any_of(" ");
    double off = 0;
    if (!offset(scan, off) || !scan.at_end()) return std::nullopt;
    time.second -= off;
    return time;
}

}  // namespace clsurf::io
