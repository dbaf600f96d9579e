#include "course.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <unordered_map>

namespace clsurf::planted {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double lift = 2;          ///< [mm] height of a retract above the surface
constexpr double crease = 0.6;      ///< [mm] distance over which the loops around two borders blend
constexpr double grid_cell = 0.05;  ///< [mm] cell size of the grid for tracing level lines

using Line2 = std::vector<Vec2>;

/// How a pass is joined to the previous one.
enum class Joint : std::uint8_t { none, link, retract };

struct PlanePass {
    Line2 line;  ///< closely spaced points
    Joint joint = Joint::link;
};

/// Points of a polyline at equal distances of at most `spacing`.
Line2 resampled(const Line2& line, double spacing) {
    std::vector<double> arc_length(line.size(), 0);
    for (std::size_t i = 1; i < line.size(); ++i) arc_length[i] = arc_length[i - 1] + (line[i] - line[i - 1]).norm();
    const auto n = static_cast<std::size_t>(std::max(1.0, std::ceil(arc_length.back() / spacing)));
    Line2 out;
    std::size_t k = 1;
    for (std::size_t i = 0; i <= n; ++i) {
        const double s = arc_length.back() * static_cast<double>(i) / static_cast<double>(n);
        while (k + 1 < line.size() && arc_length[k] < s) ++k;
        const double step = arc_length[k] - arc_length[k - 1];
        out.push_back(line[k - 1] + (step > 0 ? (s - arc_length[k - 1]) / step : 0.0) * (line[k] - line[k - 1]));
    }
    return out;
}

/// Signed distance to the border of a rectangle with rounded corners, positive inside.
double inside_rectangle(const Vec2& p, double half, double radius) {
    const Vec2 q = p.cwiseAbs() - Vec2::Constant(half - radius);
    return radius - q.cwiseMax(0.0).norm() - std::min(q.maxCoeff(), 0.0);
}

struct Island {
    Vec2 middle;
    double radius;
};

/// Closed level lines of a field on a square, traced cell by cell.
class LevelLines {
public:
    template <typename Field>
    LevelLines(double half, Field&& field) : half_(half), n_(static_cast<int>(std::ceil(2 * half / grid_cell)) + 1) {
        values_.reserve(static_cast<std::size_t>(n_) * static_cast<std::size_t>(n_));
        for (int j = 0; j < n_; ++j) {
            for (int i = 0; i < n_; ++i) values_.push_back(field(corner(i, j)));
        }
    }

    [[nodiscard]] std::vector<Line2> trace(double level) const {
        // Each crossed edge of the grid is shared by two cells: the line leaves one through it and enters the other.
        std::unordered_map<std::int64_t, std::vector<std::int64_t>> joined;
        for (int j = 0; j + 1 < n_; ++j) {
            for (int i = 0; i + 1 < n_; ++i) {
                std::array<std::int64_t, 4> crossed{};
                std::size_t count = 0;
                for (const std::int64_t edge : {key(i, j, 0), key(i + 1, j, 1), key(i, j + 1, 0), key(i, j, 1)}) {
                    if (crosses(edge, level)) crossed[count++] = edge;
                }
                for (std::size_t k = 0; k + 1 < count; k += 2) {
                    joined[crossed[k]].push_back(crossed[k + 1]);
                    joined[crossed[k + 1]].push_back(crossed[k]);
                }
            }
        }
        std::vector<std::int64_t> starts;
        for (const auto& [edge, others] : joined) starts.push_back(edge);
        std::sort(starts.begin(), starts.end());
        std::vector<Line2> lines;
        std::unordered_map<std::int64_t, bool> seen;
        for (const std::int64_t start : starts) {
            if (seen[start]) continue;
            Line2 line;
            std::int64_t at = start;
            for (bool more = true; more;) {
                seen[at] = true;
                line.push_back(place(at, level));
                more = false;
                for (const std::int64_t next : joined[at]) {
                    if (seen[next]) continue;
                    at = next;
                    more = true;
                    break;
                }
            }
            line.push_back(line.front());
            lines.push_back(std::move(line));
        }
        return lines;
    }

private:
    [[nodiscard]] Vec2 corner(int i, int j) const { return {-half_ + grid_cell * i, -half_ + grid_cell * j}; }
    [[nodiscard]] std::int64_t key(int i, int j, int direction) const {
        return (static_cast<std::int64_t>(j) * n_ + i) * 2 + direction;
    }
    struct Edge {
        Vec2 a, b;
        double from, to;
    };
    [[nodiscard]] Edge edge_of(std::int64_t edge) const {
        const auto i = static_cast<int>(edge / 2 % n_);
        const auto j = static_cast<int>(edge / 2 / n_);
        const int di = edge % 2 == 0 ? 1 : 0;
        const auto value = [&](int a, int b) {
            return values_[static_cast<std::size_t>(b) * static_cast<std::size_t>(n_) + static_cast<std::size_t>(a)];
        };
        return {corner(i, j), corner(i + di, j + 1 - di), value(i, j), value(i + di, j + 1 - di)};
    }
    [[nodiscard]] bool crosses(std::int64_t edge, double level) const {
        const Edge e = edge_of(edge);
        return (e.from < level) != (e.to < level);
    }
    [[nodiscard]] Vec2 place(std::int64_t edge, double level) const {
        const Edge e = edge_of(edge);
        return e.a + (level - e.from) / (e.to - e.from) * (e.b - e.a);
    }

