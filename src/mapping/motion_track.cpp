#include "mapping/motion_track.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <vector>

#include "mapping/allowed_motions.h"
#include "mapping/line_map.h"
#include "mapping/path_walk.h"
#include "mapping/program_lines.h"

namespace clsurf {
namespace {

constexpr std::int64_t searched_per_point = 8;  ///< motions that may be searched per point, on average
constexpr std::int64_t group_window = 256;      ///< motions of one line that a walk may look ahead

/// Consecutive motions of one line of one file, or of the calls of one line.
struct Section {
    std::uint32_t first = 0, last = 0;
};

/// The sections of each line of each file, in the order of execution.
class LineSections {
public:
    explicit LineSections(const Program& program) {
        const Motions& motions = program.motions;
        for (const SourceText& file : program.files) {
            base_.push_back(keys_);
            keys_ += std::size_t{file.line_count()} + 1;
        }
        std::vector<std::size_t> own(motions.kind.size());
        for (std::size_t i = 0; i < own.size(); ++i)
            own[i] = key(motions.file.empty() ? 0 : motions.file[i], motions.line[i]);
        Column<std::uint32_t> with_own(keys_, 0);
        for (const std::size_t k : own) with_own[k] = 1;
        // A line that calls and has no motion of its own represents the called motions.
        const std::vector<std::size_t> caller = callers(program);
        const auto called = [&](std::size_t i) {
            const std::size_t k = motions.call.empty() ? no_key : caller[motions.call[i]];
            return k != no_key && with_own[k] == 0 ? k : no_key;
        };
        first_of_key_ = Column<std::uint32_t>(keys_ + 1, 0);
        const auto for_each = [&](auto&& body) {
            for_each_section(
                own.size(), [&](std::size_t i) { return own[i]; }, body);
            if (!motions.call.empty()) for_each_section(own.size(), called, body);
        };
        for_each([&](std::size_t k, Section) { ++first_of_key_[k + 1]; });
        for (std::size_t k = 0; k < keys_; ++k) first_of_key_[k + 1] += first_of_key_[k];
        sections_.resize(first_of_key_[keys_]);
        Column<std::uint32_t> next = first_of_key_;
        for_each([&](std::size_t k, Section s) { sections_[next[k]++] = s; });
    }

    [[nodiscard]] std::size_t files() const { return base_.size(); }
    /// The sections of a line; none if the file does not have the line.
    [[nodiscard]] std::span<const Section> of(std::size_t file, LineNumber line) const {
        const std::size_t end = file + 1 < base_.size() ? base_[file + 1] : keys_;
        if (base_[file] + line >= end) return {};
        const std::size_t k = base_[file] + line;
        return {sections_.data() + first_of_key_[k], sections_.data() + first_of_key_[k + 1]};
    }

private:
    static constexpr std::size_t no_key = std::numeric_limits<std::size_t>::max();

    [[nodiscard]] std::size_t key(std::size_t file, LineNumber line) const { return base_[file] + line; }

    /// By call: the line of the main program that led to it.
    [[nodiscard]] std::vector<std::size_t> callers(const Program& program) const {
        std::vector<std::size_t> keys(program.motions.calls.size() + 1, no_key);
        for (std::size_t k = 0; k < program.motions.calls.size(); ++k) {
            const Call& call = program.motions.calls[k];
            keys[k + 1] = call.caller == 0 ? key(call.file, call.line) : keys[call.caller];
        }
        return keys;
    }

    template <typename KeyOf, typename Body>
    static void for_each_section(std::size_t count, const KeyOf& key_of, const Body& body) {
        for (std::size_t i = 0; i < count;) {
            const std::size_t k = key_of(i);
            const std::size_t first = i;
            while (i < count && key_of(i) == k) ++i;
            if (k != no_key) body(k, {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(i - 1)});
        }
    }

