#include "kinds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <random>

#include <fmt/format.h>

namespace clsurf::planted {
namespace {

constexpr std::array kinds = std::to_array<LogKind>({
    {"zigzag F200 1 µm", Layout::zigzag, 200, 0.001, 0.001, Fault::all},
    {"one-way F200 0.1 µm 2 ms", Layout::one_way, 200, 0.002, 0.0001, Fault::all},
    {"oblique F500 1 µm", Layout::oblique, 500, 0.001, 0.001, Fault::all},
    {"arcs F500 1 µm", Layout::arcs, 500, 0.001, 0.001, Fault::lag},
    {"contours F800 1 µm 500 µs", Layout::contours, 800, 0.0005, 0.001, Fault::all},
    {"waterline F800 1 µm", Layout::waterline, 800, 0.001, 0.001, Fault::all},
    {"zigzag F2000 250 µs", Layout::zigzag, 2000, 0.00025, 0.0001, Fault::all},
    {"wall F2000 500 µs", Layout::wall, 2000, 0.0005, 0.001, Fault::all},
    {"zigzag F3000 short dips", Layout::zigzag, 3000, 0.001, 0.001, Fault::short_dip},
    {"islands F3000", Layout::islands, 3000, 0.001, 0.001, Fault::all},
    {"islands F3000 near ends", Layout::islands, 3000, 0.001, 0.0001, Fault::end_dip},
    {"contours F3000 near ends", Layout::contours, 3000, 0.001, 0.001, Fault::end_dip},
    {"oblique F3000 rises", Layout::oblique, 3000, 0.002, 0.001, Fault::rise},
    {"arcs F3000", Layout::arcs, 3000, 0.001, 0.001, Fault::all},
    {"interrupted F3000", Layout::interrupted, 3000, 0.001, 0.001, Fault::all},
    {"zigzag F3000 points off", Layout::zigzag, 3000, 0.001, 0.0001, Fault::offset},
    {"one-way F3000 pairs", Layout::one_way, 3000, 0.001, 0.001, Fault::pair},
    {"zigzag F4000 pairs", Layout::zigzag, 4000, 0.001, 0.0001, Fault::pair},
    {"waterline F4000", Layout::waterline, 4000, 0.001, 0.001, Fault::all},
    {"helix F4000 250 µs", Layout::helix, 4000, 0.00025, 0.001, Fault::all},
    {"waterline F4000 near ends", Layout::waterline, 4000, 0.001, 0.0001, Fault::end_dip},
    {"staggered F3000", Layout::staggered, 3000, 0.001, 0.001, Fault::all},
    {"staggered F6000 2 ms", Layout::staggered, 6000, 0.002, 0.001, Fault::dip},
    {"wall F4000 near ends", Layout::wall, 4000, 0.001, 0.001, Fault::end_dip},
    {"spiral F6000", Layout::spiral, 6000, 0.001, 0.001, Fault::all},
    {"contours F6000 2 ms", Layout::contours, 6000, 0.002, 0.001, Fault::all},
    {"oblique F6000 long dips", Layout::oblique, 6000, 0.001, 0.001, Fault::long_dip},
    {"interrupted F6000 4 ms", Layout::interrupted, 6000, 0.004, 0.001, Fault::all},
    {"arcs F10000 2 ms", Layout::arcs, 10000, 0.002, 0.001, Fault::all},
    {"one-way F10000 4 ms", Layout::one_way, 10000, 0.004, 0.001, Fault::all},
    {"zigzag F15000 4 ms", Layout::zigzag, 15000, 0.004, 0.001, Fault::all},
    {"oblique F15000 4 ms lag", Layout::oblique, 15000, 0.004, 0.0001, Fault::lag},
    {"spiral F15000 4 ms", Layout::spiral, 15000, 0.004, 0.001, Fault::all},
    {"zigzag F15000 1 ms", Layout::zigzag, 15000, 0.001, 0.001, Fault::all},
    {"oblique F600 2 ms clock 100 µs", Layout::oblique, 600, 0.002, 0.0001, Fault::all, 100e-6},
    {"arcs F3000 clock 50 µs", Layout::arcs, 3000, 0.001, 0.0001, Fault::all, 50e-6},
    {"triangles F3000 dips", Layout::triangles, 3000, 0.001, 0.001, Fault::dip},
    {"triangles F5000 2 ms", Layout::triangles, 5000, 0.002, 0.0001, Fault::all},
    {"slanted F3000", Layout::slanted, 3000, 0.001, 0.001, Fault::all},
    {"slanted F4000", Layout::slanted, 4000, 0.001, 0.0001, Fault::all},
});

constexpr double pi = std::numbers::pi;
constexpr double rapid_speed = 300;     ///< [mm/s]
constexpr double creep = 0.5;           ///< [mm/s] speed at which the tool starts and stops
constexpr double jerk_seconds = 0.012;  ///< time over which the plan is rounded
constexpr double bend_reach = 0.1;      ///< [mm] distance over which the curvature is computed
constexpr double delay = 0.001;         ///< [s] delay of measured positions after commanded ones
constexpr double give = 1.5e-5;         ///< [mm per mm/s²] offset along the normal per normal acceleration
constexpr int first_line = 10;

using Generator = std::mt19937_64;
double uniform(Generator& g, double a, double b) { return std::uniform_real_distribution<double>(a, b)(g); }
int whole(Generator& g, int a, int b) { return std::uniform_int_distribution<int>(a, b)(g); }
double normal(Generator& g) { return std::normal_distribution<double>()(g); }

/// FNV-1a: the same on every platform.
std::uint64_t hash_of(std::string_view text) {
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    return hash;
}

/// A fault on a course: 1 inside its section, with raised-cosine edges.
struct Section {
    std::size_t defect = 0;  ///< index into the defects of the recipe
    std::size_t first = 0, last = 0;
    double middle = 0;  ///< arc length along the course [mm]
};

class Maker {
public:
    Maker(const LogKind& kind, std::uint64_t seed, bool clean)
        : kind_(kind), generator_(seed * 2654435761ULL + hash_of(kind.name)) {
        draw_sizes(seed);
        course_ = lay_course(shape_);
        arc_length_.assign(course_.size(), 0);
        for (std::size_t i = 1; i < course_.size(); ++i)
            arc_length_[i] = arc_length_[i - 1] + (course_[i].at - course_[i - 1].at).norm();
        for (std::size_t i = 0; i < course_.size(); ++i) {
            const int pass = course_[i].pass;
            if (pass < 0) continue;
            if (static_cast<std::size_t>(pass) >= passes_.size()) passes_.push_back({i, i});
            passes_.back().second = i;
        }
        if (!clean) plant();
    }

