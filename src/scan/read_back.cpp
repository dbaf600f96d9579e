#include "scan/read_back.h"

#include <algorithm>
#include <span>
#include <vector>

#include "core/error.h"
#include "scan/append_tips.h"

namespace clsurf {
namespace {

double distance_to_line(const Vec2& p, const Vec2& a, const Vec2& b) {
    const Vec2 chord = b - a;
    const double square = chord.squaredNorm();
    const double t = square > 0 ? std::clamp((p - a).dot(chord) / square, 0.0, 1.0) : 0;
    return (p - a - t * chord).norm();
}

/// Greatest distance of `places` from a polyline; both in ascending x.
double greatest_distance(std::span<const Vec2> places, std::span<const Vec2> chords) {
    double greatest = 0;
    std::size_t near = 0;
    for (const Vec2& place : places) {
        while (near + 2 < chords.size() && chords[near + 1].x() < place.x()) ++near;
        constexpr std::size_t beside = 64;  // on steep flanks points of a run are not sorted by x
        const std::size_t first = near < beside ? 0 : near - beside;
        const std::size_t end = std::min(chords.size() - 1, near + beside + 1);
        double least = (place - chords[first]).norm();
        for (std::size_t k = first; k < end; ++k)
            least = std::min(least, distance_to_line(place, chords[k], chords[k + 1]));
        greatest = std::max(greatest, least);
    }
    return greatest;
}

}  // namespace

ReadBack read_back(const Program& program, const CutPath& path) {
    const Motions& motions = program.motions;
    std::vector<Vec2> chords;
    ReadBack result;
    for (std::int64_t i = 0; i < motions.size(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (!is_cut(motions.kind[k])) continue;
        if (chords.empty()) {  // the approach
            chords.emplace_back(motions.end[k].x, motions.end[k].z);
            continue;
        }
        ++result.motions;
        append_tips(motions, i, chords);
    }
    if (chords.size() < 2) throw InputError(Place::of_file(program.main().name()), "does not move at feed");
    result.deviation = distance_from(path, chords);
    return result;
}

double distance_from(const CutPath& path, std::span<const Vec2> places) {
    return std::max(greatest_distance(path.samples(), places), greatest_distance(places, path.samples()));
}

std::pair<LineNumber, LineNumber> lines_of_cut(const Program& program) {
    const Motions& motions = program.motions;
    LineNumber first = 0, last = 0;
    bool approached = false;
    for (std::size_t k = 0; k < static_cast<std::size_t>(motions.size()); ++k) {
        if (!is_cut(motions.kind[k])) continue;
        if (!approached) {
            approached = true;
            continue;
        }
        if (first == 0) first = motions.line[k];
        last = motions.line[k];
    }
    return {first, last};
}

}  // namespace clsurf
