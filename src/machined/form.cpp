#include "machined/form.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

#include "core/grouping.h"
#include "core/not_finite.h"
#include "core/parallel.h"
#include "machined/between_contacts.h"
#include "machined/fold.h"
#include "machined/passes_between.h"
#include "machined/ungouged_contacts.h"

namespace clsurf {
namespace {

// fit_reach, least_scatter, knots_differ, scallop_share, most_off, crease_off, fold_off, fold_gain, sharp_edge, covered:
// docs/formed.md#definitions.
constexpr double fit_reach = 3;          ///< step-overs: radius around a knot for the fitted places
constexpr double least_spread = 0.0003;  ///< [mm] spread that rounding to a micrometre leaves; 1 µm/√12
constexpr double least_scatter = 0.001;  ///< [mm] tolerance for contact points of a smooth form …
constexpr double knots_differ = 2;       ///< most_scatter_ between fits of neighbouring knots at one place
constexpr double scallop_share = 0.5;    ///< … or this share of a scallop, if larger
constexpr double most_off = 1.0 / 3;     ///< share of the contact points' weight that may be off a smooth form
constexpr double crease_off = 0.06;      ///< share off a smooth form that starts the search for a crease …
constexpr double fold_off = 0.2;         ///< … and largest share off its two sheets
constexpr double fold_gain = 0.5;        ///< two sheets must leave less than this part of the share off a smooth form

constexpr double sharp_edge = 2;   ///< step-overs: least corner radius of a tool whose scallops are flat arcs
constexpr double covered = 1.1;    ///< step-overs from the nearest contact point in space; beyond, no pass has cut
                                   ///< the surface: half is usual, and one if a pass is missing
constexpr std::int64_t finer = 4;  ///< squares per side of a knot's square, each inside or outside
constexpr double sample_spacing = 0.25;  ///< step-overs along the passes
constexpr double on_line = 0.15;         ///< step-overs: places this near to a contact point are inside
constexpr double opposite = -0.9;        ///< cosine that puts a point on the other side of the nearest one: along
                                         ///< an outermost pass, points to both sides of the nearest one do not count

}  // namespace

/// Contact points by squares of the knots' pitch.
struct Form::Samples {
    std::vector<Vec3> points;        ///< sorted by square
    std::vector<std::size_t> start;  ///< of each square
    std::int64_t columns = 0, rows = 0;
    double level = 0;

    /// Calls f(point) for the points in the squares around a square.
    template <typename F>
    void for_each_near(std::int64_t column, std::int64_t row, std::int64_t squares, F&& f) const {
        const auto always = [&](const Vec3& p) {
            f(p);
            return true;
        };
        for (std::int64_t r = row - squares; r <= row + squares; ++r)
            (void)for_each_in_run(r, column - squares, column + squares, always);
    }

