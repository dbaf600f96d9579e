#pragma once
// Form: the surface from which deviations of the as-machined surface are measured, because the design surface is not known.
// Deviations from it are scallops, lags and marks. It has two sources.
//
// The program: the surface that the tool would leave along the programmed passes and seven additional passes between each two
// of them (passes_between.h). It follows creases, fillets, and the limits of what the tool can reach. Every programmed pass is
// on it. A flat tool leaves cusps that are not small enough, so its program only fills the gaps of the other source.
//
// The contact points: at the knots of a grid, one step-over apart, a quadratic is fitted to the contact points within three
// step-overs, except for those that the tool cuts away again. Weights are tricube by distance, with two repetitions with
// bisquare weights, so that one displaced pass does not bend the form. Between knots the quadratics are blended. Why three
// step-overs: with a fourth derivative of 0.1 mm⁻³, the error is less than 0.3 µm at 0.3 mm, and with ten step-overs it would
// be 30 µm. If a share of the contact points is off the quadratic, two sheets that meet at a crease are fitted (fold.h). There
// is no such form if more than a third of the weight of the contact points is farther from the fit than the tolerance, or if
// the fits of adjacent knots differ by more than twice that; in a valley that is tighter than the tool; and farther than 1.1
// step-overs from any contact point.
//
// Beyond the outermost contact points there is only the flank of the tool, and no form.

#include <array>
#include <memory>
#include <vector>

#include "machined/as_machined_surface.h"

namespace clsurf {

class Form {
public:
    enum class Of : std::uint8_t {
        program,               ///< only with commanded positions; otherwise the contacts are used
        contacts_and_program,  ///< the contacts, and the program where they have no form
        contacts,
    };

    /// For places inside `region`. `tolerance` [mm]: largest distance of contact points from a form of the contacts, along its
    /// normal; at least half a scallop is used. `as_machined` must outlive it. O(points near it + knots), parallel.
    Form(const AsMachinedSurface& as_machined, const Box2& region, Of of = Of::program, double tolerance = 0);
    Form(Form&&) noexcept;
    Form& operator=(Form&&) noexcept;
    ~Form();

    /// Turns heights of AsMachinedSurface::map(), above `level` [mm], into deviations [mm] along the normal of the form, +
    /// outside of it. NaN stays NaN, and heights without a form become NaN: beyond the outermost contact points, and where the
    /// form is not known. Returns the number of the latter. `slopes`, as many as heights or none: slopes of the form along the
    /// rows, where it is known. Parallel.
    std::int64_t subtract(const MapFrame& frame, std::int64_t first_row, double level, std::span<float> z,
                          std::span<float> slopes = {}) const;

    /// The height [mm] of a form of the contacts above AsMachinedSurface::level() of its surface, and its slopes; NaN: none
    /// there.
    struct Facet {
        double z = 0, zx = 0, zy = 0;
        bool unknown = false;  ///< contact points are near, but no smooth form fits them
    };
    [[nodiscard]] Facet at(const Vec2& place) const;

    /// Whether contact points are on all sides of a place. Beyond the outermost pass there is only the flank of the tool.
    [[nodiscard]] bool is_among_contacts(const Vec2& place) const;
    /// Stricter than is_among_contacts(), whose squares of a quarter of a step-over may extend by as much beyond the end of a
    /// pass, where cusps are higher.
    [[nodiscard]] bool is_well_among_contacts(const Vec2& place) const;

private:
    enum class Kind : std::uint8_t {
        none,     ///< no contact points
        unknown,  ///< there are contacts, but they have no form
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
    /// The programmed surface around some rows of a frame, as heights [mm] above level_ and slopes.
    struct Programmed;
    [[nodiscard]] Programmed programmed_rows(const MapFrame& frame, std::int64_t first_row, std::int64_t rows) const;
    [[nodiscard]] bool has_gaps(const Box2& box) const;
    [[nodiscard]] Facet blend(const Vec2& place, const Facet& programmed) const;
    void fit_contacts(const AsMachinedSurface& as_machined, const Box2& region);
    void find_contradictions();
    void bridge_contacts(const Box2& region);
    void fit(std::int64_t column, std::int64_t row, const Samples& samples, Workspace& workspace);
    /// Whether a place is in a valley whose bottom the tool cannot reach.
    [[nodiscard]] bool is_below_tool(const Height& one, const Height& two) const;
    /// Whether contact points are on all sides of a place. Beyond the outermost pass there is only the flank of the tool.
    [[nodiscard]] bool is_inside(const Vec2& place, const Samples& samples) const;

    const AsMachinedSurface* program_ = nullptr;  ///< nullptr: the program is not used
    std::unique_ptr<const PassesBetween> between_;
    double level_ = 0;  ///< [mm] level from which its heights are counted
    Vec2 corner_ = Vec2::Zero();
    double pitch_ = 1;
    std::int64_t columns_ = 0, rows_ = 0;
    std::vector<Knot> knots_;
    double most_scatter_ = 0;           ///< [mm] largest distance of contact points from a form, along the normal
    double reach_ = 0;                  ///< [mm] largest radius of the tool where it touches
    std::vector<std::uint8_t> inside_;  ///< is_inside() on a grid four times as fine
};

/// AsMachinedSurface::map() minus a form, which may be that of another surface: deviations [mm]. Returns the number of cut
/// cells where the form is not known.
std::int64_t map_deviation(const AsMachinedSurface& as_machined, const Form& form, const MapFrame& frame,
                           const TakeRows& take);

}  // namespace clsurf
