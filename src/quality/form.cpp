#include "quality/form.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

#include "core/parallel.h"
#include "core/statistics.h"
#include "quality/contact.h"

namespace clsurf {
namespace {

constexpr double reach = 3;              ///< step-overs round a knot that its fit looks at
constexpr int fits = 3;                  ///< the first and two with weights by what it left
constexpr double bisquare = 4.685;       ///< robust standard deviations at which a point weighs nothing
constexpr double least_spread = 0.0003;  ///< [mm] what rounding to a micrometre leaves
constexpr double stiffness = 1e-6;       ///< of what the points do not tell, a single pass's slope across
constexpr float none = std::numeric_limits<float>::quiet_NaN();

constexpr double tips_aside = 12;        ///< tips that are looked at from a contact point to the tool's radius
constexpr double cut_away = 0.02;        ///< [mm] by which a contact point lies inside the tool elsewhere: chords and
                                         ///< uneven passes are shallower

constexpr std::int64_t finer = 4;        ///< squares of a knot's, a side, that lie inside or not
constexpr double sample_spacing = 0.25;  ///< step-overs along the passes
constexpr double on_line = 0.15;         ///< step-overs: so near to a contact point is inside
constexpr double opposite = -0.9;        ///< cosine to the nearest contact point of what lies on the other side: along
                                         ///< an outermost pass, points to both sides of the nearest one do not count

using Terms = Eigen::Matrix<double, 6, 1>;

Terms terms(double x, double y) {
    Terms t;
    t << 1, x, y, x * x, x * y, y * y;
    return t;
}

/// The contact points in a region that the tool leaves standing: where a form is hollower than the tool,
/// it cuts away on one pass what it touched on another, and the surface is lower there. Tips are looked
/// at one per square of a grid, which misses shallow cuts and finds none that is not there.
std::vector<Vec3> standing_contacts(const FormedSurface& formed, const Box2& region, double spacing) {
    const CuttingTool& tool = formed.tool();
    Box2 wide = region;
    wide.extend(Vec2(region.min() - Vec2::Constant(2 * tool.radius)));
    wide.extend(Vec2(region.max() + Vec2::Constant(2 * tool.radius)));
    const std::vector<ContactPoint> found = formed.contacts(wide, spacing);
    const double square = std::max(2 * spacing, tool.radius / tips_aside);
    const Vec2 corner = wide.min() - Vec2::Constant(tool.radius);
    const auto columns = static_cast<std::int64_t>((wide.sizes().x() + 2 * tool.radius) / square) + 1;
    const auto rows = static_cast<std::int64_t>((wide.sizes().y() + 2 * tool.radius) / square) + 1;
    std::vector<std::int32_t> tip_of(static_cast<std::size_t>(columns * rows), -1);
    for (std::size_t k = 0; k < found.size(); ++k) {
        const Vec2 at = (found[k].tip.head<2>() - corner) / square;
        std::int32_t& tip = tip_of[static_cast<std::size_t>(static_cast<std::int64_t>(at.y()) * columns + static_cast<std::int64_t>(at.x()))];
        if (tip < 0 || found[k].tip.z() < found[static_cast<std::size_t>(tip)].tip.z()) tip = static_cast<std::int32_t>(k);
    }
    const auto stands = [&](const Vec3& place) {
        const auto first = [&](double at) { return std::max<std::int64_t>(0, static_cast<std::int64_t>((at - tool.radius) / square)); };
        const auto last = [&](double at, std::int64_t count) { return std::min(count - 1, static_cast<std::int64_t>((at + tool.radius) / square)); };
        const Vec2 at = place.head<2>() - corner;
        for (std::int64_t r = first(at.y()); r <= last(at.y(), rows); ++r) {
            for (std::int64_t c = first(at.x()); c <= last(at.x(), columns); ++c) {
                const std::int32_t tip = tip_of[static_cast<std::size_t>(r * columns + c)];
                if (tip >= 0 && depth_inside(tool, place - found[static_cast<std::size_t>(tip)].tip) > cut_away) return false;
            }
        }
        return true;
    };
    std::vector<std::uint8_t> keep(found.size());
    parallel_for(static_cast<std::int64_t>(found.size()), 1024, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t k = begin; k < end; ++k) {
            const Vec3& at = found[static_cast<std::size_t>(k)].at;
            keep[static_cast<std::size_t>(k)] = region.contains(at.head<2>()) && stands(at) ? 1 : 0;
        }
    });
    std::vector<Vec3> standing;
    for (std::size_t k = 0; k < found.size(); ++k) {
        if (keep[k] != 0) standing.push_back(found[k].at);
    }
    return standing;
}

}  // namespace

/// Contact points by squares of the knots' pitch.
struct Form::Samples {
    std::vector<Vec3> points;          ///< sorted by square
    std::vector<std::size_t> start;    ///< of each square
    std::int64_t columns = 0, rows = 0;
    double level = 0;

