#include "mapping/feed_edits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/block.h"
#include "core/statistics.h"
#include "core/units.h"
#include "program/feed_mode_cursor.h"

namespace clsurf {
namespace {

constexpr double another_feed = 0.03;           ///< relative difference from the programmed one
constexpr double same_speed = 0.005;            ///< relative scatter of a constant speed
constexpr std::size_t fewest_of_section = 200;  ///< points of a section
constexpr std::size_t most_reported = 3;

/// Consecutive points whose motions have the same feed.
struct FeedSection {
    float feed = 0;  ///< [mm/s]; 0: not checked
    LineNumber first_line = 0, last_line = 0;
    std::vector<float> speeds;  ///< [mm/s]
};

/// The speed at which a section mostly ran if it is constant, or the highest one that it reached if that exceeds the
/// programmed feed; none if the section is not informative.
std::optional<double> significant_speed(FeedSection& run) {
    if (run.feed <= 0 || run.speeds.size() < fewest_of_section) return std::nullopt;
    const double middle = quantile_below(run.speeds, 0.5);
    const double high = quantile_below(run.speeds, 0.9);
    const bool constant = high - middle <= same_speed * high;
    const double feed = run.feed;
    if (high > feed * (1 + another_feed)) return high;
    if (constant && high < feed * (1 - another_feed)) return high;
    return std::nullopt;
}

class FeedComparison {
public:
    explicit FeedComparison(const Program& program) : program_(program) {
        FeedModeCursor feed_mode(program);
        const Motions& motions = program.motions;
        feed_.resize(motions.kind.size(), 0);
        for (std::size_t m = 0; m < feed_.size(); ++m) {
            const bool cuts = is_cut(motions.kind[m]);
            if (feed_mode.per_minute(static_cast<std::int64_t>(m)) && cuts) feed_[m] = motions.feed[m];
        }
    }

    void add(std::int64_t motion, LineNumber line, float speed) {
        const float feed = motion < 0 ? 0 : feed_[static_cast<std::size_t>(motion)];
        if (feed != now_.feed) {
            close();
            now_.feed = feed;
            now_.first_line = line;
        }
        if (feed <= 0) return;
        now_.first_line = std::min(now_.first_line, line);
        now_.last_line = std::max(now_.last_line, line);
        now_.speeds.push_back(speed);
    }

    void close() {
        if (const std::optional<double> speed = significant_speed(now_))
            found_.push_back(fmt::format("lines {}-{} ran at {:.0f} mm/min, the program says F{:g}", now_.first_line,
                                         now_.last_line, *speed * seconds_per_minute,
                                         std::round(1e3 * now_.feed * seconds_per_minute) / 1e3));
        now_ = {};
    }

    void report(Diagnostics& diagnostics) const {
        for (std::size_t k = 0; k < std::min(most_reported, found_.size()); ++k) {
            const std::size_t more = k + 1 == most_reported ? found_.size() - most_reported : 0;
            diagnostics.add({Severity::warning, "map.feed", Place::of_file(program_.main().name()),
                             found_[k] + (more > 0 ? fmt::format(", and {} more sections", more) : std::string()),
                             "the feed was changed after the run, or an override was active"});
        }
    }

private:
    const Program& program_;
    std::vector<float> feed_;  ///< by motion [mm/s]; 0: a rapid, a dwell, or not per minute
    FeedSection now_;
    std::vector<std::string> found_;
};

}  // namespace

void note_changed_feeds(const Trajectory& path, double period, const Program& program, const LineMap& map,
                        Diagnostics& diagnostics) {
    if (path.kinematics || !(period > 0)) return;
    FeedComparison feeds(program);
    std::vector<double> x(static_cast<std::size_t>(block_points)), y(x.size()), z(x.size());
    std::vector<LineNumber> lines(x.size());
    Vec3 before = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
    for (PointIndex begin = 0; begin < path.count; begin += block_points) {
        const auto n = static_cast<std::size_t>(std::min(block_points, path.count - begin));
        path.read(begin, {x.data(), n}, {y.data(), n}, {z.data(), n});
        map.read(begin, {lines.data(), n});
        for (std::size_t i = 0; i < n; ++i) {
            const Vec3 p(x[i], y[i], z[i]);
            const double speed = (p - before).norm() / period;
            before = p;
            if (!std::isfinite(speed)) continue;
            feeds.add(map.motion_at(begin + static_cast<PointIndex>(i), lines[i]), lines[i], static_cast<float>(speed));
        }
    }
    feeds.close();
    feeds.report(diagnostics);
}

}  // namespace clsurf
