#include "machined/as_machined_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "core/parallel.h"
#include "machined/contact.h"
#include "machined/contact_points.h"
#include "machined/swept_segment.h"

namespace clsurf {
namespace {

constexpr double smooth_seconds = 0.015;  ///< as heights are (signals.cpp)
constexpr PointIndex section_points = 64;
constexpr std::int64_t tile_cells = 256;    ///< a side: 256 kB, which the L2 cache holds
constexpr double step_overs_aside = 1.5;    ///< half width of the strip where passes lie as they should …
constexpr double least_followed = 0.002;    ///< [mm] … or as far as the pits that are there reach, of this depth …
constexpr double deepest_followed = 0.020;  ///< [mm] … up to this one
constexpr double rough = 0.0005;            ///< [mm] what is left of noise moves the contact along the way
constexpr float least_up = 0.05F;           ///< of the normal: steeper walls have no height
constexpr double most_between = 1000;       ///< contact points between two positions
constexpr PointIndex normal_reach = 512;    ///< points to look for a normal in, where a point has none

int smoother_points(double period) {
    const int points = static_cast<int>(std::lround(std::min(smooth_seconds / period, 2000.0))) | 1;
    return points >= 5 ? points : 1;
}

Eigen::Vector2f flat(const Eigen::Vector3f& v) { return v.head<2>(); }

}  // namespace

Box2 MapFrame::bounds(std::int64_t column, std::int64_t row, std::int64_t wide, std::int64_t high) const {
    Box2 box;
    for (const std::int64_t c : {column, column + wide - 1}) {
        for (const std::int64_t r : {row, row + high - 1})
            box.extend(at(static_cast<double>(c), static_cast<double>(r)));
    }
    return box;
}

MapFrame frame_of(const Box2& box, double cell) {
    MapFrame frame;
    if (box.isEmpty()) return frame;
    frame.corner = box.min();
    frame.cell = cell;
    frame.columns = static_cast<std::int64_t>(std::floor(box.sizes().x() / cell)) + 1;
    frame.rows = static_cast<std::int64_t>(std::floor(box.sizes().y() / cell)) + 1;
    return frame;
}

/// The part of a frame that is worked on at a time.
struct AsMachinedSurface::Tile {
    const MapFrame& frame;
    Vec2 corner;  ///< [mm] middle of its first cell
    CellBlock cells;
};

AsMachinedSurface::AsMachinedSurface(const ClSurface& surface, const Signals& signals, Role surface_role,
                                     const Trajectory& swept, const std::vector<PointRange>& pieces,
                                     const CuttingTool& tool)
    : surface_(surface),
      signals_(signals),
      surface_role_(surface_role),
      swept_(swept),
      tool_(tool),
      smoother_({smoother_points(swept.period), 2, 0, swept.period}),
      smoothed_(smoother_points(swept.period) > 1) {
    const int points = smoother_.filter().points;
    note_ =
        fmt::format("{} positions{}", name_of(swept.role),
                    smoothed_ ? fmt::format(" over {} points ({:.3g} ms)", points, 1e3 * points * swept.period) : "");
    auto pass = surface.passes.begin();
    for (const PointRange& piece : pieces) {
        while (pass != surface.passes.end() && pass->last < piece.first) ++pass;
        if (pass == surface.passes.end()) break;
        if (pass->kind == PassKind::cut ||
            (pass->kind == PassKind::link && stays_low(surface.positions, *pass, surface.step_over)))
            pieces_.push_back(piece);
    }
    cut_sections();
}

void AsMachinedSurface::cut_sections() {
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
        const PointRange& piece = pieces_[k];
        // The way goes on into the next piece, but over a gap in time nobody knows how.
        const bool joined = k + 1 < pieces_.size() && pieces_[k + 1].first == piece.last + 1;
        for (PointIndex first = piece.first; first <= piece.last; first += section_points) {
            Section section;
            section.first = std::max(piece.first, first - 1);  // the segment before tells where the contact came from
            section.last = std::min(piece.last, first + section_points - 1);
            section.piece = k;
            section.goes_on = section.last < piece.last || joined;
            sections_.push_back(section);
        }
    }
    parallel_for(static_cast<std::int64_t>(sections_.size()), 256, [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t k = first; k < last; ++k) measure(sections_[static_cast<std::size_t>(k)]);
    });
    Eigen::AlignedBox2f all;
    for (const Section& section : sections_) all.extend(section.bounds);
    const Vec2 origin = surface_.positions.origin.head<2>();
    if (!all.isEmpty()) bounds_ = Box2(all.min().cast<double>() + origin, all.max().cast<double>() + origin);
}

