#include "path/line_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <fmt/format.h>

#include "core/block.h"
#include "core/statistics.h"
#include "path/alignment.h"
#include "path/allowed_motions.h"
#include "path/program_course.h"
#include "path/program_lines.h"
#include "path/toolpath.h"
#include "path/work_offset.h"

namespace clsurf {
namespace {

constexpr PointIndex checked_stretches = 64;  ///< evenly spaced over the log
constexpr PointIndex checked_stretch = 1600;  ///< points
/// A reported line agrees when the point lies this near to it [mm]: a corner tolerance of finishing
/// (0.01 mm) with room for the two records by which a kernel's line leads its axes.
constexpr double agreeing_distance = 0.05;
constexpr double blending_distance = 1.0;  ///< [mm] G64 without a tolerance
/// More disagreement than this among the checked points is worth a warning.
constexpr double disagreeing_share = 0.005;
/// Where most points are off, a work offset is looked for.
constexpr double offset_share = 0.5;
constexpr double sure_confidence = 0.9;  ///< of an aligned point

PointKind point_kind(MotionKind kind) {
    switch (kind) {
        case MotionKind::rapid: return PointKind::rapid;
        case MotionKind::dwell: return PointKind::idle;
        default: return PointKind::cut;
    }
}

}  // namespace

LineMap::LineMap(const ChannelView& channel, const Program& program, std::shared_ptr<const void> keep_alive)
    : count_(channel.count), channel_(channel), keep_alive_(std::move(keep_alive)) {
    index_lines(program);
}

LineMap::LineMap(Column<std::uint32_t> motion_of_point, Column<std::uint8_t> confidence, const Program& program)
    : count_(static_cast<PointIndex>(motion_of_point.size())),
      motion_of_point_(std::move(motion_of_point)),
      confidence_(std::move(confidence)) {
    index_lines(program);
}

void LineMap::index_lines(const Program& program) {
    const Motions& motions = program.motions;
    const std::size_t lines = std::size_t{program.main().line_count()} + 1;
    kind_of_line_ = Column<PointKind>(lines, PointKind::idle);
    line_of_motion_ = motions.line;
    kind_of_motion_.resize(motions.kind.size());
    first_of_line_ = Column<std::uint32_t>(lines + 1, 0);
    const auto in_main = [&](std::size_t i) {
        return motions.line[i] < lines && (motions.file.empty() || motions.file[i] == 0);
    };
    for (std::size_t i = 0; i < motions.kind.size(); ++i) {
        kind_of_motion_[i] = point_kind(motions.kind[i]);
        if (!in_main(i)) continue;
        const LineNumber line = motions.line[i];
        kind_of_line_[line] = std::max(kind_of_line_[line], kind_of_motion_[i]);
        ++first_of_line_[line + 1];
    }
    mark_calls(motions);
    // Counting sort; a line that runs again (a loop, a subprogram) has several motions.
    for (std::size_t line = 0; line < lines; ++line) first_of_line_[line + 1] += first_of_line_[line];
    by_line_.resize(first_of_line_[lines]);
    Column<std::uint32_t> next = first_of_line_;
    for (std::size_t i = 0; i < motions.kind.size(); ++i) {
        if (in_main(i)) by_line_[next[motions.line[i]]++] = static_cast<std::uint32_t>(i);
    }
}

/// A line that calls a subprogram does what the subprogram does: logs of several programs report it for
/// the time of the call. It stands between the motions of the main file round those of the subprogram.
void LineMap::mark_calls(const Motions& motions) {
    constexpr LineNumber nearest_lines = 100;
    const std::size_t count = motions.file.empty() ? 0 : motions.kind.size();
    for (std::size_t i = 0; i < count;) {
        if (motions.file[i] == 0) {
            ++i;
            continue;
        }
        const LineNumber before = i > 0 ? motions.line[i - 1] : 0;
        PointKind kind = PointKind::idle;
        for (; i < count && motions.file[i] != 0; ++i) kind = std::max(kind, point_kind(motions.kind[i]));
        const LineNumber after = i < count ? motions.line[i] : before + nearest_lines;
        // A jump back or far ahead: the call stands near to where it was made.
        const LineNumber end = after > before ? std::min(after, before + nearest_lines) : before + nearest_lines;
        for (LineNumber line = before + 1; line < end && line < kind_of_line_.size(); ++line) {
            if (first_of_line_[line + 1] == 0) kind_of_line_[line] = std::max(kind_of_line_[line], kind);
        }
    }
}

std::span<const std::uint32_t> LineMap::motions_of(LineNumber line) const {
    if (std::size_t{line} + 1 >= first_of_line_.size()) return {};
    return {by_line_.data() + first_of_line_[line], by_line_.data() + first_of_line_[line + 1]};
}

void LineMap::read(PointIndex begin, std::span<LineNumber> out) const {
    if (from_log()) {
        copy_block(channel_, begin, out, 0);
        return;
    }
    const std::uint32_t* motion = motion_of_point_.data() + begin;
    for (std::size_t i = 0; i < out.size(); ++i) { out[i] = motion[i] == no_motion ? 0 : line_of_motion_[motion[i]]; }
}

void LineMap::read_kinds(PointIndex begin, std::span<PointKind> out) const {
    if (!from_log()) {
        const std::uint32_t* motion = motion_of_point_.data() + begin;
        for (std::size_t i = 0; i < out.size(); ++i) {
            out[i] = motion[i] == no_motion ? PointKind::idle : kind_of_motion_[motion[i]];
        }
        return;
    }
    std::array<LineNumber, 1024> lines;
    for (std::size_t done = 0; done < out.size(); done += lines.size()) {
        const std::size_t n = std::min(lines.size(), out.size() - done);
        copy_block(channel_, begin + static_cast<PointIndex>(done), {lines.data(), n}, 0);
        for (std::size_t i = 0; i < n; ++i) {
            // A line that the program does not have is judged by info; here it cuts, so that it shows.
            out[done + i] = lines[i] == 0                      ? PointKind::idle
                            : lines[i] >= kind_of_line_.size() ? PointKind::cut
                                                               : kind_of_line_[lines[i]];
        }
    }
}

LineNumber LineMap::line_at(PointIndex point) const {
    LineNumber line = 0;
    read(point, {&line, 1});
    return line;
}

std::vector<PointRange> LineMap::points_of(LineNumber line) const {
    std::vector<PointRange> ranges;
    std::array<LineNumber, 4096> lines;
    for (PointIndex begin = 0; begin < count_; begin += static_cast<PointIndex>(lines.size())) {
        const auto n =
            static_cast<std::size_t>(std::min<PointIndex>(static_cast<PointIndex>(lines.size()), count_ - begin));
        read(begin, {lines.data(), n});
        for (std::size_t i = 0; i < n; ++i) {
            if (lines[i] != line) continue;
            const PointIndex point = begin + static_cast<PointIndex>(i);
            if (!ranges.empty() && ranges.back().last == point - 1) {
                ranges.back().last = point;
            } else {
                ranges.push_back({point, point});
            }
        }
    }
    return ranges;
}

double LineMap::confidence_at(PointIndex point) const {
    if (from_log()) return line_at(point) > 0 ? 1.0 : 0.0;
    return confidence_[static_cast<std::size_t>(point)] / 255.0;
}

namespace {

/// How far the tool may leave the programmed path: the largest corner tolerance that the program
/// gives, and where it allows blending without one, what a kernel takes at finishing feeds.
double play_of(const Program& program) {
    double play = agreeing_distance;
    for (const ProgramEvent& event : program.events) {
        if (event.name != "path-mode" || !event.value.starts_with("G64")) continue;
        const std::size_t p = event.value.find(" P");
        play = std::max(play,
                        p == std::string::npos ? blending_distance : std::strtod(event.value.c_str() + p + 2, nullptr));
    }
    return play;
}

/// Distance of a position to the motions that the reported lines allow; NaN: the line has none.
double allowed_distance(const Toolpath& path, const LineMap& map, LineNumber before, LineNumber line,
                        const Vec3& position) {
    double best = std::numeric_limits<double>::quiet_NaN();
    for_allowed_motions(path, map, before, line, [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t m = first; m <= last; ++m) {
            const double distance = path.foot(m, position).distance;
            if (!(best <= distance)) best = distance;
        }
        return best <= agreeing_distance;
    });
    return best;
}

}  // namespace

