#pragma once
// Form: the surface from which deviations of the as-machined surface are measured, because the design surface is
// unknown. Deviations from it are scallops, lags and marks. There are two ways to it.
//
// The program: what the tool would leave along the programmed passes and seven more between each two of them
// (passes_between.h). It follows creases, fillets, and what the tool cannot reach. Every programmed pass lies on it. For
// a flat tool, whose cusps are not small enough then, it only fills the gaps of the other one.
//
// The contact points: at the knots of a grid, one step-over apart, a quadratic is fitted to the contact points within
// three step-overs, except for those that the tool cuts away again (tricube weights by distance; two repetitions with
// bisquare weights, so that one pass that lies elsewhere does not bend it). Between knots the quadratics blend into each
// other. Three step-overs: a form of 0.1 mm⁻³ (fourth derivative) then gives less than 0.3 µm of error at 0.3 mm, and
// ten would give 30 µm. Where a share of the contact points lies off the quadratic, two sheets that meet at a crease
// are fitted (fold.h). There is no such form where more than a third of the contact points' weight lies farther from the
// fit than the tolerance, or where the fits of adjacent knots differ by more than twice that; in a valley that is
// tighter than the tool; and farther than 1.1 step-overs from any contact point.
//
// Beyond the outermost contact points stands the tool's flank, and there is no form.

#include <array>
#include <memory>
#include <vector>

#include "machined/as_machined_surface.h"

namespace clsurf {

class Form {
public:
    enum class Of : std::uint8_t {
        program,               ///< where the surface is that of commanded positions; else the contacts
        contacts_and_program,  ///< the contacts, and the program where they have no form
        contacts,
    };

    /// For places inside `region`. `tolerance` [mm], normal to a form of the contacts: how far they lie from it; half a
    /// scallop at least. `as_machined` must outlive it. O(points near it + knots), parallel.
    Form(const AsMachinedSurface& as_machined, const Box2& region, Of of = Of::program, double tolerance = 0);
    Form(Form&&) noexcept;
    Form& operator=(Form&&) noexcept;
    ~Form();

    /// Turns heights of AsMachinedSurface::map(), over `level` [mm], into deviations [mm] along the form's normal, +
    /// outside of it; NaN stays, and becomes what has no form: beyond the outermost contact points, and where the form
    /// is not known. Returns how many heights that were. `slopes`, as many as heights or none: the form's along the rows,
    /// where it is known. Parallel.
    std::int64_t subtract(const MapFrame& frame, std::int64_t first_row, double level, std::span<float> z,
                          std::span<float> slopes = {}) const;

    /// The height [mm] of the form of the contacts over AsMachinedSurface::level() of the surface that it is made of, and its slopes;
    /// NaN: none there.
    struct Facet {
        double z = 0, zx = 0, zy = 0;
        bool unknown = false;  ///< contact points lie about, but no smooth form goes through them
    };
    [[nodiscard]] Facet at(const Vec2& place) const;

    /// Whether contact points lie about a place on all sides: beyond the outermost pass stands the tool's flank.
    [[nodiscard]] bool is_among_contacts(const Vec2& place) const;
    /// The same to the last place: is_among_contacts() counts squares of a quarter of a step-over, which may reach as far
    /// beyond the end of a pass, where cusps rise.
    [[nodiscard]] bool is_well_among_contacts(const Vec2& place) const;

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
    /// The programmed surface, as heights [mm] over level_ and slopes, about some rows of a frame.
    struct Programmed;
    [[nodiscard]] Programmed programmed_rows(const MapFrame& frame, std::int64_t first_row, std::int64_t rows) const;
    [[nodiscard]] bool has_gaps(const Box2& box) const;
    [[nodiscard]] Facet blend(const Vec2& place, const Facet& programmed) const;
    void fit_contacts(const AsMachinedSurface& as_machined, const Box2& region);
    void find_contradictions();
    void bridge_contacts(const Box2& region);
    void fit(std::int64_t column, std::int64_t row, const Samples& samples, Workspace& workspace);
    /// Whether a place lies where the tool cannot reach the bottom of a valley.
    [[nodiscard]] bool is_below_tool(const Height& one, const Height& two) const;
    /// Whether contact points lie on all sides of a place: beyond the outermost pass stands the tool's flank.
    [[nodiscard]] bool is_inside(const Vec2& place, const Samples& samples) const;

    const AsMachinedSurface* program_ = nullptr;  ///< nullptr: not followed
    std::unique_ptr<const PassesBetween> between_;
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
