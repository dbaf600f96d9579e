#include "machined/as_machined_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/parallel.h"
#include "core/point_count.h"
#include "machined/contact.h"
#include "machined/contact_points.h"
#include "machined/passes_between.h"

namespace clsurf {
namespace {

constexpr double smooth_seconds = 0.015;  ///< as for heights (signals.cpp)
constexpr PointIndex section_points = 64;
constexpr std::int64_t section_group = 256;  ///< sections that are measured together
constexpr float rough_room = 1;              ///< [mm] largest distance of smoothed positions from the original ones
constexpr std::int64_t tile_cells = 256;     ///< per side: 256 kB, which fit into the L2 cache
constexpr std::int64_t tile_of_row = 4096;   ///< cells if there are hardly any rows: all cells use the same sections
constexpr std::int64_t few_rows = 4;
constexpr double passes_apart = 2;  ///< step-overs, from above: farthest of interpolated passes from their neighbours
constexpr std::size_t most_kept = 1000;  ///< sections whose interpolated passes are stored: 25 MB
constexpr double most_between = 1000;    ///< contact points between two positions

int smoother_points(double period) {
    const int points = window_points(smooth_seconds, period);
    return points >= 5 ? points : 1;
}

}  // namespace

AsMachinedSurface::AsMachinedSurface(const ClSurface& surface, const Signals& signals, Role surface_role,
                                     const Trajectory& swept, const std::vector<PointRange>& pieces,
                                     const CuttingTool& tool, ProgrammedMarks marks)
    : surface_(surface),
      signals_(signals),
      surface_role_(surface_role),
      swept_(swept),
      tool_(tool),
      marks_(std::move(marks)),
      smoother_({smoother_points(swept.period), 2, 0, swept.period}),
      smoothed_(smoother_points(swept.period) > 1) {
    const int points = smoother_.filter().points;
    note_ =
        fmt::format("{} positions{}", name_of(swept.role),
                    smoothed_ ? fmt::format(" over {} points ({:.3g} ms)", points, 1e3 * points * swept.period) : "");
    auto pass = surface.passes.begin();
    const auto low = [&] {
        return surface.low_links.empty() ? stays_low(surface.positions, *pass, surface.step_over)
                                         : surface.low_links[static_cast<std::size_t>(pass - surface.passes.begin())];
    };
    for (const PointRange& piece : pieces) {
        while (pass != surface.passes.end() && pass->last < piece.first) ++pass;
        if (pass == surface.passes.end()) break;
        if (pass->kind == PassKind::cut || (pass->kind == PassKind::link && low())) pieces_.push_back(piece);
    }
    cut_sections();
    measure_sections();
}

void AsMachinedSurface::cut_sections() {
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
        const PointRange& piece = pieces_[k];
        // The path continues into the next piece. Over a gap in time it is not known.
        const bool joined = k + 1 < pieces_.size() && pieces_[k + 1].first == piece.last + 1;
        for (PointIndex first = piece.first; first <= piece.last; first += section_points) {
            Section section;
            section.first = std::max(piece.first, first - 1);  // the previous segment is also needed
            section.last = std::min(piece.last, first + section_points - 1);
            section.piece = k;
            section.goes_on = section.last < piece.last || joined;
            sections_.push_back(section);
        }
    }
}

void AsMachinedSurface::measure_sections() {
    const auto count = static_cast<std::int64_t>(sections_.size());
    const auto measure_some = [this](std::int64_t first, std::int64_t last) {
        for (std::int64_t k = first; k < last; ++k) measure(sections_[static_cast<std::size_t>(k)]);
    };
    Eigen::AlignedBox2f all;
    if (surface_.positions.fill) {
        measured_ = {count, {}, section_group};
        all = rough_box(0, sections_.size());
    } else {
        parallel_for(count, section_group, measure_some);
        for (const Section& section : sections_) all.extend(section.cuts);
    }
    const Vec2 origin = surface_.positions.origin.head<2>();
    const Vec2 margin = Vec2::Constant(std::max(surface_.step_over, usual_cell()));
    if (!all.isEmpty())
        bounds_ = Box2(all.min().cast<double>() + origin - margin, all.max().cast<double>() + origin + margin);
}

Vec3 contact_at(const ClSurface& surface, const Signals& signals, const CuttingTool& tool, PointIndex point) {
    return surface.positions.absolute(point) + contact_offset(tool, signals.normal(point).cast<double>());
}

