#include "planted_log.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <fmt/format.h>

namespace clsurf::planted {
namespace {

constexpr double grid_step = 0.01;           ///< [mm] spacing of the points of a pass before sampling
constexpr double normal_acceleration = 600;  ///< [mm/s²] acceleration that limits the speed in curves …
constexpr double end_acceleration = 600;     ///< … and at the ends of passes
constexpr double plan_smoothing = 0.4;       ///< [mm] distance over which the speed plan is smoothed
constexpr double creep = 1.0;                ///< [mm/s] speed at the ends
constexpr int link_points = 11;
constexpr double lift = 2;           ///< [mm] height above the passes on the way back
constexpr double rapid_speed = 200;  ///< [mm/s]
constexpr double scatter_knots = 6;  ///< intervals of the slow scatter along a pass
constexpr int first_line = 10;

using Generator = std::mt19937_64;
double uniform(Generator& g, double a, double b) { return std::uniform_real_distribution<double>(a, b)(g); }
double normal(Generator& g) { return std::normal_distribution<double>()(g); }

bool is_round(Shape shape) { return shape == Shape::loops || shape == Shape::spiral; }

/// Height and slopes of the surface.
struct Facet {
    double z = 0, zx = 0, zy = 0;
    [[nodiscard]] Vec3 normal() const { return Vec3(-zx, -zy, 1).normalized(); }
};

Facet facet_at(const Recipe& r, double x, double y) {
    const double middle = is_round(r.shape) ? 0 : 0.5 * r.length;
    const double u = (x - middle) / r.width;
    constexpr double across = 120;  // [mm] radius of curvature across the passes
    switch (r.surface) {
        case Surface::transition: {
            const double y0 = 0.5 * r.passes * r.step_over;
            const double slope = 0.5 * r.height / r.width / (std::cosh(u) * std::cosh(u));
            return {0.5 * r.height * (1 + std::tanh(u)) - (y - y0) * (y - y0) / (2 * across), slope,
                    -(y - y0) / across};
        }
        case Surface::dome: {
            const double radius =
                1.3 *
                std::hypot(0.5 * r.length, is_round(r.shape) ? 0 : r.passes * r.step_over);  // no steeper than 50°
            const double d = x - middle;
            const double z = std::sqrt(radius * radius - d * d - y * y);
            return {z - radius, -d / z, -y / z};
        }
        case Surface::wave: {
            const double amplitude = 0.25 * r.height;
            return {amplitude * std::sin(u), amplitude / r.width * std::cos(u), 0};
        }
    }
    return {};
}

/// One pass as closely spaced points with their arc length.
struct Curve {
    std::vector<Vec3> at;
    std::vector<double> arc_length;  ///< [mm] arc length from the beginning of the pass
    std::vector<double> coordinate;  ///< [mm] position along the pass, the same for adjacent passes
    std::vector<int> pass;           ///< per point: a spiral has many passes on one curve
};

void close(Curve& c) {
    c.arc_length.assign(c.at.size(), 0);
    for (std::size_t i = 1; i < c.at.size(); ++i)
        c.arc_length[i] = c.arc_length[i - 1] + (c.at[i] - c.at[i - 1]).norm();
}

Vec3 on_surface(const Recipe& r, double x, double y) { return {x, y, facet_at(r, x, y).z}; }

Curve straight(const Recipe& r, int pass) {
    Curve c;
    const auto n = static_cast<int>(r.length / grid_step);
    const bool backwards = r.shape == Shape::zigzag && pass % 2 == 1;
    for (int i = 0; i <= n; ++i) {
        const double x = r.length * (backwards ? n - i : i) / n;
        c.at.push_back(on_surface(r, x, pass * r.step_over));
        c.coordinate.push_back(x);
        c.pass.push_back(pass);
    }
    return c;
}

/// Radius of the loops' outline, which is not quite a circle, so that speed limits differ along it.
double outline(double radius, double angle) { return radius * (1 + 0.06 * std::cos(3 * angle)); }

Curve round(const Recipe& r, int first_pass, int last_pass, bool winding) {
    Curve c;
    const double outer = 0.5 * r.length;
    const double full = 2 * std::numbers::pi;
    const double reference = outer - 0.5 * r.passes * r.step_over;  // one for all: the same angle is the same place
    for (int pass = first_pass; pass <= last_pass; ++pass) {
        const auto n = static_cast<int>(full * std::max(outer - pass * r.step_over, 1.0) / grid_step);
        for (int i = 0; i < n + (winding ? 0 : 1); ++i) {
            const double angle = full * i / n;
            const double radius = outline(outer - r.step_over * (pass + (winding ? angle / full : 0)), angle);
            c.at.push_back(on_surface(r, radius * std::cos(angle), radius * std::sin(angle)));
            c.coordinate.push_back(angle * reference);
            c.pass.push_back(pass);
        }
    }
    return c;
}

/// 1 inside the window, raised-cosine edges, 0 outside.
double window(const Defect& d, double at) {
    const double u =
        std::clamp((at - d.from + d.edge) / d.edge, 0.0, 1.0) * std::clamp((d.to + d.edge - at) / d.edge, 0.0, 1.0);
    return 0.5 - 0.5 * std::cos(std::numbers::pi * u);
}

bool on_pass(const Defect& d, int pass) {
    return pass >= d.first_pass && pass <= d.last_pass && (pass - d.first_pass) % d.every == 0;
}

double interpolate(const std::vector<double>& x, const std::vector<double>& y, double at) {
    const auto after = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), at) - x.begin());
    if (after == 0) return y.front();
    if (after == x.size()) return y.back();
    const double share = (at - x[after - 1]) / (x[after] - x[after - 1]);
    return y[after - 1] + share * (y[after] - y[after - 1]);
}