    PlantedLog make() {
        offset_points();
        write_program();
        sample(plan());
        return std::move(log_);
    }

private:
    void draw_sizes(std::uint64_t seed) {
        Generator& g = generator_;
        const double speed = kind_.feed / 60;
        const bool fast = kind_.feed > 8000;
        const bool slow = kind_.feed < 1000;
        shape_.layout = kind_.layout;
        shape_.step_over = uniform(g, 0.2, 0.4);
        shape_.passes = slow ? whole(g, 18, 22) : whole(g, 24, 36);
        const double base = slow ? 14 : fast ? 60 : kind_.layout == Layout::interrupted ? 44 : 26;
        shape_.length = base * uniform(g, 1, 1.3);
        const bool round = kind_.layout == Layout::spiral || kind_.layout == Layout::waterline ||
                           kind_.layout == Layout::staggered || kind_.layout == Layout::slanted ||
                           kind_.layout == Layout::helix;
        if (round) shape_.length = std::max(0.6 * shape_.length, 2.2 * shape_.passes * shape_.step_over);
        shape_.angle = uniform(g, 0.35, 1.2);
        shape_.waviness = uniform(g, 0.2, slow ? 0.6 : 1.5);
        shape_.wave = base / 5 * uniform(g, 1, 1.6);
        shape_.draft = uniform(g, 0.05, 0.25);
        shape_.spacing = fast ? 0.05 : 0.02;
        shape_.block = (fast ? 1.0 : 0.5) * uniform(g, 0.7, 1.3);
        acceleration_ = fast ? uniform(g, 3000, 6000) : uniform(g, 800, 2500);
        recipe_.seed = seed;
        recipe_.passes = shape_.passes;
        recipe_.step_over = shape_.step_over;
        recipe_.length = shape_.length;
        recipe_.feed = speed;
        recipe_.period = kind_.period;
        recipe_.quantum = kind_.quantum;
        recipe_.noise = uniform(g, 0.0001, 0.0004);
    }

