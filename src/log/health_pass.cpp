#include "log/health_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "core/block.h"
#include "core/counted.h"
#include "log/jump_rule.h"

namespace clsurf {
namespace {

constexpr double gap_periods = 1.5;                  ///< a longer step in time has lost records
constexpr double jitter_share = 0.05;                ///< rms as a share of a period; less is not reported
constexpr double heading_chord = 0.5;                ///< [mm] length of the chords for the heading
constexpr double least_turn = 0.05;                  ///< [rad] less is noise and fine chords of a curve
constexpr double stuck_arc_length = 50.0;            ///< [mm] at least, on one line
constexpr double stuck_turn = 3 * std::numbers::pi;  ///< [rad] to the left, and as much to the right

constexpr double shown_in_full = 1e7;  ///< [mm] a longer step is impossible for a machine, and may have 300 digits

constexpr PointIndex before = 2;             ///< number of records read before a section
constexpr PointIndex section_length = 2048;  ///< records whose channels stay in the cache together

bool is_position(const Channel& channel) {
    for (const Role role : {Role::commanded, Role::feedback, Role::actual}) {
        if (channel.name.starts_with(std::string(prefix_of(role)) + ".")) return true;
    }
    return false;
}

bool is_real(const Channel& channel) {
    return channel.values.type == ScalarType::f32 || channel.values.type == ScalarType::f64;
}

/// A line number and the motion of the tool while it stays. A single motion is straight or turns to one side; a tool
/// that turns left as much as right passes through many lines.
struct LineRun {
    double line = 0;
    PointIndex first = 0, end = 0;  ///< end exclusive
    double arc_length = 0;          ///< [mm]
    double left = 0, right = 0;     ///< [rad] turned, seen along Z

    [[nodiscard]] bool stuck() const {
        return line > 0 && arc_length > stuck_arc_length && std::min(left, right) > stuck_turn;
    }
    void append(const LineRun& next) {
        end = next.end;
        arc_length += next.arc_length;
        left += next.left;
        right += next.right;
    }
};

/// Heading of the tool from chords of a fixed length.
class Heading {
public:
    void restart(double x, double y) {
        x_ = x;
        y_ = y;
        dx_ = dy_ = 0;
    }
    /// The turn [rad, left positive] that ends at this position; 0: none yet.
    double go_to(double x, double y) {
        const double dx = x - x_;
        const double dy = y - y_;
        if (!(dx * dx + dy * dy >= heading_chord * heading_chord)) return 0;
        const double turn = dx_ == 0 && dy_ == 0 ? 0.0 : std::atan2(dx_ * dy - dy_ * dx, dx_ * dx + dy_ * dy);
        x_ = x;
        y_ = y;
        dx_ = dx;
        dy_ = dy;
        return std::abs(turn) < least_turn ? 0.0 : turn;
    }

private:
    double x_ = 0, y_ = 0, dx_ = 0, dy_ = 0;
};

struct Limits {
    double period = 0;     ///< [s]
    double jump = 0;       ///< [mm]
    double last_line = 0;  ///< last line of the program; infinite: unknown
};

/// Points with a line that is not in the program.
struct BadLines {
    PointIndex count = 0, first = -1;
    double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();

    void append(const BadLines& next) {
        if (count == 0) first = next.first;
        count += next.count;
        low = std::min(low, next.low);
        high = std::max(high, next.high);
    }
};

struct BlockSummary {
    Diagnostics diagnostics;
    std::vector<ChannelRange> ranges;
    double squares = 0, worst = 0;  ///< sum of squares, and greatest, of the clock's differences from the period
    PointIndex steps = 0;
    double highest_line = 0;
    BadLines bad_lines;
    std::vector<LineRun> runs;  ///< the first and the last, and stuck ones between
};

/// The channels of a log by their meaning.
struct Meanings {
    std::optional<std::size_t> time, line;
    /// Channels of x, y, z; a lathe has no y.
    using Axes = std::array<std::optional<std::size_t>, 3>;
    std::vector<Axes> roles;  ///< roles in the log
    std::vector<bool> read;   ///< channels to be read