LineAgreement check_lines(const Trajectory& path, const Program& program, const LineMap& map) {
    LineAgreement agreement;
    agreement.tolerance = play_of(program);
    const Toolpath toolpath(program.motions, path.count > 0 ? path.at(0) : Vec3::Zero());
    const PointIndex stretch = std::min(path.count, checked_stretch);
    const PointIndex stretches = std::min<PointIndex>(checked_stretches, stretch > 0 ? path.count / stretch : 0);
    Column<double> distances;
    std::vector<double> x(static_cast<std::size_t>(stretch)), y(x.size()), z(x.size());
    std::vector<LineNumber> lines(x.size());
    for (PointIndex s = 0; s < stretches; ++s) {
        const PointIndex begin = stretches == 1 ? 0 : (path.count - stretch) / (stretches - 1) * s;
        path.read(begin, x, y, z);
        map.read(begin, lines);
        LineNumber before = 0;
        // The first line of a stretch has no known one before it.
        bool known = begin == 0;
        for (std::size_t i = 1; i < x.size(); ++i) {
            if (lines[i] != lines[i - 1]) {
                before = lines[i - 1];
                known = true;
            }
            const Vec3 p(x[i], y[i], z[i]);
            const bool moved = (p - Vec3(x[i - 1], y[i - 1], z[i - 1])).squaredNorm() > 0;
            if (!moved || !known || lines[i] == 0) continue;
            const double distance = allowed_distance(toolpath, map, before, lines[i], p);
            if (!std::isfinite(distance)) continue;
            distances.push_back(distance);
            if (distance > agreement.tolerance) ++agreement.disagreeing;
            if (distance > agreement.worst_distance) {
                agreement.worst_distance = distance;
                agreement.worst = begin + static_cast<PointIndex>(i);
            }
        }
    }
    agreement.checked = static_cast<PointIndex>(distances.size());
    if (distances.empty()) return agreement;
    agreement.median_distance = quantile_below(distances, 0.5);
    agreement.p95_distance = quantile_below(distances, 0.95);
    return agreement;
}