std::vector<double> smoothed(const std::vector<double>& values, int half) {
    std::vector<double> out(values.size());
    double sum = 0;
    const auto n = static_cast<int>(values.size());
    const auto at = [&](int i) { return values[static_cast<std::size_t>(std::clamp(i, 0, n - 1))]; };
    for (int i = -half; i <= half; ++i) sum += at(i);
    for (int i = 0; i < n; ++i) {
        out[static_cast<std::size_t>(i)] = sum / (2 * half + 1);
        sum += at(i + half + 1) - at(i - half);
    }
    return out;
}

class Maker {
public:
    explicit Maker(const Recipe& recipe) : r_(recipe), generator_(recipe.seed) {
        log_.recipe = recipe;
        log_.truth.resize(recipe.defects.size());
    }

    PlantedLog make() {
        lines_.assign(first_line - 1, "");
        if (r_.shape == Shape::spiral) {
            run(round(r_, 0, r_.passes - 1, true), nullptr);
        } else {
            std::vector<Curve> curves;
            for (int pass = 0; pass < r_.passes; ++pass)
                curves.push_back(r_.shape == Shape::loops ? round(r_, pass, pass, false) : straight(r_, pass));
            for (std::size_t k = 0; k < curves.size(); ++k)
                run(std::move(curves[k]), k + 1 < curves.size() ? &curves[k + 1].at.front() : nullptr);
        }
        write_program();
        return std::move(log_);
    }

private:
    /// Samples one curve and the link to the beginning of the next one.
    void run(Curve c, const Vec3* next) {
        close(c);
        const std::vector<double> speed = plan(c);
        std::vector<double> time(c.at.size(), 0);
        for (std::size_t i = 1; i < time.size(); ++i)
            time[i] = time[i - 1] + (c.arc_length[i] - c.arc_length[i - 1]) / (0.5 * (speed[i] + speed[i - 1]));
        const auto base = static_cast<std::uint32_t>(lines_.size() + 1);
        if (start_.hasNaN()) start_ = c.at.front();
        for (double t = 0; t < time.back(); t += r_.period) {
            const double when = std::clamp(t + r_.jitter * r_.period * normal(generator_), 0.0, time.back());
            const double s = interpolate(time, c.arc_length, when);
            sample(c, speed, s, base + static_cast<std::uint32_t>(s / r_.block));
        }
        const auto blocks = static_cast<std::size_t>(std::ceil(c.arc_length.back() / r_.block));
        for (std::size_t b = 1; b <= blocks; ++b) {
            const double s = std::min(c.arc_length.back(), static_cast<double>(b) * r_.block);
            add_line("G1", at_arc_length(c, s));
        }
        if (next == nullptr) return;
        if (r_.shape == Shape::one_way) {
            lift_over(c.at.back(), *next);
        } else {
            add_line("G1", *next);
            move(c.at.back(), *next, (*next - c.at.back()).norm() / (link_points + 1));
        }
        lines_.push_back("");
    }