    [[nodiscard]] double arc_length_of(std::size_t pass) const {
        return arc_length_[passes_[pass].second] - arc_length_[passes_[pass].first];
    }

    /// The point of a pass closest to a place.
    [[nodiscard]] std::size_t nearest_on(std::size_t pass, const Vec3& place) const {
        std::size_t best = passes_[pass].first;
        for (std::size_t i = passes_[pass].first; i <= passes_[pass].second; ++i) {
            if ((course_[i].at - place).squaredNorm() < (course_[best].at - place).squaredNorm()) best = i;
        }
        return best;
    }

    /// The number of earlier or later passes within about three step-overs: there must be some on both sides.
    [[nodiscard]] int passes_beside(std::size_t pass, const Vec3& place, bool before) const {
        int count = 0;
        for (std::size_t k = 0; k < passes_.size(); ++k) {
            if (before ? k >= pass : k <= pass) continue;
            const double distance = (course_[nearest_on(k, place)].at - place).norm();
            count += distance < 3.4 * shape_.step_over ? 1 : 0;
        }
        return count;
    }

    void plant() {
        const int wanted = whole(generator_, 2, 3);
        std::vector<Vec3> taken;
        for (int attempt = 0; attempt < 400 && static_cast<int>(taken.size()) < wanted; ++attempt) try_to_plant(taken);
    }

    [[nodiscard]] Fault draw_fault() {
        if (kind_.fault != Fault::all) return kind_.fault;
        constexpr std::array any{Fault::dip,    Fault::dip,       Fault::rise,     Fault::oscillation, Fault::lag,
                                 Fault::offset, Fault::short_dip, Fault::long_dip, Fault::end_dip};
        return any[static_cast<std::size_t>(whole(generator_, 0, static_cast<int>(any.size()) - 1))];
    }

    /// Draws the length [mm], position and amplitude of a defect, and plants it if there is room.
    void try_to_plant(std::vector<Vec3>& taken) {
        Generator& g = generator_;
        const Fault fault = draw_fault();
        const auto pass = static_cast<std::size_t>(whole(g, 0, static_cast<int>(passes_.size()) - 1));
        const double whole_arc_length = arc_length_of(pass);
        const double speed = recipe_.feed;
        double length = std::max(uniform(g, 1.0, 3.5), speed * uniform(g, 0.05, 0.12));
        if (fault == Fault::short_dip) length = std::max(0.8, speed * uniform(g, 0.045, 0.065));
        if (fault == Fault::long_dip) length = whole_arc_length / 3;
        const double edge = std::max(0.3, 0.01 * speed);
        // Outside the ramps of a pass, where the tool is at full speed.
        const double ramp = speed * speed / (2 * acceleration_) + speed * jerk_seconds;
        double room = 3 + ramp + 0.5 * length + edge;
        double middle = 0;
        if (2 * room >= whole_arc_length) return;
        middle = uniform(g, room, whole_arc_length - room);
        if (fault == Fault::end_dip) {
            middle = uniform(g, 3, 8) + std::max(0.0, ramp - 3) + 0.5 * length + edge;
            if (middle > 0.5 * whole_arc_length) return;
            if (whole(g, 0, 1) == 1) middle = whole_arc_length - middle;
        }
        const auto at = static_cast<std::size_t>(
            std::lower_bound(arc_length_.begin(), arc_length_.end(), arc_length_[passes_[pass].first] + middle) -
            arc_length_.begin());
        const Vec3 place = course_[at].at;
        const double apart = 6 + length;
        if (std::any_of(taken.begin(), taken.end(), [&](const Vec3& t) { return (t - place).norm() < apart; })) return;
        if (passes_beside(pass, place, true) < 3 || passes_beside(pass, place, false) < 3) return;
        Defect d = draw_amplitude(fault);
        d.edge = edge;
        d.from = middle - 0.5 * length;
        d.to = middle + 0.5 * length;
        d.first_pass = d.last_pass = static_cast<int>(pass);
        if (fault != Fault::offset && fault != Fault::pair && whole(g, 0, 3) == 0) d.last_pass += 1;
        if (!lay(d, place)) return;
        taken.push_back(place);
        if (fault != Fault::pair) return;
        // Two passes away on the same side, with the opposite sign.
        Defect other = d;
        other.first_pass = other.last_pass = d.first_pass + 2;
        other.amplitude *= -uniform(g, 0.8, 1.1);
        (void)lay(other, place);
    }

