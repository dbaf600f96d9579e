#include "viz/mark_strokes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "surface/missing_pass.h"

namespace clsurf::viz {
namespace {

constexpr double finest_step = 0.7;  ///< [px] distance between points of a band

void append(Band& band, const Band& from, std::size_t k) {
    band.left.push_back(from.left[k]);
    band.right.push_back(from.right[k]);
}

/// Appends an interpolated point between two points of a band.
void append_between(Band& band, const Band& from, std::size_t k, double share) {
    band.left.emplace_back(from.left[k] + share * (from.left[k + 1] - from.left[k]));
    band.right.emplace_back(from.right[k] + share * (from.right[k + 1] - from.right[k]));
}

Vec2 turned_left(const Vec2& direction) { return {-direction.y(), direction.x()}; }

/// The unit direction of a band at a point. `lonely`: used for a band of one point.
Vec2 direction_at(const Band& band, std::size_t k, const Vec2& lonely) {
    const std::size_t before = k > 0 ? k - 1 : k;
    const std::size_t behind = std::min(k + 1, band.size() - 1);
    const Vec2 direction = band.centre(behind) - band.centre(before);
    return direction.norm() > 0 ? Vec2(direction.normalized()) : lonely;
}

/// The shift [px] that brings both ends of a band's edge onto the part; zero if both ends or neither of them is on it.
template <typename IsOnPart>
Vec2 to_part(const Vec2& first, const Vec2& last, const IsOnPart& is_on_part) {
    const bool first_on = is_on_part(first);
    if (first_on == is_on_part(last)) return Vec2::Zero();
    const Vec2 off = first_on ? last : first;
    const Vec2 along = (first_on ? first : last) - off;
    const double most = 0.5 * along.norm();
    for (double way = finest_step; way <= most; way += finest_step)
        if (is_on_part(Vec2(off + way * along.normalized()))) return way * along.normalized();
    return Vec2::Zero();
}

/// Widens a band to a least width: a strip in side view is only a line.
void widen(Band& band, double least, const Vec2& lonely) {
    Band wide = band;
    for (std::size_t k = 0; k < band.size(); ++k) {
        const Vec2 across = turned_left(direction_at(band, k, lonely));
        const double width = (band.left[k] - band.right[k]).dot(across);
        if (std::abs(width) >= least) continue;
        const Vec2 half = (width < 0 ? -0.5 : 0.5) * least * across;
        wide.left[k] = band.centre(k) + half;
        wide.right[k] = band.centre(k) - half;
    }
    band = std::move(wide);
}

/// Lengthens a band, which is short if the section points to the viewer. It must not extend beyond the outline of the part.
template <typename IsOnPart>
void lengthen(Band& band, double least, const Vec2& lonely, const IsOnPart& is_on_part) {
    const double more = 0.5 * (least - length_of(band));
    if (!(more > 0)) return;
    const Vec2 first = direction_at(band, 0, lonely), last = direction_at(band, band.size() - 1, lonely);
    append(band, band, band.size() - 1);
    for (std::vector<Vec2>* edge : {&band.left, &band.right}) {
        edge->back() += more * last;
        edge->insert(edge->begin(), Vec2(edge->front() - more * first));
    }
    const Vec2 of_left = to_part(band.left.front(), band.left.back(), is_on_part);
    const Vec2 of_right = to_part(band.right.front(), band.right.back(), is_on_part);
    const Vec2 inwards = of_left.norm() > of_right.norm() ? of_left : of_right;
    for (std::vector<Vec2>* edge : {&band.left, &band.right})
        for (Vec2& at : *edge) at += inwards;
}

class StrokeMaker {
public:
    StrokeMaker(const ClSurface& surface, const Camera& camera, const Vec2& corner, const Look& look,
                const DepthBuffer& depth)
        : surface_(surface), camera_(camera), corner_(corner), look_(look), depth_(depth) {}

    [[nodiscard]] std::vector<Stroke> strokes(const PointRange& section) const {
        std::vector<Stroke> strokes;
        bool goes_on = false;
        for (PointIndex i = section.first; i <= section.last; ++i) {
            const Vec3 place = surface_.positions.absolute(i);
            if (!shows(camera_, look_, place)) {
                goes_on = false;
                continue;
            }
            const bool hidden = depth_.hides(place, surface_.step_over);
            if (goes_on && strokes.back().hidden == hidden) {
                add(strokes.back().band, i);
                continue;
            }
            Stroke next{{}, hidden};
            if (goes_on) append(next.band, strokes.back().band, strokes.back().band.size() - 1);
            add(next.band, i);
            strokes.push_back(std::move(next));
            goes_on = true;
        }
        return strokes;
    }