    double half_;
    int n_;
    std::vector<double> values_;
};

/// The surface over the plane of the layout.
class Surface {
public:
    explicit Surface(const CourseRecipe& recipe) : r_(recipe) {}

    [[nodiscard]] Vec3 at(const Vec2& p) const {
        switch (r_.layout) {
            case Layout::waterline:
            case Layout::staggered:
            case Layout::slanted:
            case Layout::helix: {
                const double around = p.x() / (0.5 * r_.length);
                const double radius = 0.5 * r_.length * (1 + 0.05 * std::cos(3 * around)) - p.y() * std::sin(r_.draft);
                return {radius * std::cos(around), radius * std::sin(around), p.y() * std::cos(r_.draft)};
            }
            case Layout::wall:
                return {p.x(), r_.waviness * std::sin(p.x() / r_.wave) + p.y() * std::sin(r_.draft),
                        p.y() * std::cos(r_.draft)};
            default:
                return {p.x(), p.y(),
                        r_.waviness * std::sin(p.x() / r_.wave) * std::cos(p.y() / (1.7 * r_.wave)) -
                            p.squaredNorm() / 400};
        }
    }
    [[nodiscard]] Vec3 normal(const Vec2& p) const {
        constexpr double h = 1e-4;
        const Vec3 u = at(p + Vec2(h, 0)) - at(p - Vec2(h, 0));
        const Vec3 v = at(p + Vec2(0, h)) - at(p - Vec2(0, h));
        return u.cross(v).normalized();
    }

private:
    CourseRecipe r_;
};

PlanePass straight(const Vec2& from, const Vec2& to, Joint joint) { return {{from, to}, joint}; }

std::vector<PlanePass> to_and_fro(const CourseRecipe& r) {
    std::vector<PlanePass> passes;
    const double turn = r.layout == Layout::oblique ? r.angle : 0;
    const Eigen::Rotation2Dd rotation(turn);
    const double hole = 0.15 * r.length;  // radius of the island
    const Vec2 island(0.5 * r.length, 0.5 * r.passes * r.step_over);
    for (int k = 0; k < r.passes; ++k) {
        const double y = k * r.step_over;
        const bool back = r.layout != Layout::one_way && k % 2 == 1;
        const auto add = [&](double from, double to, Joint joint) {
            if (back) std::swap(from, to);
            passes.push_back(straight(rotation * Vec2(from, y), rotation * Vec2(to, y), joint));
        };
        const Joint joint = r.layout == Layout::one_way ? Joint::retract : Joint::link;
        const double off = y - island.y();
        if (r.layout != Layout::interrupted || std::abs(off) >= hole) {
            add(0, r.length, joint);
            continue;
        }
        const double half = std::sqrt(hole * hole - off * off);
        const std::array<std::array<double, 2>, 2> parts{{{0, island.x() - half}, {island.x() + half, r.length}}};
        add(parts[back ? 1 : 0][0], parts[back ? 1 : 0][1], joint);
        add(parts[back ? 0 : 1][0], parts[back ? 0 : 1][1], Joint::retract);
    }
    return passes;
}

std::vector<PlanePass> arcs(const CourseRecipe& r) {
    std::vector<PlanePass> passes;
    const double inner = 0.5 * r.length;
    const double sweep = 1.6;  // [rad]
    for (int k = 0; k < r.passes; ++k) {
        const double radius = inner + k * r.step_over;
        PlanePass pass;
        const int n = static_cast<int>(std::ceil(sweep * radius / r.spacing));
        for (int i = 0; i <= n; ++i) {
            const double angle = 0.3 + sweep * (k % 2 == 1 ? n - i : i) / n;
            pass.line.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
        }
        passes.push_back(std::move(pass));
    }
    return passes;
}

std::vector<PlanePass> contours(const CourseRecipe& r) {
    const double half = 0.5 * r.length;
    const std::array<Island, 2> holes{{{{-0.2 * r.length, 0.06 * r.length}, 0.09 * r.length},
                                       {{0.24 * r.length, -0.12 * r.length}, 0.07 * r.length}}};
    const double corner = 0.4 * r.length;
    const LevelLines lines(half, [&](const Vec2& p) {
        if (r.layout == Layout::contours) return inside_rectangle(p, half - 0.5, corner);
        // Creases are rounded: a smooth minimum of the distances to sides and islands.
        double sum = 0;
        for (const double side : {p.x(), -p.x(), p.y(), -p.y()}) sum += std::exp((side - half + 0.5) / crease);
        for (const Island& hole : holes) sum += std::exp((hole.radius - (p - hole.middle).norm()) / crease);
        return -crease * std::log(sum);
    });
    std::vector<PlanePass> passes;
    Vec2 last(half, half);
    for (int k = 0; k < r.passes; ++k) {
        const double depth = (k + 0.25) * r.step_over;
        if (r.layout == Layout::contours && depth > corner - 1.5) break;  // corners would become sharp
        std::vector<Line2> level = lines.trace(depth);
        while (!level.empty()) {
            // The loop closest to the end of the previous one, beginning at its closest point.
            std::size_t best_loop = 0, best_point = 0;
            double nearest = 1e300;
            for (std::size_t l = 0; l < level.size(); ++l) {
                for (std::size_t i = 0; i + 1 < level[l].size(); ++i) {
                    const double distance = (level[l][i] - last).squaredNorm();
                    if (distance >= nearest) continue;
                    nearest = distance;
                    best_loop = l;
                    best_point = i;
                }
            }
            Line2 loop = std::move(level[best_loop]);
            level.erase(level.begin() + static_cast<std::ptrdiff_t>(best_loop));
            double around = 0;
            for (std::size_t i = 1; i < loop.size(); ++i) around += (loop[i] - loop[i - 1]).norm();
            if (around < 6) continue;  // a remnant in a corner
            loop.pop_back();
            std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(best_point), loop.end());
            loop.push_back(loop.front());
            const bool beside = nearest < 4 * r.step_over * r.step_over;
            last = loop.front();
            passes.push_back({std::move(loop), beside ? Joint::link : Joint::retract});
        }
    }
    return passes;
}