double check_line_at(const Trajectory& path, const Program& program, const LineMap& map, PointIndex point) {
    const LineNumber line = map.line_at(point);
    PointIndex i = point;
    while (i > 0 && point - i < checked_stretch && map.line_at(i) == line) --i;
    const Toolpath toolpath(program.motions, path.at(0));
    return allowed_distance(toolpath, map, map.line_at(i), line, path.at(point));
}

double off_confidence(double distance) {
    if (!(distance == distance)) return 0.0;
    return distance <= agreeing_distance ? 1.0 : agreeing_distance / distance;
}

namespace {

/// Part of the aligned points that are farther off than a finishing tolerance.
double off_share(const LineMap& map) {
    constexpr PointIndex looked_at = 10'000;
    const PointIndex stride = std::max<PointIndex>(1, map.count() / looked_at);
    PointIndex off = 0;
    PointIndex all = 0;
    for (PointIndex i = 0; i < map.count(); i += stride, ++all) off += map.confidence_at(i) < sure_confidence ? 1 : 0;
    return all > 0 ? static_cast<double>(off) / static_cast<double>(all) : 0.0;
}

/// To a micrometre, as offsets are entered: "12.5", "-3".
std::string decimals(double value) {
    std::string text = fmt::format("{:.3f}", value);
    text.resize(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text == "-0" ? "0" : text;
}

void look_for_work_offset(const Trajectory& path, const Program& program, const LineMap* map,
                          Diagnostics& diagnostics) {
    const std::optional<Vec3> shift = find_shift(path, program, map);
    constexpr double least_shift = 1e-3;  // [mm] displaced by nothing, they are off for another reason
    if (!shift || shift->norm() < least_shift) return;
    const Vec3 offset = -(path.offset + *shift);
    diagnostics.add({Severity::warning, "map.work-offset", Place::of_file(path.name),
                     fmt::format("the positions lie parallel to the programmed path, displaced by X {} Y {} Z {} mm",
                                 decimals(-shift->x()), decimals(-shift->y()), decimals(-shift->z())),
                     fmt::format("--work-offset {},{},{} brings them onto it", decimals(offset.x()),
                                 decimals(offset.y()), decimals(offset.z()))});
}

ChannelView view_of(const Column<LineNumber>& lines) {
    return {reinterpret_cast<const std::byte*>(lines.data()),
            sizeof(LineNumber),
            static_cast<PointIndex>(lines.size()),
            ScalarType::u32,
            false,
            1.0,
            0.0};
}

}  // namespace

LineMap map_lines(const Trajectory& path, const Log& log, const Program& program, bool use_channel,
                  Diagnostics& diagnostics) {
    const Channel* channel = use_channel ? log.find("line") : nullptr;
    ProgramLines own;
    if (channel != nullptr) own = lines_of_program(log, program, diagnostics);
    if (channel == nullptr || !own.known) {
        LineMap map = align_lines(path, program, diagnostics);
        if (off_share(map) > offset_share)
            look_for_work_offset(path, program, nullptr, diagnostics);
        else
            note_course(path, log, program, map, diagnostics);
        return map;
    }
    LineMap map = own.lines ? LineMap(view_of(*own.lines), program, own.lines)
                            : LineMap(channel->values, program, log.keep_alive);
    const LineAgreement agreement = check_lines(path, program, map);
    const auto more_than = [&](double share) {
        return static_cast<double>(agreement.disagreeing) > share * static_cast<double>(agreement.checked);
    };
    if (more_than(disagreeing_share)) {
        diagnostics.add({Severity::warning, "map.disagreement", Place::of_point(log.name, agreement.worst),
                         fmt::format("{} of {} checked points are farther than {} mm from the line that the log "
                                     "gives them: median {:.4f} mm, worst {:.3f} mm",
                                     agreement.disagreeing, agreement.checked, agreement.tolerance,
                                     agreement.median_distance, agreement.worst_distance),
                         "another program, another version of it, or another work offset?"});
    }
    if (more_than(offset_share))
        look_for_work_offset(path, program, &map, diagnostics);
    else
        note_course(path, log, program, map, diagnostics);
    return map;
}

}  // namespace clsurf