    /// Calls f(point) for the points in squares `ring` squares away, until it returns false. Returns whether it never did.
    template <typename F>
    [[nodiscard]] bool for_each_in_ring(std::int64_t column, std::int64_t row, std::int64_t ring, F&& f) const {
        for (std::int64_t r = row - ring; r <= row + ring; ++r) {
            const bool whole = std::abs(r - row) == ring;
            if (!for_each_in_run(r, column - ring, whole ? column + ring : column - ring, f)) return false;
            if (!whole && !for_each_in_run(r, column + ring, column + ring, f)) return false;
        }
        return true;
    }

private:
    template <typename F>
    [[nodiscard]] bool for_each_in_run(std::int64_t row, std::int64_t from, std::int64_t to, F&& f) const {
        from = std::max<std::int64_t>(0, from);
        to = std::min(columns - 1, to);
        if (row < 0 || row >= rows || from > to) return true;
        const std::size_t end = start[static_cast<std::size_t>(row * columns + to) + 1];
        for (std::size_t k = start[static_cast<std::size_t>(row * columns + from)]; k < end; ++k) {
            if (!f(points[k])) return false;
        }
        return true;
    }
};

/// Height of a sheet at a place [mm], and its slopes per pitch.
struct Form::Height {
    double z = 0, zx = 0, zy = 0;
    bool reached = true;  ///< the tool reaches it
};

struct Form::Workspace {
    LocalQuadratic quadratic;
    std::vector<WeighedPlace> places;
};

Form::Form(const AsMachinedSurface& as_machined, const Box2& region, Of of, double tolerance)
    : level_(as_machined.level()),
      pitch_(as_machined.surface().step_over > 0 ? as_machined.surface().step_over : 10 * as_machined.usual_cell()),
      // Estimated by the formula for flat surfaces with the tool's radius.
      most_scatter_(
          std::max({least_scatter, tolerance, scallop_share * pitch_ * pitch_ / (8 * as_machined.tool().radius)})),
      reach_(as_machined.tool().radius) {
    if (region.isEmpty()) return;
    corner_ = region.min() - Vec2::Constant(pitch_);
    columns_ = static_cast<std::int64_t>(std::ceil(region.sizes().x() / pitch_)) + 3;
    rows_ = static_cast<std::int64_t>(std::ceil(region.sizes().y() / pitch_)) + 3;
    knots_.resize(static_cast<std::size_t>(columns_ * rows_));
    inside_.resize(static_cast<std::size_t>(finer * columns_ * finer * rows_));
    if (of != Of::contacts && as_machined.knows_program()) program_ = &as_machined;
    // With a nearly sharp edge, additional passes leave cusps that are not much lower.
    if (of == Of::program && as_machined.tool().corner < sharp_edge * pitch_) of = Of::contacts_and_program;
    if (of != Of::program || program_ == nullptr) fit_contacts(as_machined, region);
    if (program_ == nullptr) return;
    if (of == Of::program) {
        for (Knot& knot : knots_) knot.kind = Kind::unknown;
    } else {
        find_contradictions();
    }
    // Slopes also need places next to the region.
    const Vec2 room = Vec2::Constant(2 * as_machined.usual_cell());
    between_ = std::make_unique<PassesBetween>(
        as_machined.passes_between(Box2(region.min() - room, region.max() + room), of == Of::program));
    bridge_contacts(region);
}

Form::Form(Form&&) noexcept = default;
Form& Form::operator=(Form&&) noexcept = default;
Form::~Form() = default;

void Form::fit_contacts(const AsMachinedSurface& as_machined, const Box2& region) {
    Box2 wide = region;
    const Vec2 room = Vec2::Constant((fit_reach + 1) * pitch_);
    wide.extend(Vec2(region.min() - room));
    wide.extend(Vec2(region.max() + room));
    std::vector<Vec3> found = ungouged_contacts(as_machined, wide, sample_spacing * pitch_);
    Samples samples;
    samples.level = level_;
    samples.columns = columns_;
    samples.rows = rows_;
    // Points outside the grid belong to its outermost squares.
    const auto square = [&](const Vec3& p) {
        const auto c = std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor((p.x() - corner_.x()) / pitch_)),
                                                0, columns_ - 1);
        const auto r = std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor((p.y() - corner_.y()) / pitch_)),
                                                0, rows_ - 1);
        return static_cast<std::size_t>(r * columns_ + c);
    };
    Grouping by_square = group_numbers(found.size(), static_cast<std::size_t>(columns_ * rows_),
                                       [&](std::size_t k) { return square(found[k]); });
    samples.start = std::move(by_square.start);
    samples.points.reserve(found.size());
    for (const std::uint32_t k : by_square.order) samples.points.push_back(found[k]);
    found = {};
    parallel_for(columns_ * rows_, 64, [&](std::int64_t first, std::int64_t last) {
        Workspace workspace;
        for (std::int64_t k = first; k < last; ++k) fit(k % columns_, k / columns_, samples, workspace);
    });
    const std::int64_t fine_columns = finer * columns_;
    parallel_for(static_cast<std::int64_t>(inside_.size()), 1024, [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t k = first; k < last; ++k) {
            const std::int64_t column = k % fine_columns;
            const std::int64_t row = k / fine_columns;
            const Vec2 off(static_cast<double>(column), static_cast<double>(row));
            inside_[static_cast<std::size_t>(k)] =
                is_inside(corner_ + pitch_ / finer * (off + Vec2::Constant(0.5)), samples) ? 1 : 0;
        }
    });
}