    /// The unit direction of the pass at a point.
    [[nodiscard]] Vec2 direction(PointIndex i) const {
        const PointIndex last = surface_.positions.size() - 1;
        const Vec2 step = at(surface_.positions.absolute(std::min(i + 1, last))) -
                          at(surface_.positions.absolute(std::max<PointIndex>(i - 1, 0)));
        return step.norm() > 0 ? Vec2(step.normalized()) : Vec2(1, 0);
    }

private:
    [[nodiscard]] Vec2 at(const Vec3& place) const { return corner_ + camera_.pixel(place); }

    [[nodiscard]] Vec2 edge(PointIndex i, Side side) const {
        const Vec3 place = surface_.positions.absolute(i);
        if (!has_surface(surface_, i, side)) return at(place);
        return at(0.5 * (place + surface_.positions.absolute(surface_.neighbours.neighbour(side, i))));
    }

    void add(Band& band, PointIndex i) const {
        const Vec2 left = edge(i, Side::left), right = edge(i, Side::right);
        if (band.size() > 0 && (0.5 * (left + right) - band.centre(band.size() - 1)).norm() < finest_step) return;
        band.left.push_back(left);
        band.right.push_back(right);
    }

    const ClSurface& surface_;
    const Camera& camera_;
    Vec2 corner_;
    const Look& look_;
    const DepthBuffer& depth_;
};

}  // namespace

std::vector<Vec2> Band::centre_line() const {
    std::vector<Vec2> line;
    for (std::size_t k = 0; k < size(); ++k) line.push_back(centre(k));
    return line;
}

Band band_of(const Vec2& from, const Vec2& to, double width) {
    const Vec2 half = 0.5 * width * turned_left((to - from).normalized());
    return {{from + half, to + half}, {from - half, to - half}};
}

double length_of(const Band& band) {
    double length = 0;
    for (std::size_t k = 1; k < band.size(); ++k) length += (band.centre(k) - band.centre(k - 1)).norm();
    return length;
}

Band part_of(const Band& band, double from, double to) {
    Band part;
    double length = 0;
    for (std::size_t k = 1; k < band.size(); ++k) {
        const double step = (band.centre(k) - band.centre(k - 1)).norm();
        const double begin = std::clamp((from - length) / step, 0.0, 1.0);
        const double end = std::clamp((to - length) / step, 0.0, 1.0);
        if (step > 0 && end > begin) {
            if (part.size() == 0) append_between(part, band, k - 1, begin);
            append_between(part, band, k - 1, end);
        }
        length += step;
    }
    return part;
}

Band narrowed(const Band& band, double share) {
    Band narrow;
    for (std::size_t k = 0; k < band.size(); ++k) {
        const Vec2 half = 0.5 * share * (band.left[k] - band.right[k]);
        narrow.left.emplace_back(band.centre(k) + half);
        narrow.right.emplace_back(band.centre(k) - half);
    }
    return narrow;
}

bool covers(const Band& band, const Vec2& at) {
    const auto in_triangle = [&](const Vec2& a, const Vec2& b, const Vec2& c) {
        const auto turn = [&](const Vec2& from, const Vec2& to) { return turned_left(to - from).dot(at - from); };
        const double ab = turn(a, b), bc = turn(b, c), ca = turn(c, a);
        return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
    };
    for (std::size_t k = 1; k < band.size(); ++k) {
        if (in_triangle(band.left[k - 1], band.right[k - 1], band.right[k]) ||
            in_triangle(band.left[k - 1], band.right[k], band.left[k]))
            return true;
    }
    return false;
}

std::vector<Stroke> strokes_of(const ClSurface& surface, const PointRange& section, const Camera& camera,
                               const Vec2& corner, const Look& look, const DepthBuffer& depth, double least_size) {
    const StrokeMaker maker(surface, camera, corner, look, depth);
    std::vector<Stroke> strokes = maker.strokes(section);
    const Vec2 lonely = maker.direction((section.first + section.last) / 2);
    const auto is_on_part = [&](const Vec2& at) { return depth.covers(at - corner); };
    for (Stroke& stroke : strokes) {
        widen(stroke.band, least_size, lonely);
        lengthen(stroke.band, least_size, lonely, is_on_part);
    }
    return strokes;
}

}  // namespace clsurf::viz
