#include "mapping/line_edits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <span>

#include <fmt/format.h>

#include "mapping/allowed_motions.h"
#include "toolpath/toolpath.h"

namespace clsurf {
namespace {

constexpr PointIndex sampled_sections = 64;  ///< evenly spaced over the log
constexpr PointIndex sampled_points = 1600;  ///< points
constexpr std::size_t least_run = 5;         ///< moving points of a line whose middle tells it from the next one
constexpr double steps_off = 1.5;            ///< chords that a point may lie off its line
constexpr double least_confidence = 0.5;     ///< of an aligned point that tells where a line is
constexpr PointIndex longest_lead = 4;       ///< records by which a reported line may lead the axes
constexpr std::size_t lines_together = 9;    ///< lines that together tell a shift
constexpr double together_share = 2.0 / 3;   ///< of them
constexpr LineNumber soon_undone = 40;       ///< lines
constexpr double explained_share = 0.8;      ///< of all lines, or no edit explains them
constexpr std::size_t most_shifts = 1000;    ///< and of lines, one in ten at most

/// Where each line of the old text stands now.
struct Vote {
    std::int64_t shift = 0;
    std::int32_t weight = 0;  ///< majority vote (Boyer and Moore)

    void add(std::int64_t given) {
        if (weight == 0) shift = given;
        weight += given == shift ? 1 : -1;
    }
};

struct LineVote {
    LineNumber line = 0;
    std::int64_t shift = 0;
};

class EditFinder {
public:
    EditFinder(const Trajectory& path, const Program& program, const ChannelView& lines, const LineMap& aligned)
        : path_(path), program_(program), lines_(lines), aligned_(aligned) {}

    std::optional<LineEdits> find() {
        lead_ = find_lead();
        take_votes();
        if (votes_.empty() || !segment(votes_)) return std::nullopt;
        for (std::size_t k = 0; k < gaps_.size(); ++k) narrow(k);
        correct();
        return std::move(edits_);
    }

private:
    /// body(point, reported, aligned `lead` records later) for the points that move and have both.
    template <typename Body>
    void for_pairs(PointIndex lead, const Body& body) const {
        constexpr PointIndex block = 4096;
        std::vector<LineNumber> reported(static_cast<std::size_t>(block));
        std::vector<LineNumber> found(static_cast<std::size_t>(block + longest_lead));
        std::vector<double> x(found.size()), y(found.size()), z(found.size());
        for (PointIndex begin = 0; begin < path_.count; begin += block) {
            const auto n = static_cast<std::size_t>(std::min(block, path_.count - begin));
            const auto m = static_cast<std::size_t>(std::min(block + lead + 1, path_.count - begin));
            copy_block(lines_, begin, {reported.data(), n}, 0);
            read_aligned(begin, {found.data(), std::min(m, found.size())});
            path_.read(begin, {x.data(), n}, {y.data(), n}, {z.data(), n});
            for (std::size_t i = 1; i < n && i + static_cast<std::size_t>(lead) < m; ++i) {
                const LineNumber at = found[i + static_cast<std::size_t>(lead)];
                const bool moves = x[i] != x[i - 1] || y[i] != y[i - 1] || z[i] != z[i - 1];
                if (moves && reported[i] != 0 && at != 0) body(reported[i], at);
            }
        }
    }

    /// The aligned lines; 0 where the tool is off the program's path, and where a subprogram's own file runs and the
    /// log counts its lines.
    void read_aligned(PointIndex begin, std::span<LineNumber> out) const {
        aligned_.read(begin, out);
        for (std::size_t i = 0; i < out.size(); ++i) {
            if (aligned_.confidence_at(begin + static_cast<PointIndex>(i)) < least_confidence) out[i] = 0;
        }
        if (program_.motions.file.empty()) return;
        for (std::size_t i = 0; i < out.size(); ++i) {
            const std::int64_t motion = aligned_.motion_at(begin + static_cast<PointIndex>(i));
            if (motion >= 0 && program_.motions.file[static_cast<std::size_t>(motion)] != 0) out[i] = 0;
        }
    }