/// Knots whose fits differ from each other in a square have no smooth form.
void Form::find_contradictions() {
    std::vector<std::uint8_t> contradicted(knots_.size());
    for (std::int64_t row = 0; row + 1 < rows_; ++row) {
        for (std::int64_t column = 0; column + 1 < columns_; ++column) {
            double low = std::numeric_limits<double>::infinity();
            double high = -low;
            double steepest = 0;
            for (int k = 0; k < 4; ++k) {
                const int right = k % 2;
                const int up = k / 2;
                const Knot& knot = knots_[static_cast<std::size_t>((row + up) * columns_ + column + right)];
                if (knot.kind == Kind::none || knot.kind == Kind::unknown) continue;
                const Height height = height_at(knot, 0.5 - right, 0.5 - up);
                low = std::min(low, height.z);
                high = std::max(high, height.z);
                steepest = std::max(steepest, std::hypot(height.zx, height.zy) / pitch_);
            }
            if (!(high - low > knots_differ * most_scatter_ * std::sqrt(1 + steepest * steepest))) continue;
            for (int k = 0; k < 4; ++k)
                contradicted[static_cast<std::size_t>((row + k / 2) * columns_ + column + k % 2)] = 1;
        }
    }
    for (std::size_t k = 0; k < knots_.size(); ++k) {
        if (contradicted[k] != 0 && knots_[k].kind != Kind::none) knots_[k].kind = Kind::unknown;
    }
}

void Form::bridge_contacts(const Box2& region) {
    const double fine = pitch_ / finer;
    for_each_between_contacts(*program_, region, 0.5 * fine, [&](const Vec2& place) {
        const Vec2 at = (place - corner_) / fine;
        if (!(at.x() >= 0 && at.y() >= 0 && at.x() < static_cast<double>(finer * columns_) &&
              at.y() < static_cast<double>(finer * rows_)))
            return;
        inside_[static_cast<std::size_t>(static_cast<std::int64_t>(at.y()) * finer * columns_ +
                                         static_cast<std::int64_t>(at.x()))] = 1;
    });
}

bool Form::is_inside(const Vec2& place, const Samples& samples) const {
    double nearest = std::numeric_limits<double>::infinity();
    Vec2 offset = Vec2::Zero();
    const Vec2 at = (place - corner_) / pitch_;
    const auto column = static_cast<std::int64_t>(at.x());
    const auto row = static_cast<std::int64_t>(at.y());
    constexpr auto rings = static_cast<std::int64_t>(fit_reach);
    for (std::int64_t ring = 0; ring <= rings; ++ring) {
        (void)samples.for_each_in_ring(column, row, ring, [&](const Vec3& p) {
            const Vec2 off = p.head<2>() - place;
            if (off.squaredNorm() >= nearest) return true;
            nearest = off.squaredNorm();
            offset = off;
            return true;
        });
        // Points in the rings beyond are farther away.
        if (std::sqrt(nearest) <= static_cast<double>(ring) * pitch_) break;
    }
    if (!(nearest <= covered * covered * pitch_ * pitch_)) return false;
    if (std::sqrt(nearest) < on_line * pitch_) return true;
    for (std::int64_t ring = 0; ring <= rings; ++ring) {
        const bool one_sided = samples.for_each_in_ring(column, row, ring, [&](const Vec3& p) {
            const Vec2 off = p.head<2>() - place;
            return !(off.dot(offset) < opposite * off.norm() * offset.norm());
        });
        if (!one_sided) return true;
    }
    return false;
}