Vec3 AsMachinedSurface::contact(PointIndex point) const { return contact_at(surface_, signals_, tool_, point); }

void AsMachinedSurface::measure(Section& section) const {
    std::vector<double> axes[3];
    read_swept(section, axes);
    const Vec2 origin = surface_.positions.origin.head<2>();
    for (std::size_t k = 0; k < axes[0].size(); ++k) {
        const Eigen::Vector2f tip = (Vec2(axes[0][k], axes[1][k]) - origin).cast<float>();
        if (tip.allFinite()) section.tips.extend(tip);
    }
    constexpr PointIndex stride = 8;
    for (PointIndex i = section.first; i <= section.last; ++i) {
        const Eigen::Vector2f own = surface_.positions[i].head<2>();
        if (own.allFinite()) section.tips.extend(own);
        if (!((i - section.first) % stride == 0 || i == section.last)) continue;
        const Eigen::Vector2f at = (contact(i).head<2>() - origin).cast<float>();
        if (at.allFinite()) section.cuts.extend(at);
    }
}

/// Positions of a section and, if it continues, of the next point.
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
    const Vec3 next = swept_.at(end);  // first point of the next piece
    for (std::size_t axis = 0; axis < 3; ++axis) axes[axis].back() = next[static_cast<Eigen::Index>(axis)];
}

void AsMachinedSurface::add_swept(const Section& section, const FrameAxes& axes, SweptPieces& pieces) const {
    std::vector<double> read[3];
    read_swept(section, read);
    const double longest = longest_piece(tool_, usual_cell());
    const double least = usual_cell();
    const std::size_t count = read[0].size();
    const auto at = [&](std::size_t k) { return axes(Vec3(read[0][k], read[1][k], read[2][k])); };
    Vec3 from = at(0);
    for (std::size_t k = 1; k < count; ++k) {
        const Vec3 to = at(k);
        // Points closer to each other than the cells are merged: the chord hardly leaves the path.
        if ((to - from).head<2>().norm() < least && std::abs(to.z() - from.z()) < least && k + 1 < count) continue;
        pieces.add(from, to, longest);
        from = to;
    }
}

std::vector<std::size_t> AsMachinedSurface::sections_in(const Box2& box, double reach) const {
    const Vec2 origin = surface_.positions.origin.head<2>();
    const Vec2 room = Vec2::Constant(reach);
    const Eigen::AlignedBox2f near((box.min() - origin - room).cast<float>(),
                                   (box.max() - origin + room).cast<float>());
    std::vector<std::size_t> found;
    constexpr auto group = static_cast<std::size_t>(section_group);
    for (std::size_t first = 0; first < sections_.size(); first += group) {
        const std::size_t last = std::min(sections_.size(), first + group);
        if (measured_) {
            if (!rough_box(first, last).intersects(near)) continue;
            measured_->need(static_cast<PointIndex>(first), [this](PointIndex begin, PointIndex end) {
                for (PointIndex k = begin; k < end; ++k) measure(sections_[static_cast<std::size_t>(k)]);
            });
        }
        for (std::size_t k = first; k < last; ++k) {
            if (!sections_[k].tips.isEmpty() && sections_[k].tips.intersects(near)) found.push_back(k);
        }
    }
    return found;
}

Eigen::AlignedBox2f AsMachinedSurface::rough_box(std::size_t first, std::size_t last) const {
    Eigen::AlignedBox2f box;
    if (first >= last) return box;
    const PointIndex reach = smoother_.reach() + 1;
    const PointIndex begin = std::max<PointIndex>(0, sections_[first].first - reach) / block_points;
    const PointIndex end = std::min(swept_.count - 1, sections_[last - 1].last + reach) / block_points;
    for (PointIndex block = begin; block <= end; ++block) {
        const Eigen::AlignedBox3f& points = surface_.boxes[static_cast<std::size_t>(block)];
        if (points.isEmpty()) continue;
        box.extend(Eigen::Vector2f(points.min().head<2>().array() - rough_room));
        box.extend(Eigen::Vector2f(points.max().head<2>().array() + rough_room));
    }
    return box;
}

void AsMachinedSurface::map(const MapFrame& frame, const TakeRows& take) const {
    map_tiles(
        frame,
        [this](const Section& section, const FrameAxes& axes, SweptPieces& pieces) {
            add_swept(section, axes, pieces);
        },
        0, take);
}

