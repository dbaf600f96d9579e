#include "io/reports/moves_csv.h"

#include <cmath>
#include <vector>

#include <fmt/compile.h>
#include <fmt/format.h>

#include "core/units.h"

namespace clsurf::io {
namespace {

constexpr double chord_error = 1e-4;  ///< [mm] error of the chords of a curve
constexpr std::size_t piece_bytes = std::size_t{1} << 20;

std::string_view name_of(MotionKind kind) {
    switch (kind) {
        case MotionKind::rapid: return "rapid";
        case MotionKind::feed: return "feed";
        case MotionKind::cw: return "cw";
        case MotionKind::ccw: return "ccw";
        case MotionKind::dwell: return "dwell";
        case MotionKind::spline: return "spline";
    }
    return "";
}

/// A number rounded to a nanometre without trailing zeros; empty for NaN.
void put(fmt::memory_buffer& out, double value) {
    out.push_back(',');
    if (std::isnan(value)) return;
    constexpr double grid = 1e9;
    double rounded = std::round(value * grid) / grid;
    if (rounded == 0) rounded = 0;  // no "-0"
    fmt::format_to(std::back_inserter(out), FMT_COMPILE("{}"), rounded);
}

}  // namespace

void write_moves_csv(const Motions& motions, const Kinematics* kinematics,
                     const std::function<void(std::string_view)>& write) {
    fmt::memory_buffer out;
    constexpr std::string_view header = "line,kind,x,y,z,a,b,c,ci,cj,ck,turns,plane,feed";
    out.append(header);
    if (kinematics != nullptr) out.append(std::string_view(",ti,tj,tk"));
    out.push_back('\n');
    auto arc = motions.arcs.begin();
    const auto put_row = [&](std::size_t i, const Xyz& end) {
        const MotionKind kind = motions.kind[i];
        fmt::format_to(std::back_inserter(out), FMT_COMPILE("{},{}"), motions.line[i], name_of(kind));
        put(out, end.x);
        put(out, end.y);
        put(out, end.z);
        if (motions.rotary.empty()) {
            constexpr std::string_view none = ",,,";
            out.append(none);
        } else {
            const Xyz& r = motions.rotary[i];
            for (const double angle : {r.x, r.y, r.z}) put(out, angle * deg_per_rad);
        }
        if (is_arc(kind) && arc != motions.arcs.end() && arc->motion == static_cast<std::int64_t>(i)) {
            put(out, arc->centre.x);
            put(out, arc->centre.y);
            put(out, arc->centre.z);
            const int plane = arc->axis == 2 ? 17 : arc->axis == 1 ? 18 : 19;
            fmt::format_to(std::back_inserter(out), FMT_COMPILE(",{},{}"), arc->turns, plane);
            ++arc;
        } else {
            constexpr std::string_view none = ",,,,,";
            out.append(none);
        }
        const double feed = motions.feed[i];
        put(out, kind == MotionKind::dwell ? std::numeric_limits<double>::quiet_NaN()
                                           : std::round(feed * seconds_per_minute * 1e3) / 1e3);
        if (kinematics != nullptr) {
            const Vec3 axis = kinematics->axis_of(
                kinematics->angles_of(motions.rotary.empty() ? Vec3(0, 0, 0) : motions.rotary[i].vec()));
            for (int k = 0; k < 3; ++k) put(out, axis[k]);
        }
        out.push_back('\n');
        if (out.size() >= piece_bytes) {
            write({out.data(), out.size()});
            out.clear();
        }
    };
    for (std::size_t i = 0; i < motions.kind.size(); ++i) {
        if (motions.kind[i] == MotionKind::spline) {
            if (const Curve* curve = motions.curve_of(static_cast<std::int64_t>(i))) {
                // Rows are points, so a curve becomes its chords.
                std::vector<double> ends = curve->span->with_unknown_at(Vec3::Zero()).chord_ends(chord_error);
                ends.pop_back();
                for (const double t : ends) put_row(i, Xyz(curve->span->at(t)));
            }
        }
        put_row(i, motions.end[i]);
    }
    write({out.data(), out.size()});
}

}  // namespace clsurf::io