std::vector<PlanePass> winding(const CourseRecipe& r) {
    std::vector<PlanePass> passes;
    for (int k = 0; k < r.passes; ++k) {
        PlanePass pass;
        pass.joint = k == 0 ? Joint::link : Joint::none;
        const double outer = 0.5 * r.length - k * r.step_over;
        const int n = static_cast<int>(std::ceil(2 * pi * outer / r.spacing));
        for (int i = 0; i < n; ++i) {
            const double turn = static_cast<double>(i) / n;
            const double radius = (outer - turn * r.step_over) * (1 + 0.05 * std::cos(6 * pi * turn));
            pass.line.emplace_back(radius * std::cos(2 * pi * turn), radius * std::sin(2 * pi * turn));
        }
        passes.push_back(std::move(pass));
    }
    return passes;
}

std::vector<PlanePass> round_a_tower(const CourseRecipe& r) {
    std::vector<PlanePass> passes;
    const double around = pi * r.length;
    const bool helix = r.layout == Layout::helix;
    for (int k = 0; k < r.passes; ++k) {
        const double v = -k * r.step_over;
        if (r.layout == Layout::staggered) {
            const double start = 2.5 * k * r.step_over;  // links at 22° to the loops
            passes.push_back({{{start, v}, {start + around, v}}, Joint::link});
            continue;
        }
        if (r.layout == Layout::slanted) {
            constexpr double before = 1.6,
                             farther = 1.8;  // [mm] length of a link before and after the beginning of the loop
            const double start = k * farther, end = start + around;
            const double fall = r.step_over * (1 - r.spacing / (before + farther));
            passes.push_back({{{start, v}, {end - before, v}, {end + farther - r.spacing, v - fall}},
                              k > 0 ? Joint::none : Joint::link});
            continue;
        }
        const double last = helix ? around - r.spacing : around;
        const double fall = helix ? r.step_over * last / around : 0;
        passes.push_back({{{0, v}, {last, v - fall}}, helix && k > 0 ? Joint::none : Joint::link});
    }
    return passes;
}