PassesBetween AsMachinedSurface::passes_between(const Box2& region, bool many) const {
    const double reach = tool_.radius + passes_apart * surface_.step_over;
    PassesBetween between(surface_, signals_, smoothed_ ? &smoother_ : nullptr, pieces_, points_near(region, reach),
                          tool_, usual_cell(), marks_);
    const std::vector<std::size_t> near = sections_in(region, reach);
    if (!many || near.size() > most_kept) return between;
    for (const std::size_t k : near) {
        const Section& section = sections_[k];
        between.keep({section.first, section.last}, section.piece, section.goes_on);
    }
    return between;
}

void AsMachinedSurface::map_programmed(const PassesBetween& between, const MapFrame& frame,
                                       const TakeRows& take) const {
    map_tiles(
        frame,
        [&](const Section& section, const FrameAxes& axes, SweptPieces& pieces) {
            between.add({section.first, section.last}, section.piece, section.goes_on, axes, pieces);
        },
        passes_apart * surface_.step_over, take);
}

void AsMachinedSurface::map_tiles(const MapFrame& frame, const Gather& gather, double farthest,
                                  const TakeRows& take) const {
    const std::int64_t most = frame.rows <= few_rows ? tile_of_row : tile_cells;
    const std::int64_t tiles = (frame.columns + most - 1) / most;
    constexpr float nothing = std::numeric_limits<float>::infinity();
    std::vector<float> rows;
    const double reach = tool_.radius + usual_cell() + farthest;
    for (std::int64_t first_row = 0; first_row < frame.rows; first_row += tile_cells) {
        const std::int64_t high = std::min(tile_cells, frame.rows - first_row);
        rows.resize(static_cast<std::size_t>(high * frame.columns));
        const std::vector<std::size_t> near = sections_in(frame.bounds(0, first_row, frame.columns, high), reach);
        parallel_for(tiles, 1, [&](std::int64_t first, std::int64_t last) {
            std::vector<float> z;
            SweptPieces pieces;
            for (std::int64_t t = first; t < last; ++t) {
                const std::int64_t column = t * most;
                const std::int64_t wide = std::min(most, frame.columns - column);
                z.assign(static_cast<std::size_t>(wide * high), nothing);
                const FrameAxes axes{frame.at(static_cast<double>(column), static_cast<double>(first_row)), frame.along,
                                     level()};
                const Box2 world = frame.bounds(column, first_row, wide, high);
                const Vec2 origin = surface_.positions.origin.head<2>();
                const Vec2 room = Vec2::Constant(reach);
                const Eigen::AlignedBox2f box((world.min() - origin - room).cast<float>(),
                                              (world.max() - origin + room).cast<float>());
                pieces.clear();
                for (const std::size_t k : near) {
                    if (sections_[k].tips.intersects(box)) gather(sections_[k], axes, pieces);
                }
                lower(tool_, pieces,
                      {z.data(), static_cast<int>(wide), static_cast<int>(high), static_cast<float>(frame.cell),
                       static_cast<float>(frame.pitch_of_rows())});
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

std::vector<PointRange> AsMachinedSurface::points_near(const Box2& box, double reach) const {
    std::vector<PointRange> ranges;
    for (const std::size_t k : sections_in(box, reach)) {
        const Section& section = sections_[k];
        if (!ranges.empty() && section.first <= ranges.back().last + 1)
            ranges.back().last = std::max(ranges.back().last, section.last);
        else
            ranges.push_back({section.first, section.last});
    }
    return ranges;
}

std::vector<ContactPoint> AsMachinedSurface::contacts(const Box2& box, double spacing) const {
    std::vector<ContactPoint> found;
    // A contact point is no farther from its tip than the radius of the tool.
    const std::vector<std::size_t> near = sections_in(box, tool_.radius);
    for (const std::size_t number : near) {
        const Section& section = sections_[number];
        bool goes_on = false;
        ContactPoint before;
        for (PointIndex i = section.first; i <= section.last; ++i) {
            const Vec3 mark = marks_.at(i);
            const ContactPoint now{contact(i) - mark, surface_.positions.absolute(i) - mark};
            if (!now.at.allFinite()) {
                goes_on = false;
                continue;
            }
            const double distance = goes_on ? (now.at - before.at).norm() : spacing;
            if (distance < spacing) continue;
            // If points are farther apart than the spacing, intermediate ones are inserted.
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