    [[nodiscard]] Defect draw_amplitude(Fault fault) {
        Generator& g = generator_;
        Defect d;
        const double sign = whole(g, 0, 1) == 0 ? -1.0 : 1.0;
        const double height = sign * uniform(g, 0.004, 0.011);
        switch (fault) {
            case Fault::rise:
                d.kind = Kind::speed;
                d.amplitude = -uniform(g, 0.08, 0.3);
                break;
            case Fault::oscillation:
                d.kind = Kind::oscillation;
                d.amplitude = uniform(g, 0.1, 0.25);
                break;
            case Fault::pair:
                d.kind = whole(g, 0, 2) == 0 ? Kind::speed : Kind::lag;
                d.amplitude = d.kind == Kind::speed ? sign * uniform(g, 0.1, 0.3) : height;
                break;
            case Fault::lag:
                d.kind = Kind::lag;
                d.amplitude = height;
                break;
            case Fault::offset:
                d.kind = Kind::offset;
                d.amplitude = height;
                break;
            default:
                d.kind = Kind::speed;
                d.amplitude = fault == Fault::short_dip ? uniform(g, 0.15, 0.4) : uniform(g, 0.08, 0.4);
        }
        return d;
    }

    /// Adds the sections of a defect on its passes; false if one of them is too far away.
    bool lay(Defect d, const Vec3& place) {
        std::vector<Section> sections;
        Vec3 here = place;
        for (int pass = d.first_pass; pass <= d.last_pass; ++pass) {
            if (static_cast<std::size_t>(pass) >= passes_.size()) return false;
            const std::size_t at = nearest_on(static_cast<std::size_t>(pass), here);
            if ((course_[at].at - here).norm() > 2.5 * shape_.step_over) return false;
            here = course_[at].at;
            const auto& range = passes_[static_cast<std::size_t>(pass)];
            sections.push_back({recipe_.defects.size(), range.first, range.second, arc_length_[at]});
        }
        // Waves have at least a fixed length in time: with a period of 4 ms, a visible wave is longer.
        d.wave = std::max({1.0, 0.02 * recipe_.feed, 6 * recipe_.period * recipe_.feed});
        if (d.kind == Kind::oscillation) {
            const double middle = 0.5 * (d.from + d.to);
            const double half = std::max(0.5 * (d.to - d.from), 1.5 * d.wave);
            d.from = middle - half;
            d.to = middle + half;
        }
        recipe_.defects.push_back(d);
        sections_.insert(sections_.end(), sections.begin(), sections.end());
        return true;
    }

    /// Calls f(defect, window, arc length from the middle) for the faults at a point of the course.
    template <typename F>
    void for_each_fault(std::size_t i, double s, F&& f) const {
        for (const Section& section : sections_) {
            if (i < section.first || i > section.last) continue;
            const Defect& d = recipe_.defects[section.defect];
            const double half = 0.5 * (d.to - d.from);
            const double off = s - section.middle;
            const double u = std::clamp((half + d.edge - std::abs(off)) / d.edge, 0.0, 1.0);
            if (u > 0) f(section.defect, 0.5 - 0.5 * std::cos(pi * u), off);
        }
    }

    /// Applies programmed offsets to the course itself.
    void offset_points() {
        for (std::size_t i = 0; i < course_.size(); ++i) {
            double off = 0;
            for_each_fault(i, arc_length_[i], [&](std::size_t k, double window, double) {
                if (recipe_.defects[k].kind == Kind::offset) off += window * recipe_.defects[k].amplitude;
            });
            course_[i].at += off * course_[i].normal;
        }
    }

