#include "mapping/program_runs.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "mapping/allowed_motions.h"
#include "toolpath/toolpath.h"

namespace clsurf {
namespace {

constexpr int fewest_repeated = 3;  ///< repeated cutting motions: fewer may be a number that flickers

class RunFinder {
public:
    /// A point at which another motion begins.
    void add(PointIndex point, std::int64_t motion, bool cuts) {
        if (runs_.back().last_motion < runs_.back().first_motion) {
            runs_.back().first_motion = runs_.back().last_motion = motion;
            note(motion);
            return;
        }
        std::int64_t& top = repeated_ ? repeated_->last_motion : runs_.back().last_motion;
        if (motion + 1 < top) {
            repeated_ = ProgramRun{point, motion, motion};
            count_ = 0;
        } else {
            top = std::max(top, motion);
        }
        if (!repeated_) return note(motion);
        repeated_->first_motion = std::min(repeated_->first_motion, motion);
        ProgramRun& run = runs_.back();
        if (cuts && has(motion)) ++count_;
        if (count_ >= fewest_repeated) {
            runs_.push_back(*repeated_);
            repeated_.reset();
            std::fill(executed_.begin(), executed_.end(), false);
            note(motion);
        } else if (motion > run.last_motion) {
            run.first_motion = std::min(run.first_motion, repeated_->first_motion);
            run.last_motion = motion;
            repeated_.reset();
            note(motion);
        }
    }

    std::vector<ProgramRun> take() { return std::move(runs_); }

private:
    void note(std::int64_t motion) {
        const auto m = static_cast<std::size_t>(motion);
        if (m >= executed_.size()) executed_.resize(std::max(m + 1, 2 * executed_.size()));
        executed_[m] = true;
    }
    [[nodiscard]] bool has(std::int64_t motion) const {
        return static_cast<std::size_t>(motion) < executed_.size() && executed_[static_cast<std::size_t>(motion)];
    }

    std::vector<ProgramRun> runs_{1};
    std::vector<bool> executed_;          ///< motions of the last run
    std::optional<ProgramRun> repeated_;  ///< place at which the log went back: possibly a run
    int count_ = 0;                       ///< cutting motions since then that the previous run had, too
};

}  // namespace

std::vector<ProgramRun> find_program_runs(const LineMap& lines) {
    // Points that are read at once; results do not depend on it.
    constexpr std::size_t block = 4096;
    std::array<LineNumber, block> numbers;
    std::array<PointKind, block> kinds;
    const bool one_motion_a_line = lines.point_motions().empty();
    RunFinder finder;
    LineNumber line = 0;
    std::int64_t motion = -1;
    for (PointIndex begin = 0; begin < lines.count(); begin += static_cast<PointIndex>(block)) {
        const auto n =
            static_cast<std::size_t>(std::min<PointIndex>(static_cast<PointIndex>(block), lines.count() - begin));
        lines.read(begin, {numbers.data(), n});
        lines.read_kinds(begin, {kinds.data(), n});
        for (std::size_t i = 0; i < n; ++i) {
            if (numbers[i] == 0 || (one_motion_a_line && numbers[i] == line)) continue;
            line = numbers[i];
            const PointIndex point = begin + static_cast<PointIndex>(i);
            const std::int64_t now = lines.motion_at(point, line);
            if (now < 0 || now == motion) continue;
            motion = now;
            finder.add(point, motion, kinds[i] == PointKind::cut);
        }
    }
    return finder.take();
}

std::vector<PointRange> find_returns(const Trajectory& path, const Program& program, const LineMap& lines,
                                     std::span<const ProgramRun> runs) {
    std::vector<PointRange> returns;
    if (runs.size() < 2) return returns;
    const Toolpath toolpath(program.motions, path.at(0));
    const double tolerance = corner_tolerance(program);
    const auto is_off = [&](PointIndex point) {
        const std::int64_t motion = lines.motion_at(point);
        if (motion < 0) return true;
        double nearest = std::numeric_limits<double>::infinity();
        const MotionRange allowed = allowed_motions(-1, motion, toolpath.size());
        for (std::int64_t m = allowed.first; m <= allowed.last; ++m)
            nearest = std::min(nearest, toolpath.projection(m, path.at(point)).distance);
        return nearest > tolerance;
    };
    for (std::size_t k = 1; k < runs.size(); ++k) {
        PointIndex first = runs[k].first;
        while (first > runs[k - 1].first && is_off(first - 1)) --first;
        if (first < runs[k].first) returns.push_back({first, runs[k].first - 1});
    }
    return returns;
}

}  // namespace clsurf