/// The normal of a point, or of the next one that has one: links have no neighbours of their own.
Eigen::Vector3f AsMachinedSurface::normal_of(PointIndex point, PointRange within) const {
    const auto known = [&](PointIndex i) { return signals_.normal(i).allFinite(); };
    if (known(point)) return signals_.normal(point);
    const PointIndex count = swept_.count;
    for (PointIndex off = 1; off <= normal_reach; ++off) {
        if (point - off >= std::max<PointIndex>(0, within.first - normal_reach) && known(point - off))
            return signals_.normal(point - off);
        if (point + off < std::min(count, within.last + normal_reach) && known(point + off))
            return signals_.normal(point + off);
    }
    // A single pass: upright but for the slope along the way.
    const Eigen::Vector3f up = Eigen::Vector3f::UnitZ();
    const Eigen::Vector3f feed = signals_.feed(point);
    if (!feed.allFinite() || std::abs(feed.z()) > 0.99F) return up;
    return (up - feed.z() * feed).normalized();
}

Vec3 AsMachinedSurface::contact(PointIndex point) const {
    const Eigen::Vector3f normal = signals_.normal(point);
    return surface_.positions.absolute(point) + contact_offset(tool_, normal.cast<double>());
}

/// How far the tool may run below its neighbours about a section [mm].
double AsMachinedSurface::depth_of(const Section& section) const {
    if (swept_.role != surface_role_ && !signals_.measured) return deepest_followed;
    double depth = least_followed;
    constexpr PointIndex stride = 8;
    const PointIndex end = std::min(swept_.count, section.last + section_points);
    for (PointIndex i = std::max<PointIndex>(0, section.first - section_points); i < end; i += stride) {
        // Below the chord between both neighbours by d is below one of them by no more than twice that.
        double below = signals_[i].relief < 0 ? -2.0 * signals_[i].relief : 0.0;
        if (swept_.role != surface_role_) {
            float highest = 0;
            for (const Side side : {Side::left, Side::right}) {
                if (!surface_.neighbours.has(side, i)) continue;
                const float above = signals_[surface_.neighbours.neighbour(side, i)].lag - signals_[i].lag;
                if (above > highest) highest = above;
            }
            below += highest;
        }
        depth = std::max(depth, below);
    }
    return std::min(depth, deepest_followed);
}

/// How wide the strip must be: where neighbours lie far apart, and as far as a pit reaches. Where two
/// outlines of radius q, s apart, differ by d in height, the lower one cuts to s/2 + q d/s.
void AsMachinedSurface::measure(Section& section) const {
    const PointRange piece = pieces_[section.piece];
    const double most = 2 * tool_.radius;
    const double s = surface_.step_over;
    double aside = s > 0 ? step_overs_aside * s : most;
    double before = 2 * usual_cell();
    const double depth = depth_of(section);
    double steepest = 0;
    const Positions& p = surface_.positions;
    std::vector<double> axes[3];
    for (std::vector<double>& axis : axes)
        axis.resize(static_cast<std::size_t>(section.last - section.first + (section.goes_on ? 2 : 1)));
    swept_.read(section.first, axes[0], axes[1], axes[2]);
    Eigen::AlignedBox2f tips;
    for (std::size_t k = 0; k < axes[0].size(); ++k) {
        const Eigen::Vector2f tip = (Vec2(axes[0][k], axes[1][k]) - p.origin.head<2>()).cast<float>();
        if (tip.allFinite()) tips.extend(tip);
    }
    Eigen::AlignedBox2f offsets;
    constexpr PointIndex stride = 8;
    for (PointIndex i = section.first; i <= section.last; ++i) {
        if (!p[i].allFinite() || !((i - section.first) % stride == 0 || i == section.last)) continue;
        const Vec3 normal = normal_of(i, piece).cast<double>();
        const Vec3 off = contact_offset(tool_, normal);
        const Eigen::Vector2f here = flat(p[i]) + off.head<2>().cast<float>();
        offsets.extend(Eigen::Vector2f(off.head<2>().cast<float>()));
        const double radius = contact_radius(tool_, normal);
        if (s > 0) aside = std::max(aside, 0.5 * s + radius * depth / s);
        before = std::max(before, std::sqrt(2 * radius * rough));
        if (const float climb = std::abs(signals_.feed(i).z()); climb > steepest) steepest = climb;
        for (const Side side : {Side::left, Side::right}) {
            if (!surface_.neighbours.has(side, i)) continue;
            const PointIndex j = surface_.neighbours.neighbour(side, i);
            const Vec3 other = contact_offset(tool_, normal_of(j, {j, j}).cast<double>());
            const Eigen::Vector2f there = flat(p[j]) + other.head<2>().cast<float>();
            if ((there - here).allFinite()) aside = std::max(aside, static_cast<double>((there - here).norm()));
        }
    }
    aside = std::min(aside, most);
    section.aside = static_cast<float>(aside);
    // On a slope, what is cut beside the contact line lies ahead of it or behind.
    section.before = static_cast<float>(std::min(before + 0.5 * steepest * aside * aside / tool_.radius, most));
    if (tips.isEmpty() || offsets.isEmpty()) return;
    // Between the normals that were looked at, and where the segments' own slope differs, the contact moves a little.
    const double room = std::hypot(section.aside, section.before) + 0.1 * tool_.radius;
    section.bounds = Eigen::AlignedBox2f(tips.min().array() + offsets.min().array() - static_cast<float>(room),
                                         tips.max().array() + offsets.max().array() + static_cast<float>(room));
}

