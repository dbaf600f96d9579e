#include "mapping/map_lines.h"

#include <memory>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "core/block.h"
#include "core/counted.h"
#include "mapping/alignment.h"
#include "mapping/allowed_motions.h"
#include "mapping/feed_edits.h"
#include "mapping/line_agreement.h"
#include "mapping/line_edits.h"
#include "mapping/log_unit.h"
#include "mapping/motion_track.h"
#include "mapping/program_course.h"
#include "mapping/program_lines.h"
#include "mapping/program_runs.h"
#include "mapping/unknown_lines.h"
#include "mapping/work_offset.h"

namespace clsurf {
namespace {

/// A larger share of disagreement among the checked points causes a warning.
constexpr double disagreeing_share = 0.005;
/// If a larger share of points is off, a work offset is searched for.
constexpr double offset_share = 0.5;
constexpr PointIndex least_checked = 10;  ///< points that suffice to recognise a foreign log
/// The limit instead of offset_share for a log of another program, according to its hash.
constexpr double other_share = 0.05;
/// Share of runs of points whose middle is off its line, and of points on unknown lines, from which an edit may have
/// shifted lines.
constexpr double displaced = 0.02;
/// Edits are accepted if the share of displaced points falls at least by this factor.
constexpr double unexplained_share = 0.5;
/// A share at which the lines are meaningless unless an edit explains them.
constexpr double all_displaced = 0.3;
/// A path fits, although its line numbers do not, if no larger share of points is off.
constexpr double fitting_share = 0.1;
constexpr double sure_confidence = 0.9;  ///< confidence of an aligned point

/// Share of the aligned points that are farther off than a finishing tolerance.
double off_share(const LineMap& map) {
    constexpr PointIndex examined = 10'000;
    const PointIndex stride = std::max<PointIndex>(1, map.count() / examined);
    PointIndex off = 0;
    PointIndex all = 0;
    for (PointIndex i = 0; i < map.count(); i += stride, ++all) off += map.confidence_at(i) < sure_confidence ? 1 : 0;
    return all > 0 ? static_cast<double>(off) / static_cast<double>(all) : 0.0;
}

/// Combines the lines of a log and a program.
class LineMapper {
public:
    LineMapper(const Trajectory& path, const Log& log, const Program& program, ProgramIdentity identity,
               Diagnostics& diagnostics)
        : path_(path), log_(log), program_(program), identity_(identity), diagnostics_(diagnostics) {
        match_.edited = identity == ProgramIdentity::edited || identity == ProgramIdentity::other;
    }

    LineMap by_geometry() {
        LineMap map = align_lines(path_, program_, diagnostics_);
        find_runs(map);
        const double off = off_share(map);
        match_.off = off;
        const bool explained =
            off > offset_share && !find_other_unit() && note_pose(path_, program_, nullptr, diagnostics_);
        if (identity_ != ProgramIdentity::same && !explained && off > foreign_share() && match_.foreign.empty())
            match_.foreign = fmt::format("{:.0f} % of its points lie off the programmed path", 100 * off);
        if (off <= offset_share) match_.missing = note_course(path_, log_, program_, map, runs_, diagnostics_);
        return finish(std::move(map));
    }

    LineMap by_channel(const Channel& channel, const ProgramLines& own) {
        LineMap map = own.lines ? reported(channel.values, view_of(*own.lines), own.lines)
                                : reported(channel.values, channel.values, log_.keep_alive);
        const double off_line = identity_ == ProgramIdentity::same ? 0.0 : off_line_share(map);
        if (match_.edited || off_line > displaced) {
            if (std::optional<LineMap> moved = look_for_edits(channel, own, map, off_line)) {
                map = std::move(*moved);
            } else if (!lines_valid_ && off_line > all_displaced) {
                if (std::optional<LineMap> found = fitting_geometry()) return finish(std::move(*found));
            }
        }
        find_runs(map);
        const LineAgreement agreement = check_lines(path_, program_, map);
        if (share_of(agreement) > disagreeing_share) note_disagreement(agreement);
        if (agreement.checked >= least_checked) match_.off = share_of(agreement);
        const bool explained =
            share_of(agreement) > offset_share && !find_other_unit() && note_pose(path_, program_, &map, diagnostics_);
        if (identity_ != ProgramIdentity::same && !explained && agreement.checked >= least_checked &&
            share_of(agreement) > foreign_share() && match_.foreign.empty()) {
            match_.foreign = fmt::format("{:.0f} % of {} checked points lie farther than {} mm from their lines",
                                         100 * share_of(agreement), agreement.checked, agreement.tolerance);
        }
        judge_unknown_lines(map);
        if (share_of(agreement) <= offset_share)
            match_.missing = note_course(path_, log_, program_, map, runs_, diagnostics_);
        return finish(std::move(map));
    }

private:
    static double share_of(const LineAgreement& a) {
        return a.checked > 0 ? static_cast<double>(a.disagreeing) / static_cast<double>(a.checked) : 0.0;
    }