    /// Both change their line at the same record where the lead is right.
    [[nodiscard]] PointIndex find_lead() const {
        PointIndex best = 0;
        std::int64_t least = -1;
        for (PointIndex lead = 0; lead <= longest_lead; ++lead) {
            std::int64_t changes = 0;
            std::int64_t before = 0;
            for_pairs(lead, [&](LineNumber reported, LineNumber at) {
                const std::int64_t shift = std::int64_t{at} - reported;
                changes += shift != before ? 1 : 0;
                before = shift;
            });
            if (least >= 0 && changes >= least) continue;
            least = changes;
            best = lead;
        }
        return best;
    }

    /// How the lines of runs of points are displaced. Within a run of a few points only, the lead decides, and
    /// that changes with the speed: such runs are kept apart.
    void take_votes() {
        std::vector<Vote> by_long, by_short;
        LineNumber line = 0;
        Vote run;
        std::size_t points = 0;
        const auto close = [&] {
            constexpr LineNumber most_lines = 100'000'000;
            if (points == 0 || line > most_lines) return;
            std::vector<Vote>& of_line = points >= least_run ? by_long : by_short;
            if (line >= of_line.size()) of_line.resize(std::size_t{line} + 1);
            of_line[line].add(run.shift);
        };
        for_pairs(lead_, [&](LineNumber reported, LineNumber at) {
            if (reported != line) {
                close();
                line = reported;
                run = {};
                points = 0;
            }
            run.add(std::int64_t{at} - reported);
            ++points;
        });
        close();
        votes_ = votes_of(by_long);
        weak_votes_ = votes_of(by_short);
        if (votes_.size() < 2 * lines_together) {
            votes_.insert(votes_.end(), weak_votes_.begin(), weak_votes_.end());
            std::stable_sort(votes_.begin(), votes_.end(),
                             [](const LineVote& x, const LineVote& y) { return x.line < y.line; });
        }
    }

    static std::vector<LineVote> votes_of(const std::vector<Vote>& of_line) {
        std::vector<LineVote> votes;
        for (std::size_t line = 0; line < of_line.size(); ++line) {
            if (of_line[line].weight > 0) votes.push_back({static_cast<LineNumber>(line), of_line[line].shift});
        }
        return votes;
    }

    /// The shift that most of the votes from `at` on agree on; nullopt: they do not.
    static std::optional<std::int64_t> common_shift(std::span<const LineVote> votes, std::size_t at) {
        const std::span<const LineVote> some = votes.subspan(at, std::min(lines_together, votes.size() - at));
        Vote most;
        for (const LineVote& vote : some) most.add(vote.shift);
        const auto agreeing =
            std::count_if(some.begin(), some.end(), [&](const LineVote& v) { return v.shift == most.shift; });
        if (static_cast<double>(agreeing) < together_share * static_cast<double>(some.size())) return std::nullopt;
        return most.shift;
    }

    /// Lines cut into sections of one shift each.
    bool segment(std::span<const LineVote> votes) {
        std::int64_t shift = 0;
        std::size_t agreeing = 0;
        LineNumber last = 0;  // that agreed
        bool first = true;
        for (std::size_t i = 0; i < votes.size(); ++i) {
            if (votes[i].shift != shift || first) {
                const std::optional<std::int64_t> common = common_shift(votes, i);
                if (common && *common == votes[i].shift && (*common != shift || first)) {
                    if (*common != shift) {
                        edits_.shifts.push_back({votes[i].line, *common - shift});
                        gaps_.push_back({last + 1, votes[i].line - 1});
                    }
                    shift = *common;
                    first = false;
                }
            }
            if (votes[i].shift != shift) continue;
            ++agreeing;
            last = votes[i].line;
        }
        drop_undone();
        return static_cast<double>(agreeing) >= explained_share * static_cast<double>(votes.size()) &&
               edits_.shifts.size() <= std::min(most_shifts, votes.size() / 10 + 1);
    }

