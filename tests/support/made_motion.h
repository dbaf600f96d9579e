#pragma once
// Programs from text, run on a machine; and the distance between run and program.

#include <algorithm>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/files/compressed.h"
#include "io/readers/program_file.h"
#include "simulation/path/path_element.h"
#include "simulation/run/simulator.h"

namespace clsurf {

struct Recorded {
    std::vector<SimulatedPoint> points;
    SimulationSummary summary;
};

inline Program program_of(const std::string& text, const std::string& dialect = "linuxcnc") {
    auto kept = std::make_shared<const std::string>(text);
    io::Source source{"made.ngc", std::as_bytes(std::span(kept->data(), kept->size())), kept};
    return io::read_program(source, {.dialect = dialect, .start = {}, .tools = {}});
}

inline Recorded run_program(const Program& program, const Machine& machine) {
    Recorded recorded;
    recorded.summary = simulate(
        program, machine, Vec3::Zero(),
        [&](std::span<const SimulatedPoint> p) { recorded.points.insert(recorded.points.end(), p.begin(), p.end()); },
        {});
    return recorded;
}

/// The curves of a program's motions, from the origin; motions without movement have length 0.
inline std::vector<PathElement> elements_of(const Program& program) {
    std::vector<PathElement> elements;
    Vec3 at = Vec3::Zero();
    for (std::int64_t m = 0; m < program.motions.size(); ++m) {
        const auto i = static_cast<std::size_t>(m);
        const MotionKind kind = program.motions.kind[i];
        if (kind == MotionKind::dwell) continue;
        const Xyz& to = program.motions.end[i];
        const Vec3 end(to.x == to.x ? to.x : at.x(), to.y == to.y ? to.y : at.y(), to.z == to.z ? to.z : at.z());
        elements.push_back(element_of(kind, is_arc(kind) ? program.motions.arc_of(m) : nullptr, at, end));
        elements.back().line = program.motions.line[i];
        at = end;
    }
    return elements;
}

/// The distance of a point from a curve [mm]: samples, then golden section search between the neighbours of the best one.
inline double distance_to(const PathElement& element, const Vec3& point) {
    if (!(element.length > 0)) return (element.begin - point).norm();
    if (element.straight())
        return (element.at(std::clamp((point - element.begin).dot(element.direction), 0.0, element.length)) - point)
            .norm();
    constexpr int places = 32;
    int best = 0;
    double least = std::numeric_limits<double>::infinity();
    const auto distance = [&](double arc_length) { return (element.at(arc_length) - point).norm(); };
    for (int k = 0; k <= places; ++k) {
        const double here = distance(element.length * k / places);
        if (here < least) least = here, best = k;
    }
    double low = element.length * std::max(0, best - 1) / places,
           high = element.length * std::min(places, best + 1) / places;
    constexpr double golden = 0.6180339887498949;
    for (int k = 0; k < 30; ++k) {
        const double a = high - golden * (high - low), b = low + golden * (high - low);
        (distance(a) < distance(b) ? high : low) = distance(a) < distance(b) ? b : a;
    }
    return std::min(least, distance(0.5 * (low + high)));
}

/// The largest distance of every `step`-th point from the program [mm]. Only motions whose lines
/// are at most `around` away from the point's line are searched.
inline double greatest_distance(const std::vector<PathElement>& path, const std::vector<SimulatedPoint>& points,
                                std::size_t step, LineNumber around) {
    double greatest = 0;
    for (std::size_t i = 0; i < points.size(); i += step) {
        const SimulatedPoint& p = points[i];
        double least = std::numeric_limits<double>::infinity();
        for (const PathElement& e : path) {
            if (e.line + around < p.line || e.line > p.line + around) continue;
            if ((e.begin - p.commanded).norm() - e.length > least) continue;
            least = std::min(least, distance_to(e, p.commanded));
            if (least <= greatest) break;
        }
        greatest = std::max(greatest, least);
    }
    return greatest;
}

}  // namespace clsurf