void Form::fit(std::int64_t column, std::int64_t row, const Samples& samples, Workspace& workspace) {
    Knot& knot = knots_[static_cast<std::size_t>(row * columns_ + column)];
    const Vec2 here = corner_ + pitch_ * Vec2(static_cast<double>(column), static_cast<double>(row));
    constexpr std::int64_t squares =
        static_cast<std::int64_t>(fit_reach) + 1;  // a knot is at the corner of four squares
    double nearest = std::numeric_limits<double>::infinity();
    double base = 0;
    samples.for_each_near(column, row, squares, [&](const Vec3& p) {
        const double d = (p.head<2>() - here).squaredNorm();
        if (d >= nearest) return;
        nearest = d;
        base = p.z();
    });
    if (!(nearest <= 4 * pitch_ * pitch_)) return;
    std::vector<WeighedPlace>& places = workspace.places;
    LocalQuadratic& quadratic = workspace.quadratic;
    places.clear();
    quadratic.clear();
    samples.for_each_near(column, row, squares, [&](const Vec3& p) {
        const Vec2 off = (p.head<2>() - here) / pitch_;
        const double rise = (p.z() - base) / pitch_;
        const double d = std::sqrt(off.squaredNorm() + rise * rise) / fit_reach;
        if (d >= 1) return;
        const double tricube = 1 - d * d * d;
        places.push_back({off.x(), off.y(), p.z() - base, tricube * tricube * tricube});
        quadratic.add(off.x(), off.y(), p.z() - base, places.back().weight);
    });
    if (places.size() < 6) return;
    const LocalQuadratic::Terms smooth = quadratic.fit(least_spread);
    if (!smooth.allFinite()) return;
    const double most = most_scatter_ * std::sqrt(1 + smooth.segment<2>(1).squaredNorm() / (pitch_ * pitch_));
    const double off = share_off(places, most, [&](double x, double y) { return value_of(smooth, x, y); });
    const auto keep = [&](Sheet& sheet, const LocalQuadratic::Terms& terms) {
        for (std::size_t k = 0; k < 6; ++k) sheet[k] = static_cast<float>(terms[static_cast<Eigen::Index>(k)]);
        sheet[0] += static_cast<float>(base - samples.level);
    };
    knot.kind = off > most_off ? Kind::unknown : Kind::smooth;
    keep(knot.one, smooth);
    if (off <= crease_off) return;
    const std::optional<Fold> fold = fit_fold(places, smooth, most, least_spread, quadratic);
    if (!fold) return;
    const double off_fold = share_off(places, most, [&](double x, double y) { return fold->at(x, y); });
    if (off_fold > std::min(fold_off, fold_gain * off)) return;
    knot.kind = fold->ridge ? Kind::ridge : Kind::valley;
    keep(knot.one, fold->one);
    keep(knot.two, fold->two);
}

bool Form::is_below_tool(const Height& one, const Height& two) const {
    // If the sheets are planes, a ball on both touches each where the normal from its centre meets it.
    const Vec2 slope_one = Vec2(one.zx, one.zy) / pitch_;
    const Vec2 slope_two = Vec2(two.zx, two.zy) / pitch_;
    const double bend = (slope_one - slope_two).norm();
    if (bend < 1e-6) return false;
    const Vec2 across = (slope_one - slope_two) / bend;
    const double long_one = std::sqrt(1 + slope_one.squaredNorm());
    const double long_two = std::sqrt(1 + slope_two.squaredNorm());
    const double from_centre = (one.z - two.z + reach_ * (long_one - long_two)) / bend;
    const auto [first, last] =
        std::minmax({reach_ * across.dot(slope_one) / long_one, reach_ * across.dot(slope_two) / long_two});
    return from_centre > first && from_centre < last;
}

Form::Height Form::height_at(const Knot& knot, double x, double y) const {
    const auto of = [&](const Sheet& a) {
        return Height{a[0] + a[1] * x + a[2] * y + a[3] * x * x + a[4] * x * y + a[5] * y * y,
                      a[1] + 2 * a[3] * x + a[4] * y, a[2] + a[4] * x + 2 * a[5] * y};
    };
    const Height one = of(knot.one);
    if (knot.kind == Kind::smooth) return one;
    const Height two = of(knot.two);
    const bool ridge = knot.kind == Kind::ridge;
    Height height = (one.z <= two.z) == ridge ? one : two;
    height.reached = ridge || !is_below_tool(one, two);
    return height;
}

