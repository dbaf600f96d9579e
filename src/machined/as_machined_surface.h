#pragma once
// AsMachinedSurface: the as-machined surface. Over each place it is the lowest point of the tool outline along the
// whole path (the fourth surface of Wu et al.). Scallops, lags and differences between passes add up as they
// do on the part: a pit keeps its depth, and neighbours cut a bulge down.
//
// The tool is swept along the straight segments between positions, smoothed over a stated window inside one
// section, because the rounding of an encoder is not cut. Each segment is computed only in a strip around its
// contact line, where it can be the lowest one, so the cost is that of the points times a few cells, whatever
// the tool radius is. Swept are passes, and links between passes of one cutting run that stay low (at most a
// step-over above their ends). Rapids, approaches and high links remove nothing.
//
// Three axes, tool axis +z. A height map has one height over each place: walls steeper than 87° have none.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "machined/tool.h"
#include "predictor/signals.h"

namespace clsurf {

using Box2 = Eigen::AlignedBox2d;

/// A height map's place in the plane: rows run along `along`, any unit vector, so that a map of one row
/// is a profile in any direction.
struct MapFrame {
    Vec2 corner = Vec2::Zero();  ///< [mm] middle of the first cell
    Vec2 along = Vec2::UnitX();
    double cell = 0;  ///< [mm]
    std::int64_t columns = 0, rows = 0;

    [[nodiscard]] Vec2 across() const { return {-along.y(), along.x()}; }
    [[nodiscard]] Vec2 at(double column, double row) const { return corner + cell * (column * along + row * across()); }
    /// Of cells [column, column + columns) × [row, row + rows).
    [[nodiscard]] Box2 bounds(std::int64_t column, std::int64_t row, std::int64_t wide, std::int64_t high) const;
};

/// The axis-parallel frame of a box.
[[nodiscard]] MapFrame frame_of(const Box2& box, double cell);

/// rows [first_row, first_row + z.size() / columns): heights [mm] over AsMachinedSurface::level(), row by
/// row; NaN: nothing was cut there.
using TakeRows = std::function<void(std::int64_t first_row, std::span<float> z)>;

/// Where the tool touches, and where its tip then is [mm].
struct ContactPoint {
    Vec3 at = Vec3::Zero(), tip = Vec3::Zero();
};

class AsMachinedSurface {
public:
    /// `surface`, gathered from the positions of `surface_role`, and `signals` (its normals) tell the
    /// contact, `swept` is what the tool did: commanded, feedback or actual positions of the same
    /// points. Signals with a lag of the swept positions make narrower strips do. All must outlive it.
    /// `pieces` (surface/smoothing_segments.h) bound the smoothing. O(points), parallel.
    AsMachinedSurface(const ClSurface& surface, const Signals& signals, Role surface_role, const Trajectory& swept,
                      const std::vector<PointRange>& pieces, const CuttingTool& tool);

    /// A twentieth of a step-over [mm]; without neighbours a fiftieth of the tool's radius.
    [[nodiscard]] double usual_cell() const {
        return surface_.step_over > 0 ? surface_.step_over / 20 : tool_.radius / 50;
    }
    /// What the strips cover [mm].
    [[nodiscard]] Box2 bounds() const { return bounds_; }
    /// From which heights are counted [mm].
    [[nodiscard]] double level() const { return surface_.positions.origin.z(); }
    [[nodiscard]] const ClSurface& surface() const { return surface_; }
    [[nodiscard]] const CuttingTool& tool() const { return tool_; }
    /// The window of the smoothing, for reports.
    [[nodiscard]] const std::string& note() const { return note_; }

    /// The height map, a row of tiles at a time, from the first row on. Memory: a row of tiles (256 rows
    /// of cells) and a list of sections of the path. The same for any number of threads.
    void map(const MapFrame& frame, const TakeRows& take) const;

    /// Contact points of the surface's own positions [mm] inside a box, about every `spacing` mm along
    /// the passes, where the normal is known. O(points / 64) and the points near the box.
    [[nodiscard]] std::vector<ContactPoint> contacts(const Box2& box, double spacing) const;
    /// The same of one point; not finite where its normal is not known.
    [[nodiscard]] Vec3 contact(PointIndex point) const;

private:
    /// Some consecutive points, swept to the one after the last where there is one.
    struct Section {
        PointIndex first = 0, last = 0;
        std::size_t piece = 0;
        bool goes_on = false;         ///< to point last + 1
        float aside = 0, before = 0;  ///< [mm] half width of the strip, and how far it reaches beyond segments
        Eigen::AlignedBox2f bounds;   ///< [mm] of the strip, relative to the origin
    };
    struct Tile;

    void cut_sections();
    [[nodiscard]] double depth_of(const Section& section) const;
    void measure(Section& section) const;
    void read_swept(const Section& section, std::vector<double> (&axes)[3]) const;
    void lower_by(const Section& section, const Tile& tile) const;
    [[nodiscard]] Eigen::Vector3f normal_of(PointIndex point, PointRange within) const;
    [[nodiscard]] std::vector<std::size_t> sections_in(const Box2& box) const;

    const ClSurface& surface_;
    const Signals& signals_;
    Role surface_role_;
    const Trajectory& swept_;
    CuttingTool tool_;
    std::vector<PointRange> pieces_;  ///< those that are swept
    std::vector<Section> sections_;
    Differentiator smoother_;
    bool smoothed_ = false;
    Box2 bounds_;
    std::string note_;
};

}  // namespace clsurf
