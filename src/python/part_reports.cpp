// The reports of a part: those of `check` and `query`.

#include <cmath>

#include <fmt/format.h>

#include "core/error.h"
#include "core/file_name.h"
#include "io/reports/json_text.h"
#include "io/reports/quality_report.h"
#include "pipeline/feed_fields.h"
#include "pipeline/judge.h"
#include "pipeline/limits_of.h"
#include "python/loaded_part.h"
#include "viz/field_colours.h"

namespace clsurf::python {
namespace {

/// The file that a query names, with or without its folder.
std::size_t file_called(const std::string& name, const Program& program) {
    if (name.empty()) return 0;
    std::string known;
    for (std::size_t i = 0; i < program.files.size(); ++i) {
        const std::string& path = program.files[i].name();
        if (path == name || file_name(path) == name) return i;
        known += (i == 0 ? "" : ", ") + file_name(path);
    }
    throw UsageError(fmt::format("the program has no file '{}'", name), "it has " + known);
}

void require_point(const Log& log, PointIndex point, const std::string& what) {
    if (point >= 0 && point < log.records) return;
    throw UsageError(fmt::format("{}: the log has points 0 … {}, from 0 to {:.6f} s", what, log.records - 1,
                                 log.time_of(log.records - 1)));
}

void add_nearest(const PointQuery& query, const WantedPlace& wanted, std::vector<QueryMatch>& matches,
                 Diagnostics& diagnostics) {
    const std::vector<FoundPlace> found = query.find_nearest(wanted);
    const bool off = !found.empty() && query.is_off_the_part(found.front().distance);
    if (wanted.from_above && (found.empty() || off))
        throw UsageError("nothing was cut there", "with a Z the nearest pass is found all the same");
    if (off)
        diagnostics.add(
            {Severity::warning,
             "query.off-the-part",
             Place::of_file(query.part().log.name),
             fmt::format("the place is not on the part: the nearest {} is {:.3f} mm away",
                         found.front().place.contact ? "contact point" : "tool tip", found.front().distance),
             {}});
    for (const FoundPlace& place : found) {
        matches.push_back(query.match(place.point));
        matches.back().distance = place.distance;
        if (place.place.contact) matches.back().place = place.place;
    }
}

}  // namespace

std::string LoadedPart::judged(Part part, std::optional<Role> measured) const {
    const ClSurface surface = stitch(part);
    const Quality quality = judge(part, surface, measured, {}, {}, true);
    part.diagnostics.append(quality.diagnostics);
    LimitReport limits;
    if (!part.limits.empty()) {
        limits = judge_limits(part, part.limits);
        part.diagnostics.append(limits.diagnostics);
    }
    io::ReportedQuality reported;
    reported.report = &quality.report;
    reported.program = &part.program;
    reported.log = part.log.name;
    reported.tool = part.tool;
    reported.scallop = quality.scallop;
    for (const SpeedShares& shares : speed_shares(quality.report, part))
        reported.colour_differences.push_back(
            viz::colour_difference_of(feed_share_info(), shares.at_defect, shares.adjacent));
    reported.as_machined = quality.as_machined ? &*quality.as_machined : nullptr;
    reported.motion = quality.motion;
    if (part.machine) reported.limits = &limits;
    reported.origin = io::simulation_origin(part.log);
    reported.diagnostics = &part.diagnostics;
    return io::quality_json(reported);
}

const std::string& LoadedPart::check() const {
    const std::scoped_lock lock(busy_);
    if (check_) return *check_;
    if (!request_ || !request_->rules.role) {
        check_ = judged(part_, std::nullopt);
    } else {
        // Passes are compared where they were commanded; the wanted positions are those that heights are measured from.
        PartRequest commanded = *request_;
        commanded.rules.role.reset();
        check_ = judged(io::read_part(commanded.files, commanded.rules), request_->rules.role);
    }
    return *check_;
}

std::string LoadedPart::query(const Wanted& wanted) const {
    const PointQuery* query = nullptr;
    {
        const std::scoped_lock lock(busy_);
        std::unique_ptr<const PointQuery>& kept = wanted.at ? nearest_ : plain_;
        if (!kept) kept = std::make_unique<const PointQuery>(part_, wanted.at.has_value());
        query = kept.get();
    }
    std::vector<QueryMatch> matches;
    Diagnostics diagnostics = part_.diagnostics;
    if (wanted.point) {
        require_point(part_.log, *wanted.point, fmt::format("point {}", *wanted.point));
        matches.push_back(query->match(*wanted.point));
    }
    if (wanted.at) add_nearest(*query, *wanted.at, matches, diagnostics);
    if (wanted.time) {
        const PointIndex point = std::isfinite(*wanted.time) ? point_at_time(part_.log, *wanted.time) : -1;
        require_point(part_.log, point, fmt::format("time {:g}", *wanted.time));
        matches.push_back(query->match(point));
    }
    if (wanted.line) {
        const std::size_t file = file_called(wanted.file, part_.program);
        const LineNumber last = part_.program.files[file].line_count();
        if (*wanted.line < 1 || *wanted.line > last)
            throw UsageError(fmt::format("line {}: the file has lines 1 … {}", *wanted.line, last));
        for (const PointRange& range : query->points_of_line(file, *wanted.line))
            matches.push_back(query->match(range.first));
    }
    return io::query_json(matches, diagnostics);
}

}  // namespace clsurf::python