    void write_program() {
        const auto word = [](Motion motion) { return motion == Motion::rapid ? "G0" : "G1"; };
        const auto text = [](std::string_view code, const Vec3& p) {
            return fmt::format("{} X{:.4f} Y{:.4f} Z{:.4f}\n", code, p.x(), p.y(), p.z());
        };
        const Vec3 start = course_.front().at;
        std::string& out = log_.program;
        out = fmt::format("%\nO2000\nG90 G17 G21 G54\nG1 F{:.0f}\nG0 X{:.4f} Y{:.4f} Z{:.3f}\nG1 Z{:.4f}\n", kind_.feed,
                          start.x(), start.y(), start.z() + 20, start.z());
        std::uint32_t line = 7;
        for (; line < first_line; ++line) out += fmt::format("(line {})\n", line);
        line_of_.assign(course_.size(), line);
        double from = 0;
        for (std::size_t i = 1; i < course_.size(); ++i) {
            line_of_[i] = line;
            const bool last = i + 1 == course_.size();
            const bool turns = !last && (course_[i + 1].motion != course_[i].motion || bends_sharply(i));
            const bool long_enough = course_[i].motion == Motion::cut && arc_length_[i] - from >= shape_.block;
            if (!last && !turns && !long_enough) continue;
            out += text(word(course_[i].motion), course_[i].at);
            from = arc_length_[i];
            ++line;
        }
        line_of_[0] = first_line;
        out += "M30\n%\n";
    }
    [[nodiscard]] bool bends_sharply(std::size_t i) const {
        const Vec3 in = course_[i].at - course_[i - 1].at;
        const Vec3 out = course_[i + 1].at - course_[i].at;
        return in.dot(out) < 0.9 * in.norm() * out.norm();
    }

    /// Tangent and curvature.
    void bend(std::size_t i, Vec3& tangent, Vec3& curvature) const {
        const std::size_t n = course_.size();
        std::size_t a = i, b = i;
        while (a > 0 && arc_length_[i] - arc_length_[a] < bend_reach) --a;
        while (b + 1 < n && arc_length_[b] - arc_length_[i] < bend_reach) ++b;
        const Vec3 in = course_[i].at - course_[a].at;
        const Vec3 out = course_[b].at - course_[i].at;
        tangent = (in + out).normalized();
        curvature.setZero();
        if (in.norm() < 1e-9 || out.norm() < 1e-9) return;
        curvature = 2 * (out.normalized() - in.normalized()) / (in.norm() + out.norm());
    }

    [[nodiscard]] std::vector<double> plan() {
        const std::size_t n = course_.size();
        std::vector<double> v(n);
        std::vector<double> scatter;
        for (std::size_t k = 0; k <= passes_.size() * 6; ++k) scatter.push_back(1 + 0.004 * normal(generator_));
        for (std::size_t i = 0; i < n; ++i) {
            Vec3 tangent;
            Vec3 curvature;
            bend(i, tangent, curvature);
            v[i] = std::min(course_[i].motion == Motion::rapid ? rapid_speed : recipe_.feed,
                            std::sqrt(acceleration_ / std::max(curvature.norm(), 1e-9)));
            for_each_fault(i, arc_length_[i], [&](std::size_t k, double window, double off) {
                const Defect& d = recipe_.defects[k];
                if (d.kind == Kind::speed) v[i] *= 1 - d.amplitude * window;
                if (d.kind == Kind::oscillation) v[i] *= 1 + d.amplitude * window * std::sin(2 * pi * off / d.wave);
            });
            if (course_[i].pass < 0) continue;
            const auto pass = static_cast<std::size_t>(course_[i].pass);
            const double along =
                6 * (arc_length_[i] - arc_length_[passes_[pass].first]) / std::max(arc_length_of(pass), 1e-9);
            const auto knot = static_cast<std::size_t>(std::min(5.0, std::floor(along)));
            const double share = along - static_cast<double>(knot);
            v[i] *= (1 - share) * scatter[6 * pass + knot] + share * scatter[6 * pass + knot + 1];
        }
        return rounded(accelerated(std::move(v)));
    }