    std::size_t keys_ = 0;
    std::vector<std::size_t> base_;       ///< by file: key of its line 0
    Column<std::uint32_t> first_of_key_;  ///< by key: index of its first section in sections_
    Column<Section> sections_;            ///< sorted by key, then by motion
};

class MotionTracker {
public:
    MotionTracker(const Trajectory& path, const Program& program, double tolerance)
        : path_(path),
          toolpath_(program.motions, path.count > 0 ? path.at(0) : Vec3::Zero()),
          walk_(toolpath_),
          sections_(program),
          tolerance_(tolerance) {}

    static constexpr std::int32_t any_file = -1, unknown_file = -2;

    /// The motion of the next point, or −1.
    std::int64_t add(LineNumber line, std::int32_t file, const Vec3& p) {
        budget_ += searched_per_point;
        const double chord = p.allFinite() && before_.allFinite() ? (p - before_).norm() : 0.0;
        before_ = p;
        if (line == 0 || file == unknown_file) {
            line_ = 0;
            return -1;
        }
        if (line != line_ || file != file_) {
            line_ = line;
            file_ = file;
            begin_run(p);
        } else if (has_motion_ && p.allFinite()) {
            go_on(p, chord);
        }
        return has_motion_ ? state_.motion : -1;
    }

private:
    /// The first section of the run's line that begins after `motion`; nullptr: none.
    [[nodiscard]] const Section* next_after(std::int64_t motion) const {
        const Section* next = nullptr;
        for_files([&](std::size_t file) {
            const std::span<const Section> all = sections_.of(file, line_);
            const auto at = std::upper_bound(all.begin(), all.end(), motion,
                                             [](std::int64_t m, const Section& s) { return m < s.first; });
            if (at != all.end() && (next == nullptr || at->first < next->first)) next = &*at;
        });
        return next;
    }

    template <typename Body>
    void for_files(const Body& body) const {
        if (file_ >= 0) {
            body(static_cast<std::size_t>(file_));
            return;
        }
        for (std::size_t file = 0; file < sections_.files(); ++file) body(file);
    }

    void begin_run(const Vec3& p) {
        const std::int64_t from = has_motion_ ? state_.motion : -1;
        const Section* next = next_after(from);
        if (next == nullptr) next = next_after(-1);  // the program begins again
        has_motion_ = next != nullptr;
        if (next == nullptr) return;
        section_ = *next;
        if (p.allFinite() && allowed_distance(from, section_, p) > tolerance_) search_section(from, p);
        state_ = {section_.first, 0, 0};
        if (p.allFinite() && section_.last > section_.first) state_ = walk_.advance(state_, p, 0, reach());
    }

    void go_on(const Vec3& p, double chord) {
        const WalkState next = walk_.advance(state_, p, chord, reach());
        if (next.distance > settled && next.motion == section_.last) {
            // A kernel that merges lines may report one line for several of its runs.
            const Section* again = next_after(section_.last);
            if (again != nullptr && again->first - state_.motion <= longest_merge) {
                const WalkState beyond = walk_.advance(state_, p, chord, again->last);
                if (beyond.distance < next.distance && beyond.motion > section_.last) {
                    section_.last = again->last;
                    state_ = beyond;
                    return;
                }
            }
        }
        state_ = next;
    }

    /// The last motion of the section within the walk's window.
    [[nodiscard]] std::int64_t reach() const {
        return std::min<std::int64_t>(section_.last,
                                      std::max<std::int64_t>(state_.motion, section_.first) + group_window);
    }

    /// Distance from the motions that the line allows if the walk was on `from` before.
    double allowed_distance(std::int64_t from, const Section& of, const Vec3& p) {
        const MotionRange range = allowed_motions(from, of.first, toolpath_.size());
        const std::int64_t last =
            std::max<std::int64_t>(range.last, std::min<std::int64_t>(of.last, of.first + group_window));
        double best = std::numeric_limits<double>::infinity();
        for (std::int64_t m = range.first; m <= last && !(best <= tolerance_); ++m) {
            best = std::min(best, toolpath_.projection(m, p).distance);
            --budget_;
        }
        return best;
    }