/// Positions of a section and, where it goes on, of the next point.
void AsMachinedSurface::read_swept(const Section& section, std::vector<double> (&axes)[3]) const {
    const PointRange piece = pieces_[section.piece];
    const PointIndex end = section.last + (section.goes_on ? 1 : 0);
    const auto count = static_cast<std::size_t>(end - section.first + 1);
    for (std::vector<double>& axis : axes) axis.resize(count);
    if (!smoothed_) {
        swept_.read(section.first, axes[0], axes[1], axes[2]);
        return;
    }
    const PointIndex from = std::max(piece.first, section.first - smoother_.reach());
    const PointIndex to = std::min(piece.last, end + smoother_.reach());
    std::vector<double> raw[3];
    for (std::vector<double>& axis : raw) axis.resize(static_cast<std::size_t>(to - from + 1));
    swept_.read(from, raw[0], raw[1], raw[2]);
    const auto inside = static_cast<std::size_t>(std::min(end, piece.last) - section.first + 1);
    for (std::size_t axis = 0; axis < 3; ++axis)
        smoother_.apply(raw[axis], from, piece, section.first, std::span(axes[axis]).first(inside));
    if (inside == count) return;
    const Vec3 next = swept_.at(end);  // the next piece's first point
    for (std::size_t axis = 0; axis < 3; ++axis) axes[axis].back() = next[static_cast<Eigen::Index>(axis)];
}

void AsMachinedSurface::lower_by(const Section& section, const Tile& tile) const {
    std::vector<double> axes[3];
    read_swept(section, axes);
    const Vec2 along = tile.frame.along;
    const Vec2 across = tile.frame.across();
    const auto in_tile = [&](std::size_t k) {
        const Vec2 off = Vec2(axes[0][k], axes[1][k]) - tile.corner;
        return Vec3(along.dot(off), across.dot(off), axes[2][k] - level());
    };
    // From the tip to the contact point, in the plane. The normal is the surface's across the feed, but along
    // it that of the segment: the swept point lies behind the surface's by the lag.
    const auto offset = [&](std::size_t k, const Vec3& step) {
        const Vec3 normal =
            normal_of(section.first + static_cast<PointIndex>(k), pieces_[section.piece]).cast<double>();
        const Vec3 in_frame(along.dot(normal.head<2>()), across.dot(normal.head<2>()), normal.z());
        const Vec3 turned = in_frame - in_frame.dot(step) / std::max(step.squaredNorm(), 1e-20) * step;
        return std::pair(contact_offset(tool_, turned.normalized()), turned.normalized().z() >= least_up);
    };
    const double least = usual_cell();
    const std::size_t count = axes[0].size();
    std::size_t a = 0;
    std::optional<Vec3> offset_before;
    for (std::size_t b = 1; b < count; ++b) {
        const Vec3 from = in_tile(a);
        const Vec3 to = in_tile(b);
        const Vec3 step = to - from;
        const double length = step.head<2>().norm();
        // Points nearer to each other than the cells are taken together: the chord hardly leaves the way.
        if (length < least && b + 1 < count) continue;
        const auto [here, up] = offset(a, step);
        a = b;
        if (!from.allFinite() || !to.allFinite() || !up) {
            offset_before.reset();
            continue;
        }
        const bool stands = length < 1e-6;
        const Vec2 direction = stands ? Vec2(Vec2::UnitX()) : Vec2(step.head<2>() / length);
        const Vec2 left(-direction.y(), direction.x());
        // At a corner the contact moves round the tool: the strip goes from where it was to where it is.
        const Vec2 c = here.head<2>();
        const Vec2 d = offset_before.value_or(here).head<2>();
        const std::pair along_range = std::minmax({direction.dot(c), direction.dot(d)});
        const std::pair across_range = std::minmax({left.dot(c), left.dot(d)});
        SweptSegment g;
        g.x = static_cast<float>(from.x());
        g.y = static_cast<float>(from.y());
        g.z = static_cast<float>(stands ? std::min(from.z(), to.z()) : from.z());
        g.dx = static_cast<float>(direction.x());
        g.dy = static_cast<float>(direction.y());
        g.length = stands ? 0.0F : static_cast<float>(length);
        g.slope = stands ? 0.0F : static_cast<float>(step.z() / length);
        g.along_low = static_cast<float>(along_range.first) - section.before;
        g.along_high = static_cast<float>(length + along_range.second) + section.before;
        g.across_low = static_cast<float>(across_range.first) - section.aside;
        g.across_high = static_cast<float>(across_range.second) + section.aside;
        lower(tool_, g, tile.cells);
        offset_before = here;
    }
}