bool Form::is_among_contacts(const Vec2& place) const {
    const double u = (place.x() - corner_.x()) / pitch_;
    const double v = (place.y() - corner_.y()) / pitch_;
    const bool on_grid =
        u >= 0 && v >= 0 && u < static_cast<double>(columns_ - 1) && v < static_cast<double>(rows_ - 1);
    return on_grid && inside_[static_cast<std::size_t>(static_cast<std::int64_t>(v * finer) * finer * columns_ +
                                                       static_cast<std::int64_t>(u * finer))] != 0;
}

bool Form::is_well_among_contacts(const Vec2& place) const {
    const double square = pitch_ / finer;
    for (const double x : {-square, 0.0, square}) {
        for (const double y : {-square, 0.0, square}) {
            if (!is_among_contacts(place + Vec2(x, y))) return false;
        }
    }
    return true;
}

Form::Facet Form::at(const Vec2& place) const {
    return blend(place, {missing<double>, missing<double>, missing<double>, true});
}

/// Blends the sheets of the knots around a place, with the programmed surface for knots that have none.
Form::Facet Form::blend(const Vec2& place, const Facet& programmed) const {
    Facet sum;
    if (!is_among_contacts(place)) {
        sum.z = sum.zx = sum.zy = missing<double>;
        return sum;
    }
    const double u = (place.x() - corner_.x()) / pitch_;
    const double v = (place.y() - corner_.y()) / pitch_;
    const auto c = static_cast<std::int64_t>(std::floor(u));
    const auto r = static_cast<std::int64_t>(std::floor(v));
    const bool follows_program = std::isfinite(programmed.z);
    double weights = 0;
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -lowest;
    for (int k = 0; k < 4; ++k) {
        const std::int64_t kc = c + k % 2;
        const std::int64_t kr = r + k / 2;
        const Knot& knot = knots_[static_cast<std::size_t>(kr * columns_ + kc)];
        const double x = u - static_cast<double>(kc);
        const double y = v - static_cast<double>(kr);
        const bool fitted = knot.kind != Kind::none && knot.kind != Kind::unknown;
        Height height = fitted ? height_at(knot, x, y) : Height{};
        if (follows_program && !(fitted && height.reached))
            height = {programmed.z, programmed.zx * pitch_, programmed.zy * pitch_};
        else if (!fitted || !height.reached)
            sum.unknown = sum.unknown || knot.kind != Kind::none;
        if (!fitted && !follows_program) continue;
        const double w = (1 - std::abs(x)) * (1 - std::abs(y));
        weights += w;
        sum.z += w * height.z;
        lowest = std::min(lowest, height.z);
        highest = std::max(highest, height.z);
        sum.zx += w * height.zx;
        sum.zy += w * height.zy;
    }
    sum.z /= weights;
    sum.zx /= weights * pitch_;
    sum.zy /= weights * pitch_;
    const double steep = std::sqrt(1 + sum.zx * sum.zx + sum.zy * sum.zy);
    if (program_ == nullptr) sum.unknown = sum.unknown || highest - lowest > knots_differ * most_scatter_ * steep;
    if (sum.unknown || !(weights > 0)) sum.z = sum.zx = sum.zy = missing<double>;
    return sum;
}

/// Whether a place of a box is near a knot without a smooth form, or in a valley.
bool Form::has_gaps(const Box2& box) const {
    const auto clamped = [&](const Vec2& place, std::int64_t more) {
        const Vec2 at = (place - corner_) / pitch_;
        return std::pair(std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor(at.x())) + more, 0, columns_),
                         std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor(at.y())) + more, 0, rows_));
    };
    const auto [first_column, first_row] = clamped(box.min(), 0);
    const auto [end_column, end_row] = clamped(box.max(), 2);
    for (std::int64_t row = first_row; row < end_row; ++row) {
        for (std::int64_t column = first_column; column < end_column; ++column) {
            const Kind kind = knots_[static_cast<std::size_t>(row * columns_ + column)].kind;
            if (kind != Kind::smooth && kind != Kind::ridge) return true;
        }
    }
    return false;
}

/// Rows of a frame with a margin on every side, from which slopes are computed.
struct Form::Programmed {
    std::int64_t columns = 0, margin = 0, row_margin = 0;
    double reach = 0;  ///< [mm] distance from a place to the two places that give its slope
    Vec2 along = Vec2::UnitX(), across = Vec2::UnitY();
    std::vector<float> z;