    /// If a larger share of points is off the program's path, or on lines that it does not have, the log belongs to
    /// another program.
    [[nodiscard]] double foreign_share() const {
        return identity_ == ProgramIdentity::other ? other_share : offset_share;
    }

    /// Share of points whose line does not match their position: it is elsewhere, or the program does not have it.
    [[nodiscard]] double off_line_share(const LineMap& map) const {
        return displaced_share(path_, program_, map) + find_unknown_lines(path_, program_, map).share();
    }

    /// The program's runs in this log, and the returns of the tool between them.
    void find_runs(LineMap& map) {
        runs_ = find_program_runs(map);
        map.set_returns(find_returns(path_, program_, map, runs_));
    }

    /// Whether the positions would fit in another unit: then no work offset aligns them.
    bool find_other_unit() {
        const std::optional<LogUnit> unit = other_unit(path_, program_);
        if (!unit) return false;
        match_.foreign = unit->evidence;
        match_.foreign_hint =
            fmt::format("name the unit in the header of the log, as in \"x [{}]\", or with --mapping", unit->name);
        return true;
    }

    LineMap finish(LineMap map) {
        if (match_.edited && match_.foreign.empty())
            note_changed_feeds(path_, log_.period, program_, map, diagnostics_);
        map.set_match(std::move(match_));
        return map;
    }

    /// `numbers`: of the active file; `lines`: of the main program.
    LineMap reported(const ChannelView& numbers, const ChannelView& lines, std::shared_ptr<const void> keep_alive) {
        Column<std::uint32_t> motions;
        if (lines_are_ambiguous(program_.motions))
            motions = track_motions(path_, log_, program_, numbers, corner_tolerance(program_));
        return {lines, program_, std::move(keep_alive), std::move(motions)};
    }

    /// Whether shifted lines fit the path much better than those `before`, with a share `off_line` of points off their
    /// lines. Adjacent short lines may look displaced without any edit; an edit near the end displaces few.
    [[nodiscard]] bool explains(const LineMap& moved, const LineMap& before, double off_line) const {
        if (off_line_share(moved) <= unexplained_share * off_line) return true;
        const double disagreed = share_of(check_lines(path_, program_, before));
        return disagreed > disagreeing_share &&
               share_of(check_lines(path_, program_, moved)) <= unexplained_share * disagreed;
    }

    /// The log's lines, converted to the text that was edited after the run. `reported_lines`: as in the log.
    std::optional<LineMap> look_for_edits(const Channel& channel, const ProgramLines& own,
                                          const LineMap& reported_lines, double off_line) {
        Diagnostics of_alignment;
        const LineMap aligned = align_lines(path_, program_, of_alignment);
        if (off_share(aligned) > offset_share) return std::nullopt;
        const ChannelView lines = own.lines ? view_of(*own.lines) : channel.values;
        std::optional<LineEdits> edits = find_line_edits(path_, program_, lines, aligned);
        if (!edits) return std::nullopt;
        if (edits->shifts.empty()) {
            lines_valid_ = true;
            if (match_.edited)
                diagnostics_.add({Severity::note,
                                  "map.edited",
                                  Place::of_file(program_.main().name()),
                                  "the edit moved no line: the log's line numbers are valid",
                                  {}});
            return std::nullopt;
        }
        const std::string text = edits->text();
        LineMap map = moved_lines(channel, own, std::move(edits->lines));
        if (!match_.edited && !explains(map, reported_lines, off_line)) return std::nullopt;
        match_.edited = true;
        diagnostics_.add({Severity::warning,
                          "map.edited",
                          Place::of_file(program_.main().name()),
                          fmt::format("{} since the run; the log's line numbers were adjusted", text),
                          {}});
        return map;
    }

