#include "surface/programmed_surface.h"

#include <algorithm>
#include <cmath>

#include "core/statistics.h"
#include "surface/stitch.h"
#include "toolpath/toolpath.h"

namespace clsurf {
namespace {

constexpr double most_programmed_points = 20e6;  ///< longer programs get wider spacing
constexpr double spacing_of_step_over = 0.5;     ///< largest distance of points, in step-overs
constexpr int most_iterations = 4;

struct Sampled {
    Positions positions;
    std::vector<std::uint32_t> motion;
    std::vector<std::uint8_t> is_end;

    void add(const Vec3& p, std::size_t of, bool end) {
        const Eigen::Vector3f q = (p - positions.origin).cast<float>();
        positions.x.push_back(q.x());
        positions.y.push_back(q.y());
        positions.z.push_back(q.z());
        motion.push_back(static_cast<std::uint32_t>(of));
        is_end.push_back(end ? 1 : 0);
    }
};

/// A NaN start would hide the whole path if the first motions do not set an axis.
Toolpath toolpath_of(const Program& program) { return {program.motions, Vec3::Zero()}; }

double cutting_length(const Toolpath& path) {
    double sum = 0;
    for (std::int64_t i = 0; i < path.size(); ++i) {
        if (is_cut(path.motions().kind[static_cast<std::size_t>(i)])) sum += path.length(i);
    }
    return sum;
}

Sampled sample(const Toolpath& path, double spacing) {
    Sampled sampled;
    const Motions& motions = path.motions();
    if (motions.size() > 0) sampled.positions.origin = path.end(0);
    for (std::int64_t i = 0; i < motions.size(); ++i) {
        const MotionKind kind = motions.kind[static_cast<std::size_t>(i)];
        if (is_cut(kind)) {
            // A line slightly longer than the spacing does not need a point in its middle.
            const auto pieces =
                static_cast<int>(std::clamp(std::floor(path.length(i) / spacing + 0.5), 1.0, most_programmed_points));
            for (int k = 1; k < pieces; ++k)
                sampled.add(path.at(i, static_cast<double>(k) / pieces), static_cast<std::size_t>(i), false);
        }
        sampled.add(path.end(i), static_cast<std::size_t>(i), true);
    }
    return sampled;
}

/// The median length of the cutting motions that move [mm]; 0 if none does.
double usual_length(const Toolpath& path) {
    std::vector<double> lengths;
    for (std::int64_t i = 0; i < path.size(); ++i) {
        if (!is_cut(path.motions().kind[static_cast<std::size_t>(i)])) continue;
        if (const double length = path.length(i); length > 0) lengths.push_back(length);
    }
    return lengths.empty() ? 0 : median(lengths);
}

ProgrammedSurface stitch_sampled(Sampled sampled, const Program& program) {
    ProgrammedSurface programmed;
    programmed.motion = std::move(sampled.motion);
    programmed.is_end = std::move(sampled.is_end);
    programmed.surface = stitch(std::move(sampled.positions), lines_of(programmed, program));
    return programmed;
}

}  // namespace

LineMap lines_of(const ProgrammedSurface& programmed, const Program& program) {
    constexpr std::uint8_t certain = 255;
    Column<std::uint32_t> motion(programmed.motion.size());
    std::copy(programmed.motion.begin(), programmed.motion.end(), motion.begin());
    return {std::move(motion), Column<std::uint8_t>(programmed.motion.size(), certain), program};
}

ProgrammedSurface build_programmed_surface(const Program& program) {
    const Toolpath path = toolpath_of(program);
    const double coarsest = std::max(cutting_length(path) / most_programmed_points, 1e-4);
    double spacing = std::max(coarsest, usual_length(path));
    ProgrammedSurface programmed = stitch_sampled(sample(path, spacing), program);
    // Passes and neighbours need points closer than the passes. Points of long motions are so far apart that the
    // first estimate of the step-over can be too large, so each iteration estimates it again.
    for (int iteration = 0; iteration < most_iterations && programmed.surface.step_over > 0; ++iteration) {
        const double wanted = std::max(coarsest, spacing_of_step_over * programmed.surface.step_over);
        if (wanted >= 0.9 * spacing) break;
        spacing = wanted;
        programmed = stitch_sampled(sample(path, spacing), program);
    }
    return programmed;
}

std::vector<ProgrammedPass> cut_passes(const ProgrammedSurface& programmed) {
    std::vector<ProgrammedPass> passes;
    std::int64_t number = 0;
    for (const Pass& pass : programmed.surface.passes) {
        if (pass.kind != PassKind::cut) continue;
        ProgrammedPass mine{++number, {pass.first, pass.last}, {pass.first}};
        for (PointIndex i = pass.first + 1; i <= pass.last; ++i) {
            if (programmed.ends_motion(i)) mine.ends.push_back(i);
        }
        if (mine.ends.size() > 1) passes.push_back(std::move(mine));
    }
    return passes;
}

}  // namespace clsurf