std::vector<PlanePass> triangles(const CourseRecipe& r) {
    constexpr double blend = 0.2;   // [mm] distance from a corner to the beginning of its parabola
    constexpr double middle = 1.5;  // [mm] radius below which there is no room
    constexpr int steps = 16;
    std::vector<PlanePass> passes;
    for (int k = 0; k < r.passes; ++k) {
        const double inside = 0.36 * r.length - k * r.step_over;  // radius of the inscribed circle
        if (inside < middle) break;
        std::array<Vec2, 3> corner;
        for (std::size_t j = 0; j < 3; ++j) {
            const double angle = r.angle + 2 * pi * static_cast<double>(j) / 3;
            corner[j] = 2 * inside * Vec2(std::cos(angle), std::sin(angle));
        }
        const Vec2 start = 0.6 * corner[0] + 0.4 * corner[2];
        PlanePass pass{{start}, Joint::link};
        for (std::size_t j = 0; j < 3; ++j) {
            const Vec2& at = corner[j];
            const Vec2 in = at + blend * (corner[(j + 2) % 3] - at).normalized();
            const Vec2 out = at + blend * (corner[(j + 1) % 3] - at).normalized();
            for (int i = 0; i <= steps; ++i) {
                const double t = static_cast<double>(i) / steps;
                pass.line.push_back((1 - t) * (1 - t) * in + 2 * t * (1 - t) * at + t * t * out);
            }
        }
        pass.line.push_back(start);
        passes.push_back(std::move(pass));
    }
    return passes;
}

std::vector<PlanePass> lay_on_plane(const CourseRecipe& r) {
    switch (r.layout) {
        case Layout::arcs: return arcs(r);
        case Layout::contours:
        case Layout::islands: return contours(r);
        case Layout::spiral: return winding(r);
        case Layout::waterline:
        case Layout::staggered:
        case Layout::slanted:
        case Layout::helix: return round_a_tower(r);
        case Layout::triangles: return triangles(r);
        default: return to_and_fro(r);
    }
}

/// Appends a straight motion without its start point.
void move_to(std::vector<CoursePoint>& course, const Vec3& to, Motion motion, double spacing) {
    const Vec3 from = course.back().at;
    const int n = std::max(1, static_cast<int>(std::ceil((to - from).norm() / spacing)));
    for (int i = 1; i <= n; ++i) course.push_back({from + (to - from) * i / n, course.back().normal, -1, motion});
}

}  // namespace

std::string_view name_of(Layout layout) {
    constexpr std::array<std::string_view, layouts> names{"zigzag",   "one-way", "oblique", "arcs",      "interrupted",
                                                          "contours", "islands", "spiral",  "waterline", "staggered",
                                                          "slanted",  "helix",   "wall",    "triangles"};
    return names[static_cast<std::size_t>(layout)];
}

std::vector<CoursePoint> lay_course(const CourseRecipe& recipe) {
    const Surface surface(recipe);
    std::vector<CoursePoint> course;
    int number = 0;
    for (const PlanePass& pass : lay_on_plane(recipe)) {
        const Line2 line = resampled(pass.line, recipe.spacing);
        const Vec3 start = surface.at(line.front());
        if (!course.empty() && pass.joint == Joint::link) {
            move_to(course, start, Motion::link, recipe.spacing);
        } else if (!course.empty() && pass.joint == Joint::retract) {
            const Vec3 end = course.back().at;
            const double up = std::max(end.z(), start.z()) + lift;
            const double rapid = 10 * recipe.spacing;
            move_to(course, {end.x(), end.y(), up}, Motion::rapid, rapid);
            move_to(course, {start.x(), start.y(), up}, Motion::rapid, rapid);
            move_to(course, start, Motion::link, recipe.spacing);
        }
        for (const Vec2& p : line) course.push_back({surface.at(p), surface.normal(p), number, Motion::cut});
        ++number;
    }
    return course;
}

}  // namespace clsurf::planted