    /// f(point) for those in the squares about a square, until it returns false.
    template <typename F>
    void for_each_near(std::int64_t column, std::int64_t row, std::int64_t squares, F&& f) const {
        const std::int64_t from = std::clamp<std::int64_t>(column - squares, 0, columns - 1);
        const std::int64_t to = std::clamp<std::int64_t>(column + squares, 0, columns - 1);
        for (std::int64_t r = std::max<std::int64_t>(0, row - squares); r <= std::min(rows - 1, row + squares); ++r) {
            const std::size_t end = start[static_cast<std::size_t>(r * columns + to) + 1];
            for (std::size_t k = start[static_cast<std::size_t>(r * columns + from)]; k < end; ++k) {
                if (!f(points[k])) return;
            }
        }
    }
};

Form::Form(const FormedSurface& formed, const Box2& region) {
    pitch_ = formed.surface().step_over > 0 ? formed.surface().step_over : 10 * formed.usual_cell();
    if (region.isEmpty()) return;
    corner_ = region.min() - Vec2::Constant(pitch_);
    columns_ = static_cast<std::int64_t>(std::ceil(region.sizes().x() / pitch_)) + 3;
    rows_ = static_cast<std::int64_t>(std::ceil(region.sizes().y() / pitch_)) + 3;
    knots_.resize(static_cast<std::size_t>(columns_ * rows_));

    Box2 wide = region;
    const Vec2 room = Vec2::Constant((reach + 1) * pitch_);
    wide.extend(Vec2(region.min() - room));
    wide.extend(Vec2(region.max() + room));
    std::vector<Vec3> found = standing_contacts(formed, wide, sample_spacing * pitch_);
    Samples samples;
    samples.level = formed.level();
    samples.columns = columns_;
    samples.rows = rows_;
    samples.start.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
    // Points beside the grid belong to its outermost squares.
    const auto square = [&](const Vec3& p) {
        const auto c = std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor((p.x() - corner_.x()) / pitch_)), 0, columns_ - 1);
        const auto r = std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor((p.y() - corner_.y()) / pitch_)), 0, rows_ - 1);
        return static_cast<std::size_t>(r * columns_ + c);
    };
    for (const Vec3& p : found) ++samples.start[square(p) + 1];
    for (std::size_t k = 1; k < samples.start.size(); ++k) samples.start[k] += samples.start[k - 1];
    samples.points.resize(found.size());
    std::vector<std::size_t> next(samples.start.begin(), samples.start.end() - 1);
    for (const Vec3& p : found) samples.points[next[square(p)]++] = p;
    found = {};
    parallel_for(columns_ * rows_, 64, [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t k = first; k < last; ++k) fit(k % columns_, k / columns_, samples);
    });
    const std::int64_t fine_columns = finer * columns_;
    inside_.resize(static_cast<std::size_t>(fine_columns * finer * rows_));
    parallel_for(static_cast<std::int64_t>(inside_.size()), 1024, [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t k = first; k < last; ++k) {
            const Vec2 off(static_cast<double>(k % fine_columns), static_cast<double>(k / fine_columns));
            inside_[static_cast<std::size_t>(k)] = is_inside(corner_ + pitch_ / finer * (off + Vec2::Constant(0.5)), samples) ? 1 : 0;
        }
    });
}

bool Form::is_inside(const Vec2& place, const Samples& samples) const {
    double nearest = std::numeric_limits<double>::infinity();
    Vec2 way = Vec2::Zero();
    const Vec2 at = (place - corner_) / pitch_;
    samples.for_each_near(static_cast<std::int64_t>(at.x()), static_cast<std::int64_t>(at.y()), static_cast<std::int64_t>(reach), [&](const Vec3& p) {
        const Vec2 off = p.head<2>() - place;
        if (off.squaredNorm() >= nearest) return true;
        nearest = off.squaredNorm();
        way = off;
        return true;
    });
    if (!(nearest <= reach * reach * pitch_ * pitch_)) return false;
    if (std::sqrt(nearest) < on_line * pitch_) return true;
    bool found = false;
    samples.for_each_near(static_cast<std::int64_t>(at.x()), static_cast<std::int64_t>(at.y()), static_cast<std::int64_t>(reach), [&](const Vec3& p) {
        const Vec2 off = p.head<2>() - place;
        found = off.dot(way) < opposite * off.norm() * way.norm();
        return !found;
    });
    return found;
}