    /// One line more and soon one less is what a lead looks like that differs for some lines.
    void drop_undone() {
        for (std::size_t k = 1; k < edits_.shifts.size();) {
            const LineShift& first = edits_.shifts[k - 1];
            const LineShift& second = edits_.shifts[k];
            if (first.by + second.by != 0 || std::abs(first.by) != 1 || second.before - first.before > soon_undone) {
                ++k;
                continue;
            }
            const auto at = static_cast<std::ptrdiff_t>(k) - 1;
            edits_.shifts.erase(edits_.shifts.begin() + at, edits_.shifts.begin() + at + 2);
            gaps_.erase(gaps_.begin() + at, gaps_.begin() + at + 2);
            k = std::max<std::size_t>(1, k - 1);
        }
    }

    /// Where in the gap before a shift it is, by the short runs there: their shifts are off by the same lead.
    void narrow(std::size_t k) {
        const auto less = [](const LineVote& v, LineNumber line) { return v.line < line; };
        const auto first = std::lower_bound(weak_votes_.begin(), weak_votes_.end(), gaps_[k].first, less);
        const auto last = std::lower_bound(first, weak_votes_.end(), gaps_[k].last + 1, less);
        if (first == last) return;
        std::int64_t before = 0;
        for (std::size_t j = 0; j < k; ++j) before += edits_.shifts[j].by;
        const std::int64_t after = before + edits_.shifts[k].by;
        std::int64_t best = -1;
        auto best_at = last;
        for (std::int64_t bias = -1; bias <= 1; ++bias) {
            // Votes for the shift before up to a place, and for the one after from there on.
            std::int64_t agreeing =
                std::count_if(first, last, [&](const LineVote& v) { return v.shift == after + bias; });
            for (auto at = first;; ++at) {
                // Deleted lines lie before the shift.
                const bool room = at == last || edits_.shifts[k].by > 0 ||
                                  std::int64_t{at->line} + edits_.shifts[k].by >= std::int64_t{gaps_[k].first};
                if (room && agreeing > best) {
                    best = agreeing;
                    best_at = at;
                }
                if (at == last) break;
                agreeing += (at->shift == before + bias ? 1 : 0) - (at->shift == after + bias ? 1 : 0);
            }
        }
        if (best_at != last) edits_.shifts[k].before = best_at->line;
        if (best_at != first && edits_.shifts[k].by > 0) gaps_[k].first = std::prev(best_at)->line + 1;
        gaps_[k].last = edits_.shifts[k].before - 1;
    }

    /// Lines of the points in the new text. A line between two shifts that no motion tells of may be one that was
    /// deleted: what geometry finds is taken.
    void correct() {
        edits_.lines.resize(static_cast<std::size_t>(path_.count));
        copy_block(lines_, 0, {edits_.lines.data(), edits_.lines.size()}, 0);
        std::vector<std::int64_t> total;
        for (const LineShift& s : edits_.shifts) total.push_back((total.empty() ? 0 : total.back()) + s.by);
        const auto after = [&](LineNumber line) {
            return std::upper_bound(edits_.shifts.begin(), edits_.shifts.end(), line,
                                    [](LineNumber l, const LineShift& s) { return l < s.before; }) -
                   edits_.shifts.begin();
        };
        for (std::size_t i = 0; i < edits_.lines.size(); ++i) {
            LineNumber& line = edits_.lines[i];
            const auto point = static_cast<PointIndex>(i);
            if (line == 0 || in_other_file(point)) continue;
            const std::ptrdiff_t k = after(line);
            const auto next = static_cast<std::size_t>(k);
            const bool in_gap = next < gaps_.size() && line >= gaps_[next].first && line <= gaps_[next].last;
            if (in_gap) {
                line = aligned_.line_at(std::min(point + lead_, path_.count - 1));
            } else if (k > 0) {
                line = static_cast<LineNumber>(std::max<std::int64_t>(0, line + total[next - 1]));
            }
        }
    }

    [[nodiscard]] bool in_other_file(PointIndex point) const {
        if (program_.motions.file.empty()) return false;
        const std::int64_t motion = aligned_.motion_at(point);
        return motion >= 0 && program_.motions.file[static_cast<std::size_t>(motion)] != 0;
    }

    struct Gap {
        LineNumber first = 0, last = 0;
    };

