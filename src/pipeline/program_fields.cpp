#include "pipeline/program_fields.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "core/block.h"
#include "core/error.h"
#include "core/not_finite.h"
#include "core/units.h"
#include "mapping/point_motions.h"
#include "numeric/polyline.h"
#include "numeric/resolved_curvature.h"
#include "program/coordinate_step.h"
#include "toolpath/toolpath.h"

namespace clsurf {
namespace {

using PerMotion = Column<float>;

constexpr int in_reports = 200;                          ///< report_rank: after the fields of the machine's motion
constexpr double least_curvature = 1e-4;                 ///< [1/mm] below it a path counts as straight
constexpr double least_corner = 45 * rad_per_deg;        ///< between two lines; a smaller angle counts as curvature
constexpr ValueRange usual_angles{0, 15 * rad_per_deg};  ///< of finishing; turns between passes are greater

Toolpath toolpath_of(const Program& program) { return {program.motions, Vec3::Zero()}; }

bool cuts(const Motions& motions, std::int64_t i) { return is_cut(motions.kind[static_cast<std::size_t>(i)]); }

/// NaN for all motions that do not cut.
template <typename Value>
PerMotion of_cutting_motions(const Program& program, const Value& value) {
    const Motions& motions = program.motions;
    PerMotion values(static_cast<std::size_t>(motions.size()), missing<float>);
    parallel_for(motions.size(), block_points, [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t i = first; i < last; ++i) {
            if (cuts(motions, i)) values[static_cast<std::size_t>(i)] = static_cast<float>(value(i));
        }
    });
    return values;
}

PerMotion feeds(const Program& program) {
    return of_cutting_motions(program, [&](std::int64_t i) {
        const float feed = program.motions.feed[static_cast<std::size_t>(i)];
        return feed > 0 ? feed : missing<float>;
    });
}

PerMotion lengths(const Program& program) {
    const Toolpath path = toolpath_of(program);
    return of_cutting_motions(program, [&](std::int64_t i) { return path.length(i); });
}

/// The next cutting motion with a length, in a direction; −1: a rapid or an end of the program comes first.
std::int64_t adjacent_moving(const Toolpath& path, std::int64_t motion, std::int64_t step) {
    for (std::int64_t i = motion + step; i >= 0 && i < path.size(); i += step) {
        if (path.motions().kind[static_cast<std::size_t>(i)] == MotionKind::rapid) return -1;
        if (path.length(i) > 0) return i;
    }
    return -1;
}

PerMotion turning_angles(const Program& program) {
    const Toolpath path = toolpath_of(program);
    return of_cutting_motions(program, [&](std::int64_t i) {
        if (!(path.length(i) > 0)) return missing<double>;
        double greatest = 0;
        if (const std::int64_t before = adjacent_moving(path, i, -1); before >= 0)
            greatest = angle_between(path.direction(before, 1), path.direction(i, 0));
        if (const std::int64_t after = adjacent_moving(path, i, 1); after >= 0)
            greatest = std::max(greatest, angle_between(path.direction(i, 1), path.direction(after, 0)));
        return greatest;
    });
}

/// Curvature of a run of lines through its corners: by three points if coordinates are exact, else over sections that
/// rounding does not distort.
std::vector<double> curvatures_of_run(const std::vector<Vec3>& corners, double step) {
    if (step > 0) return resolved_curvatures(corners, step, least_curvature);
    std::vector<double> curvature(corners.size(), 0);
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
        curvature[k] = three_point_curvature(corners[k - 1], corners[k], corners[k + 1]);
    return curvature;
}

PerMotion curvatures(const Program& program) {
    const Toolpath path = toolpath_of(program);
    PerMotion values = of_cutting_motions(program, [&](std::int64_t i) { return path.curvature(i); });
    const double step = coordinate_step(program.motions);
    std::vector<Vec3> corners;
    std::vector<std::int64_t> lines;  // lines[k] connects the corners k and k + 1
    const auto close = [&] {
        if (lines.size() > 1) {
            const std::vector<double> curvature = curvatures_of_run(corners, step);
            for (std::size_t k = 0; k < lines.size(); ++k)
                values[static_cast<std::size_t>(lines[k])] =
                    static_cast<float>(std::max(curvature[k], curvature[k + 1]));
        }
        corners.clear();
        lines.clear();
    };
    for (std::int64_t i = 0; i < path.size(); ++i) {
        if (program.motions.kind[static_cast<std::size_t>(i)] != MotionKind::feed) {
            close();
        } else if (path.length(i) > 0) {
            const bool corner =
                !lines.empty() && angle_between(path.direction(lines.back(), 1), path.direction(i, 0)) > least_corner;
            if (corner) close();
            if (lines.empty()) corners.push_back(path.begin(i));
            corners.push_back(path.end(i));
            lines.push_back(i);
        }
    }
    close();
    return values;
}

struct ProgramFieldRow {
    std::string_view name, label;
    Unit unit;
    FieldPreference preference;
    std::string_view note;
    PerMotion (*compute)(const Program& program);
    std::optional<ValueRange> usual_range = {};
};

constexpr auto rows = std::to_array<ProgramFieldRow>({
    {"programmed_feed", "Programmed feed", unit::mm_min, FieldPreference::none, "", feeds},
    {"block_length", "Length of the block", unit::mm, FieldPreference::none, "", lengths},
    {"turning_angle", "Angle between blocks", unit::deg, FieldPreference::lower, "the greater one of both ends",
     turning_angles, usual_angles},
    {"programmed_curvature", "Curvature of the programmed path", unit::per_mm, FieldPreference::lower,
     "corners of more than 45° left out", curvatures},
});

const ProgramFieldRow* find_row(std::string_view name) {
    const auto* const found =
        std::find_if(rows.begin(), rows.end(), [&](const ProgramFieldRow& row) { return row.name == name; });
    return found == rows.end() ? nullptr : found;
}

FieldInfo info_of(const ProgramFieldRow& row) {
    FieldInfo info{std::string(row.name), std::string(row.label), row.unit, FieldScale::sequential, {}};
    info.preference = row.preference;
    info.usual_range = row.usual_range;
    info.report_rank = in_reports;
    return info;
}

}  // namespace

bool ProgramFields::has(std::string_view name) { return find_row(name) != nullptr; }

std::vector<FieldInfo> ProgramFields::fields() const {
    std::vector<FieldInfo> all;
    for (const ProgramFieldRow& row : rows) all.push_back(info_of(row));
    return all;
}

bool ProgramFields::can_compute(std::string_view /*name*/) const { return program_.motions.size() > 0; }

std::vector<Field> ProgramFields::compute(std::span<const std::string_view> names, PointRange points) const {
    std::vector<Field> fields;
    std::vector<PerMotion> values;
    for (const std::string_view name : names) {
        if (!can_compute(name))
            throw UsageError("the field '" + std::string(name) + "' needs the program: PROGRAM LOG");
        const ProgramFieldRow& row = *find_row(name);
        Field field{info_of(row), Column<float>(static_cast<std::size_t>(points.size()), missing<float>)};
        field.info.note = row.note;
        fields.push_back(std::move(field));
        values.push_back(row.compute(program_));
    }
    for_each_motion(*lines_, points, [&](PointIndex point, std::int64_t motion) {
        if (motion < 0) return;
        for (std::size_t k = 0; k < fields.size(); ++k)
            fields[k].values[static_cast<std::size_t>(point - points.first)] =
                values[k][static_cast<std::size_t>(motion)];
    });
    return fields;
}

}  // namespace clsurf