    /// Samples a straight move without its ends, in steps of `step` [mm], on the latest line.
    void move(const Vec3& from, const Vec3& to, double step) {
        const auto n = static_cast<int>(std::ceil((to - from).norm() / step));
        for (int i = 1; i < n; ++i) {
            const Vec3 p = from + (to - from) * i / n;
            push(p, p, -1, static_cast<std::uint32_t>(lines_.size()));
        }
    }

    void lift_over(const Vec3& from, const Vec3& to) {
        const Vec3 up(0, 0, std::max(from.z(), to.z()) + lift);
        const Vec3 over(to.x(), to.y(), up.z());
        const Vec3 above(from.x(), from.y(), up.z());
        const double step = rapid_speed * r_.period;
        add_line("G0", above);
        move(from, above, step);
        add_line("G0", over);
        move(above, over, step);
        add_line("G1", to);
        move(over, to, r_.feed * r_.period);
    }

    static Vec3 at_arc_length(const Curve& c, double s) {
        const auto after = static_cast<std::size_t>(std::upper_bound(c.arc_length.begin(), c.arc_length.end(), s) -
                                                    c.arc_length.begin());
        if (after == 0) return c.at.front();
        if (after == c.arc_length.size()) return c.at.back();
        const double share = (s - c.arc_length[after - 1]) / (c.arc_length[after] - c.arc_length[after - 1]);
        return c.at[after - 1] + share * (c.at[after] - c.at[after - 1]);
    }

    /// Direction and curvature at a grid point, over ±10 grid steps.
    static void bend(const Curve& c, std::size_t i, Vec3& tangent, Vec3& curvature) {
        constexpr std::size_t reach = 10;
        const std::size_t m = std::clamp(i, reach, c.at.size() - 1 - reach);
        const Vec3& a = c.at[m - reach];
        const Vec3& b = c.at[m];
        const Vec3& d = c.at[m + reach];
        const double h = 0.5 * (c.arc_length[m + reach] - c.arc_length[m - reach]);
        tangent = (d - a).normalized();
        curvature = (a - 2 * b + d) / (h * h);
    }

    std::vector<double> plan(const Curve& c) {
        std::vector<double> v(c.at.size());
        for (std::size_t i = 0; i < v.size(); ++i) {
            Vec3 tangent;
            Vec3 curvature;
            bend(c, i, tangent, curvature);
            const double ends = std::min(c.arc_length[i], c.arc_length.back() - c.arc_length[i]);
            v[i] = std::min({r_.feed, std::sqrt(normal_acceleration / std::max(curvature.norm(), 1e-9)),
                             std::sqrt(2 * end_acceleration * ends + creep * creep)});
        }
        const int half = static_cast<int>(0.25 * plan_smoothing / grid_step);
        v = smoothed(smoothed(v, half), half);
        // Every pass has its own slow scatter; on a spiral it continues from turn to turn.
        const double per_pass = c.pass.back() > c.pass.front()
                                    ? c.arc_length.back() / (c.pass.back() - c.pass.front() + 1)
                                    : c.arc_length.back();
        std::vector<double> knots;
        std::vector<double> scatter;
        for (double s = 0; s <= c.arc_length.back() + per_pass / scatter_knots; s += per_pass / scatter_knots) {
            knots.push_back(s);
            scatter.push_back(1 + r_.scatter * normal(generator_));
        }
        for (std::size_t i = 0; i < v.size(); ++i) {
            for (const Defect& d : r_.defects) {
                if (d.kind == Kind::lag || !on_pass(d, c.pass[i])) continue;
                const double w = window(d, c.coordinate[i]);
                const double swing =
                    d.kind == Kind::speed ? -1.0 : std::sin(2 * std::numbers::pi * (c.coordinate[i] - d.from) / d.wave);
                v[i] *= 1 + d.amplitude * w * swing;
            }
            v[i] *= interpolate(knots, scatter, c.arc_length[i]);
        }
        return v;
    }

