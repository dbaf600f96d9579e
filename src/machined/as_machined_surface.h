#pragma once
// AsMachinedSurface: the surface after cutting. Its height over each place is the lowest point of the tool outline along the
// whole path (the fourth surface of Wu et al.). Scallops, lags and differences between passes add up as on the part: a pit
// keeps its depth, and neighbours cut a bulge down.
//
// The tool is swept along the straight segments between positions. Positions are smoothed over a stated window inside one
// section, because the rounding of an encoder is not cut. Every segment within a tool radius of a cell counts; segments that
// cannot be the lowest are excluded for a block of cells at a time (swept_pieces.h). Passes are swept, and so are links
// between passes of one cutting run if they stay low (at most a step-over above their ends). Rapids, approaches and high links
// remove no material.
//
// Three axes, tool axis +z. A height map has one height over each place.

#include <functional>
#include <string>
#include <vector>

#include "machined/map_frame.h"
#include "machined/swept_pieces.h"
#include "machined/tool.h"
#include "predictor/programmed_marks.h"
#include "predictor/signals.h"

namespace clsurf {

/// Where the tool touches the part, and the tip of the tool at that time [mm].
struct ContactPoint {
    Vec3 at = Vec3::Zero(), tip = Vec3::Zero();
};

class PassesBetween;

class AsMachinedSurface {
public:
    /// `surface`: the CL surface, gathered from the positions of `surface_role`; with its `signals` (normals) it gives the
    /// contact points. `swept`: the path of the tool, as commanded, feedback or actual positions of the same points. `pieces`
    /// (surface/smoothing_segments.h) bound the smoothing. `marks`: of `surface`; the form excludes them. All must outlive it.
    /// O(points), parallel.
    AsMachinedSurface(const ClSurface& surface, const Signals& signals, Role surface_role, const Trajectory& swept,
                      const std::vector<PointRange>& pieces, const CuttingTool& tool, ProgrammedMarks marks = {});

    /// A twentieth of a step-over [mm]; without neighbours a fiftieth of the tool's radius.
    [[nodiscard]] double usual_cell() const {
        return surface_.step_over > 0 ? surface_.step_over / 20 : tool_.radius / 50;
    }
    /// The box around the contact points [mm], extended by a step-over.
    [[nodiscard]] Box2 bounds() const { return bounds_; }
    /// The level from which heights are counted [mm].
    [[nodiscard]] double level() const { return surface_.positions.origin.z(); }
    [[nodiscard]] const ClSurface& surface() const { return surface_; }
    [[nodiscard]] const CuttingTool& tool() const { return tool_; }
    /// Whether `surface` has the commanded positions.
    [[nodiscard]] bool knows_program() const { return surface_role_ == Role::commanded; }
    /// Whether the tool is swept along the surface's own positions.
    [[nodiscard]] bool follows_surface() const { return swept_.role == surface_role_; }
    /// The window of the smoothing, as text for reports.
    [[nodiscard]] const std::string& note() const { return note_; }

    /// Computes the height map, a row of tiles at a time, from the first row on. Memory: a row of tiles (256 rows of cells) and
    /// a list of sections of the path. The same for any number of threads.
    void map(const MapFrame& frame, const TakeRows& take) const;

    /// The marks of the surface's own positions, which are not part of the form.
    [[nodiscard]] const ProgrammedMarks& marks() const { return marks_; }

    /// The surface's own positions without their marks, with additional passes between adjacent ones, for maps inside a region.
    /// `many`: there will be several maps, so common results are cached.
    [[nodiscard]] PassesBetween passes_between(const Box2& region, bool many = false) const;
    /// The same map for a tool that follows these passes: without scallops and without errors of the machine.
    void map_programmed(const PassesBetween& between, const MapFrame& frame, const TakeRows& take) const;

    /// Contact points [mm] of the surface's own positions without their marks, inside a box, about every `spacing` mm along the
    /// passes, where the normal is known. O(points / 64) and the points near the box.
    [[nodiscard]] std::vector<ContactPoint> contacts(const Box2& box, double spacing) const;
    /// The contact point of one point; not finite if its normal is not known.
    [[nodiscard]] Vec3 contact(PointIndex point) const;
    /// Ranges of consecutive points that include all points with a tip in a box or within `reach` mm of it.
    [[nodiscard]] std::vector<PointRange> points_near(const Box2& box, double reach) const;

private:
    /// Some consecutive points, swept up to the point after the last, if there is one.
    struct Section {
        PointIndex first = 0, last = 0;
        std::size_t piece = 0;
        bool goes_on = false;            ///< to point last + 1
        Eigen::AlignedBox2f tips, cuts;  ///< [mm] relative to the origin: tips, contacts
    };
    /// Adds the pieces of a swept section, in the axes of a frame: from its corner [mm] and from level().
    using Gather = std::function<void(const Section&, const FrameAxes&, SweptPieces&)>;

    void cut_sections();
    void measure_sections();
    /// A box around the sections of a group, before they are measured exactly.
    [[nodiscard]] Eigen::AlignedBox2f rough_box(std::size_t first, std::size_t last) const;
    void measure(Section& section) const;
    void read_swept(const Section& section, std::vector<double> (&axes)[3]) const;
    void add_swept(const Section& section, const FrameAxes& axes, SweptPieces& pieces) const;
    /// `farthest` [mm]: largest distance of the gathered pieces of a section from its tips.
    void map_tiles(const MapFrame& frame, const Gather& gather, double farthest, const TakeRows& take) const;
    [[nodiscard]] std::vector<std::size_t> sections_in(const Box2& box, double reach) const;

    const ClSurface& surface_;
    const Signals& signals_;
    Role surface_role_;
    const Trajectory& swept_;
    CuttingTool tool_;
    ProgrammedMarks marks_;
    std::vector<PointRange> pieces_;  ///< swept pieces of the path
    mutable std::vector<Section> sections_;
    BlockFillPointer measured_;  ///< measures sections when they are requested, if a surface is read in parts
    Differentiator smoother_;
    bool smoothed_ = false;
    Box2 bounds_;
    std::string note_;
};

/// The contact point [mm] of an upright tool at a point of the surface; not finite if its normal is not known.
[[nodiscard]] Vec3 contact_at(const ClSurface& surface, const Signals& signals, const CuttingTool& tool,
                              PointIndex point);

}  // namespace clsurf
