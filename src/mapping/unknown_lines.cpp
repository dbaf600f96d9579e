#include "mapping/unknown_lines.h"

#include <algorithm>
#include <array>
#include <span>

namespace clsurf {
namespace {

// Points that are read at once; results do not depend on it.
constexpr std::size_t read_at_once = 4096;

/// Calls body(first, lines) for blocks of points.
template <typename Body>
void for_lines(const LineMap& map, const Body& body) {
    std::array<LineNumber, read_at_once> lines;
    for (PointIndex begin = 0; begin < map.count(); begin += static_cast<PointIndex>(read_at_once)) {
        const auto left = static_cast<std::size_t>(map.count() - begin);
        const std::span<LineNumber> block(lines.data(), std::min(read_at_once, left));
        map.read(begin, block);
        body(begin, block);
    }
}

LineNumber highest_line(const LineMap& map) {
    LineNumber highest = 0;
    for_lines(map, [&](PointIndex, std::span<const LineNumber> lines) {
        highest = std::max(highest, *std::max_element(lines.begin(), lines.end()));
    });
    return highest;
}

}  // namespace

UnknownLines find_unknown_lines(const Trajectory& path, const Program& program, const LineMap& map) {
    LineNumber last = 0;
    for (const SourceText& file : program.files) last = std::max(last, file.line_count());
    UnknownLines found;
    if (highest_line(map) <= last) return found;
    std::array<double, read_at_once> x, y, z;
    Vec3 before = path.at(0);
    for_lines(map, [&](PointIndex first, std::span<const LineNumber> lines) {
        path.read(first, {x.data(), lines.size()}, {y.data(), lines.size()}, {z.data(), lines.size()});
        for (std::size_t i = 0; i < lines.size(); ++i) {
            const Vec3 p(x[i], y[i], z[i]);
            const bool moved = (p - before).squaredNorm() > 0;
            before = p;
            if (!moved || lines[i] == 0) continue;
            ++found.moving;
            if (lines[i] <= last) continue;
            if (found.unknown++ == 0) found.first = first + static_cast<PointIndex>(i);
            found.low = std::min(found.low, lines[i]);
            found.high = std::max(found.high, lines[i]);
        }
    });
    return found;
}

}  // namespace clsurf