    void sample(const Curve& c, const std::vector<double>& speed, double s, std::uint32_t line) {
        const auto i = static_cast<std::size_t>(std::lower_bound(c.arc_length.begin(), c.arc_length.end(), s) -
                                                c.arc_length.begin());
        const std::size_t k = std::min(i, c.at.size() - 1);
        const Vec3 p = at_arc_length(c, s);
        Vec3 tangent;
        Vec3 curvature;
        bend(c, k, tangent, curvature);
        const Vec3 n = facet_at(r_, p.x(), p.y()).normal();
        const double v = speed[k];
        double off = r_.give * curvature.dot(n) * v * v;
        const auto point = static_cast<PointIndex>(log_.line.size());
        for (std::size_t d = 0; d < r_.defects.size(); ++d) {
            if (!on_pass(r_.defects[d], c.pass[k])) continue;
            const double w = window(r_.defects[d], c.coordinate[k]);
            if (r_.defects[d].kind == Kind::lag) off += r_.defects[d].amplitude * w;
            if (w >= 0.5) log_.truth[d].push_back(point);
        }
        Vec3 measured = p - r_.delay * v * tangent + off * n;
        for (Eigen::Index axis = 0; axis < 3; ++axis) measured[axis] += r_.noise * normal(generator_);
        push(p, measured, c.pass[k], line);
    }

    void push(const Vec3& commanded, const Vec3& measured, int pass, std::uint32_t line) {
        for (int axis = 0; axis < 3; ++axis) {
            log_.commanded[axis].push_back(std::round(commanded[axis] / r_.quantum) * r_.quantum);
            log_.measured[axis].push_back(std::round(measured[axis] / r_.quantum) * r_.quantum);
        }
        log_.pass.push_back(pass);
        log_.line.push_back(line);
    }

    void add_line(std::string_view word, const Vec3& p) {
        lines_.push_back(fmt::format("{} X{:.4f} Y{:.4f} Z{:.4f}", word, p.x(), p.y(), p.z()));
    }

    void write_program() {
        std::vector<std::string> head{
            "%",
            "O2000",
            "G90 G17 G21 G54",
            fmt::format("G1 F{:.0f}", r_.feed * 60),
            fmt::format("G0 X{:.4f} Y{:.4f} Z{:.3f}", start_.x(), start_.y(), start_.z() + 20),
            fmt::format("G1 Z{:.4f}", start_.z())};
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            const std::string& line = i < head.size() ? head[i] : lines_[i];
            log_.program += (line.empty() ? fmt::format("(line {})", i + 1) : line) + "\n";
        }
        log_.program += "M30\n%\n";
    }

    Recipe r_;
    Generator generator_;
    PlantedLog log_;
    std::vector<std::string> lines_;
    Vec3 start_ = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
};

}  // namespace

std::string_view name_of(Shape shape) {
    constexpr std::array<std::string_view, 4> names{"zigzag", "one-way", "loops", "spiral"};
    return names[static_cast<std::size_t>(shape)];
}

std::string_view name_of(Kind kind) {
    constexpr std::array<std::string_view, 4> names{"speed", "oscillation", "lag", "offset"};
    return names[static_cast<std::size_t>(kind)];
}

