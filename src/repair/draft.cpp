#include "repair/draft.h"

#include <stdexcept>

#include <fmt/format.h>

#include "repair/line_edit.h"
#include "repair/points/end_points.h"
#include "repair/points/resample.h"
#include "simulation/path/block_merging.h"

namespace clsurf {

Drafter::Drafter(const Program& program, const ReadProgram& read, const Machine& machine, const OptimizeRules& rules,
                 bool slows_anywhere, const Orientation* orientation)
    : program_(program),
      read_(read),
      machine_(machine),
      rules_(rules),
      slows_anywhere_(slows_anywhere),
      orientation_(orientation),
      programmed_(build_programmed_surface(program)) {}

Draft Drafter::draft(const DraftLines& lines, std::vector<std::uint8_t> needed) const {
    Draft draft;
    draft.lines = lines;
    if (lines.ends.first > 0) mark_pass_ends(program_, programmed_, lines.ends.reach, needed);
    LineEditor editor(program_, rules_.least_decimals);
    const double spacing = 0.5 * fitting_spacing(program_, programmed_, lines.chord_error);
    const std::vector<ResampledSegment> segments = resample(
        program_, programmed_, editor,
        {rules_.tolerance, spacing, lines.chord_error, lines.shortest_line, most_turned, rules_.splines, lines.ends},
        needed, orientation_);
    const bool all_may_slow = slows_anywhere_ && !rules_.splines;
    std::int64_t old = 0;  // motions so far
    const auto keep_slowing = [&](std::int64_t first, std::int64_t end) {
        for (std::int64_t i = first; i < end; ++i) {
            const auto k = static_cast<std::size_t>(i);
            // Splines of the program are not changed.
            const bool is_spline = program_.motions.kind[k] == MotionKind::spline;
            draft.may_slow.push_back(is_spline ? 0 : slows_anywhere_ ? 1 : needed[k]);
        }
    };
    for (const ResampledSegment& segment : segments) {
        const bool is_spline = segment.spline.has_value();
        const std::size_t written = is_spline
                                        ? editor.replace(segment.first, segment.last, *segment.spline)
                                        : editor.replace(segment.first, segment.last, segment.points, segment.angles);
        draft.splines += is_spline ? 1 : 0;
        if (all_may_slow) continue;
        keep_slowing(old, segment.first);
        draft.may_slow.insert(draft.may_slow.end(), written, 1);
        old = segment.last + 1;
    }
    if (!all_may_slow) keep_slowing(old, program_.motions.size());
    draft.text = editor.text(rules_.header);
    draft.program = read_(draft.text);
    const auto motions = static_cast<std::size_t>(draft.program.motions.size());
    if (!draft.may_slow.empty() && draft.may_slow.size() != motions)
        throw std::logic_error(fmt::format("a draft has {} motions, not {}", motions, draft.may_slow.size()));
    draft.merged = merged(draft.program);
    draft.segments = segments.size();
    draft.changed_lines = editor.changed_lines();
    draft.needed = std::move(needed);
    return draft;
}

double Drafter::usual_spacing() const { return clsurf::usual_spacing(program_, programmed_); }

Draft Drafter::unchanged() const {
    Draft draft;
    draft.program = program_;
    draft.text = program_.main().text();
    draft.merged = merged(program_);
    return draft;
}

std::vector<std::uint8_t> Drafter::merged(const Program& program) const {
    if (orientation_ != nullptr) return {};
    return merged_with_next(program, machine_);
}

}  // namespace clsurf