    [[nodiscard]] std::vector<double> accelerated(std::vector<double> v) const {
        v.front() = v.back() = creep;
        const auto limit = [&](std::size_t from, std::size_t to) {
            const double ds = std::abs(arc_length_[to] - arc_length_[from]);
            v[to] = std::min(v[to], std::sqrt(v[from] * v[from] + 2 * acceleration_ * ds));
        };
        for (std::size_t i = 1; i < v.size(); ++i) limit(i - 1, i);
        for (std::size_t i = v.size() - 1; i > 0; --i) limit(i, i - 1);
        return v;
    }

    /// Limits the jerk: speeds are averaged over some milliseconds, which is a shorter distance than to the next corner.
    [[nodiscard]] std::vector<double> rounded(const std::vector<double>& v) const {
        std::vector<double> sum(v.size() + 1, 0);
        for (std::size_t i = 0; i < v.size(); ++i) sum[i + 1] = sum[i] + v[i];
        std::vector<double> out(v.size());
        for (std::size_t i = 0; i < v.size(); ++i) {
            const auto reach = static_cast<std::size_t>(0.5 * jerk_seconds * v[i] / shape_.spacing);
            const std::size_t k = std::min({reach, i, v.size() - 1 - i});
            out[i] = (sum[i + k + 1] - sum[i - k]) / static_cast<double>(2 * k + 1);
        }
        return out;
    }

    void sample(const std::vector<double>& speed) {
        log_.truth.resize(recipe_.defects.size());
        std::size_t i = 1;
        double time = 0;     // time of point i − 1
        double next = 0;     // time of the next record
        double scatter = 0;  // scatter of the time of the record
        const auto seconds = [&] { return (arc_length_[i] - arc_length_[i - 1]) / (0.5 * (speed[i] + speed[i - 1])); };
        while (i < course_.size()) {
            const double step = seconds();
            if (next + scatter > time + step) {
                time += step;
                ++i;
                continue;
            }
            record(speed, i, step > 0 ? (next + scatter - time) / step : 1.0);
            next += recipe_.period;
            if (kind_.clock > 0) scatter = kind_.clock * normal(generator_);
        }
        log_.recipe = recipe_;
    }

    void record(const std::vector<double>& speed, std::size_t i, double share) {
        const double s = arc_length_[i - 1] + share * (arc_length_[i] - arc_length_[i - 1]);
        const double v = speed[i - 1] + share * (speed[i] - speed[i - 1]);
        const Vec3 p = course_[i - 1].at + share * (course_[i].at - course_[i - 1].at);
        Vec3 tangent;
        Vec3 curvature;
        bend(i, tangent, curvature);
        const Vec3& n = course_[i].normal;
        double off = give * curvature.dot(n) * v * v;
        const auto point = static_cast<PointIndex>(log_.line.size());
        for_each_fault(i, s, [&](std::size_t k, double window, double) {
            if (recipe_.defects[k].kind == Kind::lag) off += window * recipe_.defects[k].amplitude;
            if (window >= 0.5) log_.truth[k].push_back(point);
        });
        const Vec3 measured = p - delay * v * tangent + off * n;
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
            const auto grid = [&](double value) { return std::round(value / recipe_.quantum) * recipe_.quantum; };
            log_.commanded[axis].push_back(grid(p[axis]));
            log_.measured[axis].push_back(grid(measured[axis] + recipe_.noise * normal(generator_)));
        }
        log_.pass.push_back(course_[i].pass);
        log_.line.push_back(line_of_[i]);
        log_.speed.push_back(v);
    }

    const LogKind& kind_;
    Generator generator_;
    CourseRecipe shape_;
    Recipe recipe_;
    double acceleration_ = 1000;  ///< [mm/s²] acceleration along and across the path
    std::vector<CoursePoint> course_;
    std::vector<double> arc_length_;  ///< [mm] arc length at each point of the course
    std::vector<std::pair<std::size_t, std::size_t>> passes_;
    std::vector<Section> sections_;
    std::vector<std::uint32_t> line_of_;
    PlantedLog log_;
};

}  // namespace

std::span<const LogKind> log_kinds() { return kinds; }

PlantedLog make_log_of_kind(const LogKind& kind, std::uint64_t seed, bool clean) {
    return Maker(kind, seed, clean).make();
}

}  // namespace clsurf::planted