PlantedLog make_planted_log(const Recipe& recipe) { return Maker(recipe).make(); }

Recipe random_recipe(std::uint64_t seed, Shape shape, bool clean, bool hard) {
    Generator g(seed * 7919 + static_cast<std::uint64_t>(shape));
    const auto pick = [&](auto... values) {
        const std::array all{values...};
        return all[std::uniform_int_distribution<std::size_t>(0, all.size() - 1)(g)];
    };
    Recipe r;
    r.seed = seed;
    r.shape = shape;
    r.surface = is_round(shape) ? pick(Surface::dome, Surface::wave, Surface::transition)
                                : pick(Surface::transition, Surface::transition, Surface::wave, Surface::dome);
    r.step_over = pick(0.2, 0.3, 0.4);
    r.passes = std::uniform_int_distribution<int>(24, 40)(g);
    r.length = is_round(shape) ? uniform(g, 2 * r.passes * r.step_over + 12, 2 * r.passes * r.step_over + 20)
                               : uniform(g, 20, 40);
    r.height = uniform(g, 1.5, 4);
    r.width = uniform(g, 2.5, 5);
    r.feed = pick(33.3, 50.0, 66.7);
    r.quantum = pick(0.001, 0.001, 0.0005, 0.0001);
    r.noise = uniform(g, 0.0001, 0.0004);
    r.jitter = pick(0.0, 0.0, 0.01);
    if (clean) return r;
    const int defects = std::uniform_int_distribution<int>(2, 4)(g);
    const double along = is_round(shape) ? std::numbers::pi * (r.length - r.passes * r.step_over) : r.length;  // [mm]
    const double lane = (std::min(along, 40.0) - 6) / 4;
    for (int k = 0; k < defects; ++k) {
        Defect d;
        d.kind = pick(Kind::speed, Kind::oscillation, Kind::lag);
        d.first_pass = std::uniform_int_distribution<int>(5, r.passes - 10)(g);
        const int width = pick(0, 0, 1, 3);
        d.last_pass = d.first_pass + width;
        d.every = width == 3 && uniform(g, 0, 1) < 0.5 ? 2 : 1;
        d.from = 3 + lane * k + 0.6;
        d.to = std::min(d.from + uniform(g, 1.5, 4), 3 + lane * (k + 1) - 0.6);
        const double sign = pick(-1.0, 1.0);
        switch (d.kind) {
            case Kind::speed: d.amplitude = hard ? uniform(g, 0.05, 0.10) : uniform(g, 0.10, 0.40); break;
            case Kind::oscillation: d.amplitude = hard ? uniform(g, 0.05, 0.10) : uniform(g, 0.12, 0.25); break;
            case Kind::lag:
            case Kind::offset: d.amplitude = sign * (hard ? uniform(g, 0.002, 0.003) : uniform(g, 0.003, 0.010)); break;
        }
        r.defects.push_back(d);
    }
    return r;
}

Log as_log(const PlantedLog& planted) {
    Log log;
    log.name = "planted.biip";
    log.format = "biip";
    log.records = static_cast<PointIndex>(planted.line.size());
    log.period = planted.recipe.period;
    const auto view = [&](const void* data, ScalarType type) {
        return ChannelView{static_cast<const std::byte*>(data), size_of(type), log.records, type, false, 1.0, 0.0};
    };
    for (std::size_t axis = 0; axis < 3; ++axis)
        log.channels.push_back(
            {fmt::format("cmd.{}", "xyz"[axis]), "mm", view(planted.commanded[axis].data(), ScalarType::f64)});
    for (std::size_t axis = 0; axis < 3; ++axis)
        log.channels.push_back(
            {fmt::format("fb.{}", "xyz"[axis]), "mm", view(planted.measured[axis].data(), ScalarType::f64)});
    log.channels.push_back({"line", "", view(planted.line.data(), ScalarType::u32)});
    return log;
}

}  // namespace clsurf::planted
