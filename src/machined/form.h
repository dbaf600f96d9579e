#pragma once
// Form: the smooth surface from which deviations of the as-machined surface are measured, because the design
// surface is unknown. It passes through the commanded contact points, except for those that the tool cuts away
// again. Deviations from it are scallops, lags and marks.
//
// At the knots of a grid, one step-over apart, a quadratic is fitted to the contact points within three
// step-overs (tricube weights by distance; two repetitions with bisquare weights, so that one pass that is
// programmed elsewhere does not bend it). Between knots the quadratics blend into each other. Three
// step-overs: a form of 0.1 mm⁻³ (fourth derivative) then gives less than 0.3 µm of error at 0.3 mm, and ten
// would give 30 µm. Where a share of the contact points lies off the quadratic, two sheets that meet at a crease are
// fitted (fold.h). The form is unknown where more than a third of the contact points' weight lies farther
// from the fit than the tolerance, or where the fits of adjacent knots differ by more than twice that; in a valley
// that is tighter than the tool; and farther than 1.1 step-overs from any contact point. Nothing is measured there.

#include <array>
#include <vector>

#include "machined/as_machined_surface.h"

namespace clsurf {

class Form {
public:
    /// For places inside `region`. `tolerance` [mm], normal to the form: how far contact points lie from it where it is
    /// known; half a scallop at least. O(contact points near it + knots), parallel.
    Form(const AsMachinedSurface& as_machined, const Box2& region, double tolerance = 0);

    /// Turns heights of AsMachinedSurface::map(), over `level` [mm], into deviations [mm] along the form's normal, +
    /// outside of it; NaN stays, and becomes what has no form: beyond the outermost contact points, and where the form
    /// is not known. Returns how many heights that were. Parallel.
    std::int64_t subtract(const MapFrame& frame, std::int64_t first_row, double level, std::span<float> z) const;

    /// The form's height [mm] over AsMachinedSurface::level() of the surface that it is made of, and its slopes; NaN: none
    /// there.
    struct Facet {
        double z = 0, zx = 0, zy = 0;
        bool unknown = false;  ///< contact points lie about, but no smooth form goes through them
    };
    [[nodiscard]] Facet at(const Vec2& place) const;

    /// Whether contact points lie about a place on all sides: beyond the outermost pass stands the tool's flank.
    [[nodiscard]] bool is_among_contacts(const Vec2& place) const;

private:
    enum class Kind : std::uint8_t {
        none,     ///< no contact points
        unknown,  ///< there are some, but they have no form
        smooth,
        ridge,
        valley,
    };
    /// a0 + a1 x + a2 y + a3 x² + a4 xy + a5 y², x and y in pitches from the knot.
    using Sheet = std::array<float, 6>;
    struct Knot {
        Sheet one{}, two{};  ///< two: at a crease
        Kind kind = Kind::none;
    };
    struct Height;
    struct Workspace;

    struct Samples;
    [[nodiscard]] Height height_at(const Knot& knot, double x, double y) const;
    void fit(std::int64_t column, std::int64_t row, const Samples& samples, Workspace& workspace);
    /// Whether a place lies where the tool cannot reach the bottom of a valley.
    [[nodiscard]] bool is_below_tool(const Height& one, const Height& two) const;
    /// Whether contact points lie on all sides of a place: beyond the outermost pass stands the tool's flank.
    [[nodiscard]] bool is_inside(const Vec2& place, const Samples& samples) const;

    double level_ = 0;  ///< [mm] from which its heights are counted
    Vec2 corner_ = Vec2::Zero();
    double pitch_ = 1;
    std::int64_t columns_ = 0, rows_ = 0;
    std::vector<Knot> knots_;
    double most_scatter_ = 0;           ///< [mm] along the normal, of contact points about a form
    double reach_ = 0;                  ///< [mm] radius of the tool where it touches, at most
    std::vector<std::uint8_t> inside_;  ///< on a grid four times as fine
};

/// AsMachinedSurface::map() with a form, which may be that of another surface, taken off: deviations [mm]. Returns how many
/// cells were cut where the form is not known.
std::int64_t map_deviation(const AsMachinedSurface& as_machined, const Form& form, const MapFrame& frame,
                           const TakeRows& take);

}  // namespace clsurf