    [[nodiscard]] Facet at(std::int64_t column, std::int64_t row) const {
        if (z.empty()) return {missing<double>, missing<double>, missing<double>, true};
        const auto value = [&](std::int64_t c, std::int64_t r) {
            return static_cast<double>(z[static_cast<std::size_t>((r + row_margin) * columns + c + margin)]);
        };
        const double here = value(column, row);
        const auto slope = [&](double before, double after) {
            if (std::isfinite(before) && std::isfinite(after)) return (after - before) / (2 * reach);
            if (std::isfinite(after)) return (after - here) / reach;
            return std::isfinite(before) ? (here - before) / reach : 0.0;
        };
        const Vec2 slopes = slope(value(column - margin, row), value(column + margin, row)) * along +
                            slope(value(column, row - row_margin), value(column, row + row_margin)) * across;
        return {here, slopes.x(), slopes.y(), false};
    }
};

Form::Programmed Form::programmed_rows(const MapFrame& frame, std::int64_t first_row, std::int64_t rows) const {
    Programmed p;
    if (program_ == nullptr || !has_gaps(frame.bounds(0, first_row, frame.columns, rows))) return p;
    // Heights are floats, so slopes between places that are too close would consist of rounding errors.
    p.margin = std::max<std::int64_t>(1, std::lround(program_->usual_cell() / frame.cell));
    p.reach = static_cast<double>(p.margin) * frame.cell;
    p.columns = frame.columns + 2 * p.margin;
    p.along = frame.along;
    p.across = frame.across();
    // If there is a single row, the rows next to it are farther apart than its cells.
    const bool single = rows == 1;
    p.row_margin = single ? 1 : p.margin;
    const double pitch = single ? p.reach : frame.pitch_of_rows();
    MapFrame wide{frame.at(-static_cast<double>(p.margin), static_cast<double>(first_row)),
                  frame.along,
                  frame.cell,
                  p.columns,
                  rows + 2 * p.row_margin,
                  pitch};
    wide.corner -= static_cast<double>(p.row_margin) * pitch * p.across;
    program_->map_programmed(*between_, wide, [&](std::int64_t, std::span<float> heights) {
        p.z.insert(p.z.end(), heights.begin(), heights.end());
    });
    return p;
}

std::int64_t Form::subtract(const MapFrame& frame, std::int64_t first_row, double level, std::span<float> z,
                            std::span<float> slopes) const {
    const double shift = level - level_;
    std::atomic<std::int64_t> unknown = 0;
    const auto count = static_cast<std::int64_t>(z.size());
    const Programmed programmed = programmed_rows(frame, first_row, count / frame.columns);
    // A size of portions for threads; results do not depend on it.
    constexpr std::int64_t grain = 4096;
    parallel_for(count, grain, [&](std::int64_t first, std::int64_t last) {
        std::int64_t here = 0;
        for (std::int64_t k = first; k < last; ++k) {
            float& height = z[static_cast<std::size_t>(k)];
            if (!(height == height)) continue;
            const std::int64_t column = k % frame.columns;
            const std::int64_t row = k / frame.columns;
            const Facet form = blend(frame.at(static_cast<double>(column), static_cast<double>(first_row + row)),
                                     programmed.at(column, row));
            height =
                static_cast<float>((height + shift - form.z) / std::sqrt(1 + form.zx * form.zx + form.zy * form.zy));
            if (!slopes.empty())
                slopes[static_cast<std::size_t>(k)] =
                    static_cast<float>(form.zx * frame.along.x() + form.zy * frame.along.y());
            here += form.unknown ? 1 : 0;
        }
        unknown += here;
    });
    return unknown;
}

std::int64_t map_deviation(const AsMachinedSurface& as_machined, const Form& form, const MapFrame& frame,
                           const TakeRows& take) {
    std::int64_t unknown = 0;
    as_machined.map(frame, [&](std::int64_t first_row, std::span<float> z) {
        unknown += form.subtract(frame, first_row, as_machined.level(), z);
        take(first_row, z);
    });
    return unknown;
}

}  // namespace clsurf