    /// The map of converted lines. Numbers of the main program are converted, those of other files are not.
    LineMap moved_lines(const Channel& channel, const ProgramLines& own, Column<LineNumber> lines) {
        auto moved = std::make_shared<const Column<LineNumber>>(std::move(lines));
        if (!own.lines) return reported(view_of(*moved), view_of(*moved), moved);
        Column<LineNumber> numbers(moved->size());
        copy_block(channel.values, 0, {numbers.data(), numbers.size()}, 0);
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            if (numbers[i] == (*own.lines)[i]) numbers[i] = (*moved)[i];
        }
        return reported(view_of(numbers), view_of(*moved), moved);
    }

    /// If the log's numbers are meaningless in this program (block numbers, other lines), but its path fits.
    std::optional<LineMap> fitting_geometry() {
        Diagnostics of_alignment;
        LineMap map = align_lines(path_, program_, of_alignment);
        if (off_share(map) > fitting_share) return std::nullopt;
        diagnostics_.add({Severity::warning,
                          "map.line-numbers",
                          Place::of_file(log_.name),
                          "the log's line numbers do not fit the program, its path does: lines are found by geometry",
                          {}});
        match_.edited = true;
        find_runs(map);
        match_.missing = note_course(path_, log_, program_, map, runs_, diagnostics_);
        return map;
    }

    /// There is no geometry to compare for a line that the program does not have: the share of such points alone
    /// identifies a foreign log.
    void judge_unknown_lines(const LineMap& map) {
        const UnknownLines lines = find_unknown_lines(path_, program_, map);
        if (lines.share() <= disagreeing_share) return;
        const std::string text = fmt::format("{} of {} have line numbers that the program of {} does not have: {} … {}",
                                             lines.unknown, counted(lines.moving, "moving point"),
                                             counted(program_.main().line_count(), "line"), lines.low, lines.high);
        if (identity_ != ProgramIdentity::same && lines.unknown >= least_checked && lines.share() > foreign_share()) {
            if (!match_.foreign.empty()) return;
            match_.foreign = text;
            match_.foreign_hint = "the program was cut off, or it is another one; --force continues anyway";
        } else if (diagnostics_.count("log.line-range") == 0) {  // else info has reported it
            diagnostics_.add({Severity::warning, "map.line-range", Place::of_point(log_.name, lines.first), text,
                              "another program, or another version of it?"});
        }
    }

    void note_disagreement(const LineAgreement& agreement) {
        diagnostics_.add({Severity::warning, "map.disagreement", Place::of_point(log_.name, agreement.worst),
                          fmt::format("{} of {} checked points are farther than {} mm from the line that the log "
                                      "gives them: median {:.4f} mm, worst {:.3f} mm",
                                      agreement.disagreeing, agreement.checked, agreement.tolerance,
                                      agreement.median_distance, agreement.worst_distance),
                          "another program, another version of it, or another work offset?"});
    }

    const Trajectory& path_;
    const Log& log_;
    const Program& program_;
    ProgramIdentity identity_;
    Diagnostics& diagnostics_;
    ProgramMatch match_;
    bool lines_valid_ = false;  ///< no edit shifted a line: points off their line are due to the lead
    std::vector<ProgramRun> runs_;
};

}  // namespace

LineMap map_lines(const Trajectory& path, const Log& log, const Program& program, bool use_channel,
                  Diagnostics& diagnostics, ProgramIdentity identity) {
    LineMapper mapper(path, log, program, identity, diagnostics);
    const Channel* channel = use_channel ? log.find("line") : nullptr;
    if (channel == nullptr) return mapper.by_geometry();
    const ProgramLines own = lines_of_program(log, program, diagnostics);
    return own.known ? mapper.by_channel(*channel, own) : mapper.by_geometry();
}

}  // namespace clsurf