    /// The first run of the line that the point is on, searching ahead and then from the start. If it is on none, or
    /// too many have been searched, the next run in order is kept.
    void search_section(std::int64_t from, const Vec3& p) {
        const Section in_order = section_;
        const Section* candidate = next_after(in_order.first);
        while (candidate != nullptr && budget_ > 0) {
            if (allowed_distance(-1, *candidate, p) <= tolerance_) {
                section_ = *candidate;
                return;
            }
            candidate = next_after(candidate->first);
        }
        for (candidate = next_after(-1); candidate != nullptr && candidate->first <= from && budget_ > 0;
             candidate = next_after(candidate->first)) {
            if (allowed_distance(-1, *candidate, p) <= tolerance_) {
                section_ = *candidate;
                return;
            }
        }
    }

    static constexpr double settled = 0.01;  ///< [mm] a point this near is still on its motion

    const Trajectory& path_;
    Toolpath toolpath_;
    PathWalk walk_;
    LineSections sections_;
    double tolerance_;
    LineNumber line_ = 0;  ///< of the run
    std::int32_t file_ = any_file;
    bool has_motion_ = false;
    Section section_;  ///< of the run
    WalkState state_;
    Vec3 before_ = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
    std::int64_t budget_ = 100'000;
};

/// By program of the log: the program's file of that name.
std::vector<std::int32_t> files_of_programs(const Log& log, const Program& program) {
    std::vector<std::int32_t> files;
    for (const ProgramReference& known : log.programs) {
        const std::string name = plain_program_name(known.name);
        const auto same = std::find_if(program.files.begin(), program.files.end(),
                                       [&](const SourceText& file) { return plain_program_name(file.name()) == name; });
        files.push_back(same == program.files.end() ? MotionTracker::unknown_file
                                                    : static_cast<std::int32_t>(same - program.files.begin()));
    }
    return files;
}

}  // namespace

bool lines_are_ambiguous(const Motions& motions) {
    if (!motions.file.empty()) return true;
    LineNumber most = 0;
    for (const LineNumber line : motions.line) most = std::max(most, line);
    std::vector<bool> seen(std::size_t{most} + 1);
    for (const LineNumber line : motions.line) {
        if (seen[line]) return true;
        seen[line] = true;
    }
    return false;
}

Column<std::uint32_t> track_motions(const Trajectory& path, const Log& log, const Program& program,
                                    const ChannelView& lines, double tolerance) {
    // Points that are read at once; results do not depend on it.
    constexpr std::size_t block = 4096;
    constexpr std::uint32_t none = 0xffffffffu;
    Column<std::uint32_t> motion_of_point(static_cast<std::size_t>(path.count), LineMap::no_motion);
    const Channel* index = log.programs.size() < 2 ? nullptr : log.find("program");
    const std::vector<std::int32_t> file_of = files_of_programs(log, program);
    MotionTracker tracker(path, program, tolerance);
    std::array<LineNumber, block> numbers;
    std::array<std::uint32_t, block> programs;
    std::array<double, block> x, y, z;
    for (PointIndex begin = 0; begin < path.count; begin += static_cast<PointIndex>(block)) {
        const auto n =
            static_cast<std::size_t>(std::min<PointIndex>(static_cast<PointIndex>(block), path.count - begin));
        copy_block(lines, begin, {numbers.data(), n}, 0);
        if (index != nullptr) copy_block(index->values, begin, {programs.data(), n}, none);
        path.read(begin, {x.data(), n}, {y.data(), n}, {z.data(), n});
        for (std::size_t i = 0; i < n; ++i) {
            const std::int32_t file = index == nullptr               ? MotionTracker::any_file
                                      : programs[i] < file_of.size() ? file_of[programs[i]]
                                                                     : MotionTracker::unknown_file;
            const std::int64_t motion = tracker.add(numbers[i], file, {x[i], y[i], z[i]});
            if (motion >= 0) motion_of_point[static_cast<std::size_t>(begin) + i] = static_cast<std::uint32_t>(motion);
        }
    }
    return motion_of_point;
}

}  // namespace clsurf