    explicit Meanings(const Log& log) : read(log.channels.size()) {
        const auto index_of = [&](const std::string& name) -> std::optional<std::size_t> {
            const Channel* channel = log.find(name);
            if (channel == nullptr) return std::nullopt;
            return static_cast<std::size_t>(channel - log.channels.data());
        };
        time = index_of("time");
        line = index_of("line");
        for (const Role role : {Role::commanded, Role::feedback, Role::actual}) {
            if (!log.has(role)) continue;
            const std::string prefix(prefix_of(role));
            roles.push_back({index_of(prefix + ".x"), index_of(prefix + ".y"), index_of(prefix + ".z")});
        }
        for (std::size_t c = 0; c < read.size(); ++c) {
            read[c] = is_real(log.channels[c]) || is_position(log.channels[c]) || c == time || c == line;
        }
    }
};

/// A length in mm.
std::string length_text(double length) {
    return length < shown_in_full ? fmt::format("{:.3f}", length) : fmt::format("{:.3g}", length);
}

class BlockPass {
public:
    BlockPass(const Log& log, const Meanings& meanings, const Limits& limits)
        : log_(log), meanings_(meanings), limits_(limits), values_(log.channels.size()) {
        summary_.ranges.resize(log.channels.size(), {0, -1, std::numeric_limits<double>::infinity(),
                                                     -std::numeric_limits<double>::infinity()});
    }

    BlockSummary run(PointIndex first, PointIndex last) {
        run_.first = first;
        for (PointIndex begin = first; begin < last; begin += section_length) {
            begin_ = begin;
            end_ = std::min(last, begin + section_length);
            window_ = std::max<PointIndex>(0, begin - before);
            const PointIndex window_end = std::min(log_.records, end_ + 1);
            for (std::size_t c = 0; c < values_.size(); ++c) {
                if (!meanings_.read[c]) continue;
                values_[c].resize(static_cast<std::size_t>(window_end - window_));
                copy_block(log_.channels[c].values, window_, values_[c]);
                look_at_range(c);
            }
            gap_.assign(static_cast<std::size_t>(end_ - begin_), false);
            if (meanings_.time) look_at_time();
            for (const auto& axes : meanings_.roles) look_at_steps(axes);
            if (meanings_.line) look_at_lines();
        }
        if (meanings_.line) summary_.runs.push_back(run_);
        return std::move(summary_);
    }

private:
    [[nodiscard]] double value(std::size_t channel, PointIndex i) const {
        return values_[channel][static_cast<std::size_t>(i - window_)];
    }
    /// Distance from the previous record to i [mm]; 0 before the first record, NaN if a value is missing.
    [[nodiscard]] Vec3 step(const Meanings::Axes& axes, PointIndex i) const {
        if (i < 1 || i >= log_.records) return Vec3::Zero();
        const auto along = [&](std::optional<std::size_t> axis) {
            return axis ? value(*axis, i) - value(*axis, i - 1) : 0.0;
        };
        return {along(axes[0]), along(axes[1]), along(axes[2])};
    }
    void warn(const char* code, PointIndex point, std::string text) {
        summary_.diagnostics.add({Severity::warning, code, Place::of_point(log_.name, point), std::move(text), {}});
    }

    void look_at_range(std::size_t channel) {
        ChannelRange& range = summary_.ranges[channel];
        for (PointIndex i = begin_; i < end_; ++i) {
            const double v = value(channel, i);
            if (std::isfinite(v)) {
                range.low = std::min(range.low, v);
                range.high = std::max(range.high, v);
            } else if (range.missing++ == 0) {
                range.first_missing = i;
            }
        }
    }

    void look_at_time() {
        for (PointIndex i = std::max<PointIndex>(1, begin_); i < end_; ++i) {
            const double t = value(*meanings_.time, i);
            const double dt = t - value(*meanings_.time, i - 1);
            if (dt <= 0) {
                warn("log.time-back", i,
                     fmt::format("time {}: {:.6f} s after {:.6f} s", dt < 0 ? "goes back" : "stands still", t, t - dt));
            } else if (dt > gap_periods * limits_.period) {
                gap_[static_cast<std::size_t>(i - begin_)] = true;
                warn("log.time-gap", i,
                     fmt::format("{:.0f} records are missing: a step of {:.6f} s, the period is {:.6f} s",
                                 std::max(1.0, std::round(dt / limits_.period) - 1), dt, limits_.period));
            } else if (dt > 0) {
                const double off = std::abs(dt - limits_.period);
                summary_.squares += off * off;
                summary_.worst = std::max(summary_.worst, off);
                ++summary_.steps;
            }
        }
    }

