#include "machined/pass_ends.h"

#include <algorithm>
#include <cmath>

#include "machined/local_quadratic.h"

namespace clsurf {
namespace {

constexpr std::int64_t stride = 3;     ///< rows or columns between the cells that are used for the quadratic
constexpr double rounded_by = 0.0003;  ///< [mm] scatter of positions that are rounded to a micrometre; 1 µm/√12

}  // namespace

double cusp_before_contact(const CuttingTool& tool, const Vec2& slope, double apart) {
    const double steep = 1 + slope.squaredNorm();
    const double sine = std::sqrt(slope.squaredNorm() / steep);
    const double circle = tool.radius - tool.corner + tool.corner * sine;
    // Both in units of 1/r. A ball touches a level place with its sphere.
    const double fall = steep;
    const double contour = tool.corner >= tool.radius ? 1 : tool.corner * sine / circle;
    const double aside = (fall - contour) * slope.x() * slope.y();
    const double ahead = fall * slope.x() * slope.x() + contour * slope.y() * slope.y();
    const double most = std::sqrt(tool.radius * apart);
    return ahead > 0 ? std::min(most, 0.5 * apart * std::abs(aside) / ahead) : 0;
}

BeforePassEnds::BeforePassEnds(const Form& form, const CuttingTool& tool, double apart, const MapFrame& frame,
                               std::span<const float> heights)
    : form_(&form) {
    // The contact of a sharp edge jumps near the end of a pass. A wider margin would exclude steps of the surface, and
    // measurements show no higher cusps there.
    if (tool.corner <= 0) return;
    const Vec2 middle =
        frame.at(0.5 * static_cast<double>(frame.columns - 1), 0.5 * static_cast<double>(frame.rows - 1));
    LocalQuadratic quadratic;
    for (std::int64_t row = 0; row < frame.rows; row += stride) {
        for (std::int64_t column = 0; column < frame.columns; column += stride) {
            const float z = heights[static_cast<std::size_t>(row * frame.columns + column)];
            const Vec2 place = frame.at(static_cast<double>(column), static_cast<double>(row));
            // Beyond the outermost contacts, the heights are those of the tool's flank.
            if (!std::isfinite(z) || !form.is_among_contacts(place)) continue;
            const Vec2 off = (place - middle) / apart;
            quadratic.add(off.dot(frame.along), off.dot(frame.across()), z, 1);
        }
    }
    if (quadratic.size() < 6) return;
    const LocalQuadratic::Terms terms = quadratic.fit(rounded_by);
    if (!terms.allFinite()) return;
    // The largest distance in the window is used for all of it. A varying distance would exclude parts of scallops, and Sa
    // would be wrong.
    double before = 0;
    for (const double column : {0.0, 0.5, 1.0}) {
        for (const double row : {0.0, 0.5, 1.0}) {
            const Vec2 off =
                (frame.at(column * static_cast<double>(frame.columns - 1), row * static_cast<double>(frame.rows - 1)) -
                 middle) /
                apart;
            const double u = off.dot(frame.along), v = off.dot(frame.across());
            const Vec2 slope =
                Vec2(terms[1] + 2 * terms[3] * u + terms[4] * v, terms[2] + terms[4] * u + 2 * terms[5] * v) / apart;
            before = std::max(before, cusp_before_contact(tool, slope, apart));
        }
    }
    before_ = before * frame.along;
}

bool BeforePassEnds::has(const Vec2& place) const {
    return form_->is_well_among_contacts(place) && form_->is_well_among_contacts(place + before_) &&
           form_->is_well_among_contacts(place - before_);
}

}  // namespace clsurf