void Form::fit(std::int64_t column, std::int64_t row, const Samples& samples) {
    struct Used {
        Terms terms;
        double z, weight, robust;
    };
    Knot& knot = knots_[static_cast<std::size_t>(row * columns_ + column)];
    knot.fill(none);
    const Vec2 here = corner_ + pitch_ * Vec2(static_cast<double>(column), static_cast<double>(row));
    // A knot stands at the corner of four squares.
    const auto for_each_near = [&](auto&& f) {
        samples.for_each_near(column, row, static_cast<std::int64_t>(reach) + 1, [&](const Vec3& p) {
            f(p);
            return true;
        });
    };
    double nearest = std::numeric_limits<double>::infinity();
    double base = 0;
    for_each_near([&](const Vec3& p) {
        const double d = (p.head<2>() - here).squaredNorm();
        if (d >= nearest) return;
        nearest = d;
        base = p.z();
    });
    if (!(nearest <= 4 * pitch_ * pitch_)) return;
    std::vector<Used> used;
    for_each_near([&](const Vec3& p) {
        const Vec2 off = (p.head<2>() - here) / pitch_;
        const double rise = (p.z() - base) / pitch_;
        const double d = std::sqrt(off.squaredNorm() + rise * rise) / reach;
        if (d >= 1) return;
        const double tricube = 1 - d * d * d;
        used.push_back({terms(off.x(), off.y()), p.z() - base, tricube * tricube * tricube, 1});
    });
    if (used.size() < 6) return;
    Terms solution = Terms::Zero();
    std::vector<double> left(used.size());
    for (int pass = 0; pass < fits; ++pass) {
        Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
        Terms right = Terms::Zero();
        for (const Used& u : used) {
            const double w = u.weight * u.robust;
            normal.noalias() += w * u.terms * u.terms.transpose();
            right.noalias() += w * u.z * u.terms;
        }
        normal.diagonal().array() += stiffness * normal(0, 0);
        solution = normal.ldlt().solve(right);
        if (pass + 1 == fits) break;
        for (std::size_t k = 0; k < used.size(); ++k) left[k] = std::abs(used[k].z - used[k].terms.dot(solution));
        std::vector<double> sorted = left;
        const double most = bisquare * std::max(least_spread, 1.4826 * median(sorted));
        for (std::size_t k = 0; k < used.size(); ++k) {
            const double share = std::min(1.0, left[k] / most);
            used[k].robust = (1 - share * share) * (1 - share * share);
        }
    }
    if (!solution.allFinite()) return;
    for (std::size_t k = 0; k < 6; ++k) knot[k] = static_cast<float>(solution[static_cast<Eigen::Index>(k)]);
    knot[0] += static_cast<float>(base - samples.level);
}

Form::Facet Form::at(const Vec2& place) const {
    const double u = (place.x() - corner_.x()) / pitch_;
    const double v = (place.y() - corner_.y()) / pitch_;
    const auto c = static_cast<std::int64_t>(std::floor(u));
    const auto r = static_cast<std::int64_t>(std::floor(v));
    Facet sum;
    double weights = 0;
    const bool on_grid = c >= 0 && r >= 0 && c + 1 < columns_ && r + 1 < rows_;
    if (on_grid && inside_[static_cast<std::size_t>(static_cast<std::int64_t>(v * finer) * finer * columns_ + static_cast<std::int64_t>(u * finer))] != 0) {
        for (int k = 0; k < 4; ++k) {
            const std::int64_t kc = c + k % 2;
            const std::int64_t kr = r + k / 2;
            const Knot& a = knots_[static_cast<std::size_t>(kr * columns_ + kc)];
            if (!(a[0] == a[0])) continue;
            const double x = u - static_cast<double>(kc);
            const double y = v - static_cast<double>(kr);
            const double w = (1 - std::abs(x)) * (1 - std::abs(y));
            weights += w;
            sum.z += w * (a[0] + a[1] * x + a[2] * y + a[3] * x * x + a[4] * x * y + a[5] * y * y);
            sum.zx += w * (a[1] + 2 * a[3] * x + a[4] * y);
            sum.zy += w * (a[2] + a[4] * x + 2 * a[5] * y);
        }
    }
    if (!(weights > 0)) return {none, none, none};
    return {sum.z / weights, sum.zx / (weights * pitch_), sum.zy / (weights * pitch_)};
}

void Form::subtract(const MapFrame& frame, std::int64_t first_row, std::span<float> z) const {
    const auto count = static_cast<std::int64_t>(z.size());
    constexpr std::int64_t grain = 4096;
    parallel_for(count, grain, [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t k = first; k < last; ++k) {
            float& height = z[static_cast<std::size_t>(k)];
            if (!(height == height)) continue;
            const Facet form = at(frame.at(static_cast<double>(k % frame.columns), static_cast<double>(first_row + k / frame.columns)));
            height = static_cast<float>((height - form.z) / std::sqrt(1 + form.zx * form.zx + form.zy * form.zy));
        }
    });
}

void map_deviation(const FormedSurface& formed, const Form& form, const MapFrame& frame, const TakeRows& take) {
    formed.map(frame, [&](std::int64_t first_row, std::span<float> z) {
        form.subtract(frame, first_row, z);
        take(first_row, z);
    });
}

}  // namespace clsurf