    /// A jump that goes back with the next record is a spike and counts once.
    void look_at_steps(const Meanings::Axes& axes) {
        const double limit_squared = limits_.jump * limits_.jump;
        for (PointIndex i = std::max<PointIndex>(1, begin_); i < end_; ++i) {
            const Vec3 here = step(axes, i);
            if (!(here.squaredNorm() > limit_squared) || gap_[static_cast<std::size_t>(i - begin_)]) continue;
            // Bytes that are not positions may be numbers whose square overflows.
            const double length = here.stableNorm();
            const Vec3 next = step(axes, i + 1);
            const double next_length = next.stableNorm();
            const double last_length = step(axes, i - 1).stableNorm();
            const bool spike = comes_back((here / length).dot(next), 1.0, next_length);
            if (!is_jump(last_length, length, next_length, spike)) continue;
            std::string role = log_.channels[*axes[0]].name;
            role.resize(role.find('.'));
            warn("log.jump", i,
                 fmt::format("the position {} jumps by {} mm in one period; the step before it is {} mm{}", role,
                             length_text(length), length_text(last_length), spike ? ", the next one comes back" : ""));
        }
    }

    void look_at_lines() {
        const std::size_t line = *meanings_.line;
        for (PointIndex i = begin_; i < end_; ++i) {
            const double now = value(line, i);
            const double last = i > 0 ? value(line, i - 1) : now;
            const double next = i + 1 < log_.records ? value(line, i + 1) : now;
            const bool known = now >= 0 && now <= limits_.last_line && now == std::floor(now);
            if (!(now == now)) {
                // It is reported as a missing value.
            } else if (!known) {
                summary_.bad_lines.append({1, i, now, now});
            } else {
                summary_.highest_line = std::max(summary_.highest_line, now);
                // To 0 and back is a pause between blocks; to the next line and back is a blend.
                if (now > 0 && last > 0 && last == next && std::abs(now - last) > 1) {
                    warn("log.line-wild", i,
                         fmt::format("line {:.0f} for one record, between records of line {:.0f}", now, last));
                }
            }
            follow_run(now, i);
        }
    }

    void follow_run(double line, PointIndex i) {
        if (i == run_.first && !started_) run_.line = line;
        if (line != run_.line && !(std::isnan(line) && std::isnan(run_.line))) {
            // The first run may continue from the block before: it is always kept.
            if (summary_.runs.empty() || run_.stuck()) summary_.runs.push_back(run_);
            run_ = {line, i, i, 0, 0, 0};
            started_ = false;
        }
        run_.end = i + 1;
        if (meanings_.roles.empty()) return;
        const auto& axes = meanings_.roles.front();
        const double x = value(*axes[0], i);
        const double y = value(axes[1] ? *axes[1] : *axes[2], i);  // for a lathe the plane of X and Z
        if (!std::isfinite(x + y)) return;
        if (!started_) {
            heading_.restart(x, y);
            started_ = true;
            return;
        }
        const double arc_length = step(axes, i).norm();
        if (std::isfinite(arc_length)) run_.arc_length += arc_length;
        const double turn = heading_.go_to(x, y);
        (turn > 0 ? run_.left : run_.right) += std::abs(turn);
    }

    const Log& log_;
    const Meanings& meanings_;
    Limits limits_;
    BlockSummary summary_;
    std::vector<std::vector<double>> values_;  ///< by channel: records from window_ on
    std::vector<bool> gap_;                    ///< by record: a gap in time before it
    PointIndex window_ = 0, begin_ = 0, end_ = 0;
    LineRun run_;
    Heading heading_;
    bool started_ = false;
};

/// The summaries joined in order.
class Join {
public:
    Join(const Log& log, const Limits& limits) : log_(log), limits_(limits) {
        found_.ranges.resize(log.channels.size(), {0, -1, std::numeric_limits<double>::infinity(),
                                                   -std::numeric_limits<double>::infinity()});
    }