    const Trajectory& path_;
    const Program& program_;
    const ChannelView& lines_;
    const LineMap& aligned_;
    PointIndex lead_ = 0;
    std::vector<LineVote> votes_, weak_votes_;  ///< by line
    LineEdits edits_;
    std::vector<Gap> gaps_;  ///< in front of each shift: lines that no motion tells of
};

/// Looks at the middle of each run of points with one line.
class MiddleCheck {
public:
    MiddleCheck(const Toolpath& path, const LineMap& map, double tolerance)
        : path_(path), map_(map), tolerance_(tolerance) {}

    void look_at(PointIndex begin, std::span<const LineNumber> lines, std::span<const double> x,
                 std::span<const double> y, std::span<const double> z) {
        // The first run and the last one are cut off by the section.
        std::size_t first = 0;
        bool whole = false;
        std::int64_t before = -1;
        for (std::size_t i = 1; i < lines.size(); ++i) {
            if (lines[i] == lines[i - 1]) continue;
            if (whole && i - first >= least_run && lines[first] != 0) {
                const std::size_t k = first + (i - first) / 2;
                const Vec3 p(x[k], y[k], z[k]);
                const double chord = (p - Vec3(x[k - 1], y[k - 1], z[k - 1])).norm();
                judge(map_.motion_at(begin + static_cast<PointIndex>(k)), before, p, chord);
            }
            before = map_.motion_at(begin + static_cast<PointIndex>(i) - 1);
            first = i;
            whole = true;
        }
    }

    [[nodiscard]] double share() const { return all_ > 0 ? static_cast<double>(off_) / static_cast<double>(all_) : 0; }

private:
    void judge(std::int64_t motion, std::int64_t before, const Vec3& p, double chord) {
        if (motion < 0 || !(chord > 0)) return;
        // What was merged into the line counts as the line.
        const bool merged = before >= 0 && before < motion && motion - before <= longest_merge;
        double nearest = path_.projection(motion, p).distance;
        for (std::int64_t m = merged ? before + 1 : motion; m < motion; ++m)
            nearest = std::min(nearest, path_.projection(m, p).distance);
        ++all_;
        off_ += nearest > std::max(tolerance_, steps_off * chord) ? 1 : 0;
    }

    const Toolpath& path_;
    const LineMap& map_;
    double tolerance_;
    std::int64_t all_ = 0, off_ = 0;
};

}  // namespace

double displaced_share(const Trajectory& path, const Program& program, const LineMap& map) {
    const Toolpath toolpath(program.motions, path.count > 0 ? path.at(0) : Vec3::Zero());
    const PointIndex n = std::min(path.count, sampled_points);
    const PointIndex count = n > 0 ? std::min(sampled_sections, path.count / n) : 0;
    std::vector<double> x(static_cast<std::size_t>(n)), y(x.size()), z(x.size());
    std::vector<LineNumber> lines(x.size());
    MiddleCheck check(toolpath, map, corner_tolerance(program));
    for (PointIndex s = 0; s < count; ++s) {
        const PointIndex begin = count == 1 ? 0 : (path.count - n) / (count - 1) * s;
        path.read(begin, x, y, z);
        map.read(begin, lines);
        check.look_at(begin, lines, x, y, z);
    }
    return check.share();
}

std::optional<LineEdits> find_line_edits(const Trajectory& path, const Program& program, const ChannelView& lines,
                                         const LineMap& aligned) {
    return EditFinder(path, program, lines, aligned).find();
}

std::string LineEdits::text() const {
    constexpr std::size_t shown = 3;
    std::string text;
    for (std::size_t i = 0; i < std::min(shown, shifts.size()); ++i) {
        const std::int64_t n = std::abs(shifts[i].by);
        text += fmt::format("{}{} line{} {} before line {}", i > 0 ? ", " : "", n, n == 1 ? "" : "s",
                            shifts[i].by > 0 ? "inserted" : "deleted", shifts[i].before);
    }
    if (shifts.size() > shown) text += fmt::format(" and {} more changes", shifts.size() - shown);
    return text;
}

}  // namespace clsurf