std::vector<std::size_t> AsMachinedSurface::sections_in(const Box2& box) const {
    const Vec2 origin = surface_.positions.origin.head<2>();
    const Eigen::AlignedBox2f near((box.min() - origin).cast<float>(), (box.max() - origin).cast<float>());
    std::vector<std::size_t> found;
    for (std::size_t k = 0; k < sections_.size(); ++k) {
        if (!sections_[k].bounds.isEmpty() && sections_[k].bounds.intersects(near)) found.push_back(k);
    }
    return found;
}

void AsMachinedSurface::map(const MapFrame& frame, const TakeRows& take) const {
    const std::int64_t tiles = (frame.columns + tile_cells - 1) / tile_cells;
    constexpr float nothing = std::numeric_limits<float>::infinity();
    std::vector<float> rows;
    for (std::int64_t first_row = 0; first_row < frame.rows; first_row += tile_cells) {
        const std::int64_t high = std::min(tile_cells, frame.rows - first_row);
        rows.resize(static_cast<std::size_t>(high * frame.columns));
        const std::vector<std::size_t> near = sections_in(frame.bounds(0, first_row, frame.columns, high));
        parallel_for(tiles, 1, [&](std::int64_t first, std::int64_t last) {
            std::vector<float> z;
            for (std::int64_t t = first; t < last; ++t) {
                const std::int64_t column = t * tile_cells;
                const std::int64_t wide = std::min(tile_cells, frame.columns - column);
                z.assign(static_cast<std::size_t>(wide * high), nothing);
                const Tile tile{
                    frame,
                    frame.at(static_cast<double>(column), static_cast<double>(first_row)),
                    {z.data(), static_cast<int>(wide), static_cast<int>(high), static_cast<float>(frame.cell)}};
                const Box2 world = frame.bounds(column, first_row, wide, high);
                const Vec2 origin = surface_.positions.origin.head<2>();
                const Eigen::AlignedBox2f box((world.min() - origin).cast<float>(),
                                              (world.max() - origin).cast<float>());
                for (const std::size_t k : near) {
                    if (sections_[k].bounds.intersects(box)) lower_by(sections_[k], tile);
                }
                for (std::int64_t r = 0; r < high; ++r) {
                    for (std::int64_t c = 0; c < wide; ++c) {
                        const float height = z[static_cast<std::size_t>(r * wide + c)];
                        rows[static_cast<std::size_t>(r * frame.columns + column + c)] =
                            height < nothing ? height : std::numeric_limits<float>::quiet_NaN();
                    }
                }
            }
        });
        take(first_row, rows);
    }
}

std::vector<ContactPoint> AsMachinedSurface::contacts(const Box2& box, double spacing) const {
    std::vector<ContactPoint> found;
    const std::vector<std::size_t> near = sections_in(box);
    for (const std::size_t number : near) {
        const Section& section = sections_[number];
        bool goes_on = false;
        ContactPoint before;
        for (PointIndex i = section.first; i <= section.last; ++i) {
            const ContactPoint now{contact(i), surface_.positions.absolute(i)};
            if (!now.at.allFinite()) {
                goes_on = false;
                continue;
            }
            const double distance = goes_on ? (now.at - before.at).norm() : spacing;
            if (distance < spacing) continue;
            // Points farther apart than that: as many between them as are missing.
            const int pieces = goes_on ? static_cast<int>(std::min(distance / spacing, most_between)) : 1;
            for (int k = 1; k <= pieces; ++k) {
                const double share = static_cast<double>(k) / pieces;
                const ContactPoint between = goes_on ? ContactPoint{before.at + share * (now.at - before.at),
                                                                    before.tip + share * (now.tip - before.tip)}
                                                     : now;
                if (box.contains(between.at.head<2>())) found.push_back(between);
            }
            before = now;
            goes_on = true;
        }
    }
    return found;
}

}  // namespace clsurf