    void add(const BlockSummary& block) {
        found_.diagnostics.append(block.diagnostics);
        for (std::size_t c = 0; c < found_.ranges.size(); ++c) {
            ChannelRange& all = found_.ranges[c];
            const ChannelRange& range = block.ranges[c];
            if (all.missing == 0) all.first_missing = range.first_missing;
            all.missing += range.missing;
            all.low = std::min(all.low, range.low);
            all.high = std::max(all.high, range.high);
        }
        squares_ += block.squares;
        worst_ = std::max(worst_, block.worst);
        steps_ += block.steps;
        highest_line_ = std::max(highest_line_, block.highest_line);
        bad_lines_.append(block.bad_lines);
        for (const LineRun& run : block.runs) {
            if (have_run_ && run.line == run_.line && run.first == run_.end) {
                run_.append(run);
                continue;
            }
            close_run();
            run_ = run;
            have_run_ = true;
        }
    }

    RecordFindings finish(bool has_line) {
        close_run();
        note_bad_lines();
        const double rms = steps_ > 0 ? std::sqrt(squares_ / static_cast<double>(steps_)) : 0.0;
        if (rms > jitter_share * limits_.period) {
            found_.diagnostics.add({Severity::warning,
                                    "log.jitter",
                                    Place::of_file(log_.name),
                                    fmt::format("the period of {:.6f} s jitters by {:.3g} ms rms, {:.3g} ms at most",
                                                limits_.period, rms * 1e3, worst_ * 1e3),
                                    {}});
        }
        if (has_line && highest_line_ == 0) {
            found_.diagnostics.add({Severity::warning, "log.line-stuck", Place::of_file(log_.name),
                                    "the line number is 0 all the time", "--ignore-lines finds the lines by geometry"});
        }
        return std::move(found_);
    }

private:
    void close_run() {
        if (!have_run_ || !run_.stuck()) return;
        found_.diagnostics.add(
            {Severity::warning, "log.line-stuck", Place::of_point(log_.name, run_.first),
             fmt::format(
                 "the line number stays {:.0f} for {:.1f} mm, while the tool turns left by {:.0f}° and right by {:.0f}°: more than one motion",
                 run_.line, run_.arc_length, run_.left * 180 / std::numbers::pi, run_.right * 180 / std::numbers::pi),
             "--ignore-lines finds the lines by geometry"});
    }

    void note_bad_lines() {
        if (bad_lines_.count == 0) return;
        std::string numbers = fmt::format("{}", bad_lines_.low);
        const std::string points = counted(bad_lines_.count, "point") + (bad_lines_.count == 1 ? " has" : " have");
        if (bad_lines_.high > bad_lines_.low) numbers += fmt::format(" … {}", bad_lines_.high);
        found_.diagnostics.add(
            {Severity::warning, "log.line-range", Place::of_point(log_.name, bad_lines_.first),
             std::isfinite(limits_.last_line)
                 ? fmt::format("{} a line number that the program of {:.0f} lines does not have: {}; the first is here",
                               points, limits_.last_line, numbers)
                 : fmt::format("{} a value that is not a line number: {}; the first is here", points, numbers),
             "another program, or another version of it?"});
    }

    const Log& log_;
    Limits limits_;
    RecordFindings found_;
    double squares_ = 0, worst_ = 0;
    PointIndex steps_ = 0;
    double highest_line_ = 0;
    BadLines bad_lines_;
    LineRun run_;
    bool have_run_ = false;
};

}  // namespace

RecordFindings check_records(const Log& log, double period, LineNumber program_lines) {
    const Limits limits{
        period, longest_step(period),
        program_lines > 0 ? static_cast<double>(program_lines) : std::numeric_limits<double>::infinity()};
    const Meanings meanings(log);
    std::vector<BlockSummary> summaries(static_cast<std::size_t>((log.records + block_points - 1) / block_points));
    for_each_block(log.records, [&](PointIndex first, PointIndex last) {
        summaries[static_cast<std::size_t>(first / block_points)] = BlockPass(log, meanings, limits).run(first, last);
    });
    Join join(log, limits);
    for (const BlockSummary& summary : summaries) join.add(summary);
    return join.finish(meanings.line.has_value());
}

}  // namespace clsurf
