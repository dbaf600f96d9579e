// clsurf_make_sample PATTERN POINTS PROGRAM.nc LOG.biip: a finishing program on a wavy surface and the
// log of an ideal run of it, for benchmarks. The size of the part follows from the number of points:
// 0.05 mm from record to record and 0.1 mm between passes, as finishing has them; 10^8 points are a
// square of 0.7 m. Both files are streamed a pass at a time: memory does not grow with the points.
#include <charconv>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string_view>

#include <fmt/compile.h>
#include <fmt/format.h>

#include "core/error.h"
#include "core/geometry.h"
#include "io/files/mapped_file.h"
#include "io/formats/biip.h"
#include "io/formats/program_identity.h"

namespace clsurf {
namespace {

constexpr double period = 0.001;                           // [s]
constexpr double feed = 50;                                // [mm/s]
constexpr double rapid_feed = 250;                         // [mm/s]
constexpr double corner_speed = 5;                         // [mm/s] at the ends of passes
constexpr double acceleration = 500;                       // [mm/s²]
constexpr double step_over = 0.1;                          // [mm]
constexpr double chord = 0.5;                              // [mm] of a programmed line
constexpr double retract = 5;                              // [mm] over the surface
constexpr double raw_unit = 1e-6;                          // [mm] of a position in the log
constexpr std::array<double, 3> lag{0.003, 0.004, 0.005};  // [s] of the feedback

enum class Pattern { zigzag, one_way, loops };

struct Waypoint {
    Vec3 position;
    bool rapid;
};

double to_micrometre(double v) { return std::round(v * 1000) / 1000; }

/// The passes of a part, one after the other.
class Part {
public:
    Part(Pattern pattern, std::int64_t points) : pattern_(pattern) {
        const double area = static_cast<double>(points) * feed * period * step_over;
        // The outermost loop bounds the part; a raster grows until the points are used up.
        size_ = pattern == Pattern::loops ? std::sqrt(area * 4 / std::numbers::pi) : std::sqrt(area);
        size_ = std::max(size_, 4.0);
    }

    /// Where the tool is before the first pass.
    [[nodiscard]] Vec3 start() const { return {0, 0, to_micrometre(height_over_all())}; }

    /// The waypoints of pass k after the last one of k − 1; empty: there are no more.
    [[nodiscard]] std::vector<Waypoint> pass(std::int64_t k) const {
        std::vector<Waypoint> route;
        if (pattern_ == Pattern::loops) {
            add_loop(route, 0.5 * size_ - static_cast<double>(k) * step_over, k == 0);
            return route;
        }
        const double y = static_cast<double>(k) * step_over;
        const bool back = pattern_ == Pattern::zigzag && k % 2 == 1;
        if (k == 0) {
            route.push_back({place(0, y, height_over_all()), true});
        } else if (pattern_ == Pattern::one_way) {
            route.push_back({place(size_, y - step_over, height_over_all()), true});
            route.push_back({place(0, y, height_over_all()), true});
        }
        route.push_back({on_surface(back ? size_ : 0, y), false});
        const auto lines = static_cast<int>(std::ceil(size_ / chord));
        for (int i = 1; i <= lines; ++i) {
            const double x = size_ * i / lines;
            route.push_back({on_surface(back ? size_ - x : x, y), false});
        }
        return route;
    }

private:
    void add_loop(std::vector<Waypoint>& route, double radius, bool first) const {
        if (radius < chord) return;
        if (first) route.push_back({place(radius, 0, height_over_all()), true});
        const auto lines = static_cast<int>(std::ceil(2 * std::numbers::pi * radius / chord));
        for (int i = 0; i <= lines; ++i) {
            const double angle = 2 * std::numbers::pi * i / lines;
            route.push_back({on_surface(radius * std::cos(angle), radius * std::sin(angle)), false});
        }
    }
    [[nodiscard]] double height_over_all() const { return 0.03 * size_ + retract; }
    /// As the program's three decimals have it.
    static Vec3 place(double x, double y, double z) { return {to_micrometre(x), to_micrometre(y), to_micrometre(z)}; }
    [[nodiscard]] Vec3 on_surface(double x, double y) const {
        const double wave = 2 * std::numbers::pi / std::min(size_, 100.0);
        return place(x, y, 0.03 * std::min(size_, 100.0) * std::cos(wave * x) * std::cos(0.7 * wave * y));
    }

    Pattern pattern_;
    double size_ = 0;  ///< [mm]
};

/// Runs along waypoints with bounded acceleration; record(position, waypoint index) once a period.
template <typename Record>
void run(Vec3 from, const std::vector<Waypoint>& route, Record&& record) {
    std::size_t i = 0;
    while (i < route.size()) {
        // A section of one kind begins and ends slowly.
        std::size_t end = i;
        double length = 0;
        for (Vec3 last = from; end < route.size() && route[end].rapid == route[i].rapid; ++end) {
            length += (route[end].position - last).norm();
            last = route[end].position;
        }
        const double most = route[i].rapid ? rapid_feed : feed;
        double gone = 0;         // of the section
        double before_line = 0;  // arc length gone when the line began
        while (gone < length) {
            const double speed_up = std::sqrt(corner_speed * corner_speed + 2 * acceleration * gone);
            const double slow_down = std::sqrt(corner_speed * corner_speed + 2 * acceleration * (length - gone));
            gone = std::min(length, gone + std::min({most, speed_up, slow_down}) * period);
            double line = (route[i].position - from).norm();
            while (i + 1 < end && gone > before_line + line) {
                before_line += line;
                from = route[i++].position;
                line = (route[i].position - from).norm();
            }
            const double fraction = line > 0 ? std::min(1.0, (gone - before_line) / line) : 1.0;
            if (!record(Vec3(from + fraction * (route[i].position - from)), i)) return;
        }
        from = route[end - 1].position;
        i = end;
    }
}

/// The program's text up to the pass in which the points are used up.
void write_program(const std::string& path, const Part& part, std::string_view name, std::int64_t points) {
    io::AtomicFile file(path);
    file.write(fmt::format("(clsurf_make_sample {} {})\nG21 G17 G90 G94\nF{:.0f}\n", name, points, feed * 60));
    std::int64_t left = points;
    Vec3 from = part.start();
    fmt::memory_buffer text;
    bool rapid = false;
    bool first = true;
    for (std::int64_t k = 0; left > 0; ++k) {
        const std::vector<Waypoint> route = part.pass(k);
        if (route.empty()) break;
        text.clear();
        for (const Waypoint& w : route) {
            if (first || w.rapid != rapid) text.append(std::string_view(w.rapid ? "G0 " : "G1 "));
            first = false;
            rapid = w.rapid;
            fmt::format_to(std::back_inserter(text), FMT_COMPILE("X{:.3f} Y{:.3f} Z{:.3f}\n"), w.position.x(),
                           w.position.y(), w.position.z());
        }
        file.write(std::string_view(text.data(), text.size()));
        run(from, route, [&](const Vec3&, std::size_t) { return --left > 0; });
        from = route.back().position;
    }
    file.write("M30\n");
    file.commit();
}

class LogFile {
public:
    LogFile(const std::string& path, const std::string& metadata, const Vec3& start)
        : writer_(path,
                  {{"cmd.x", "mm", ScalarType::i32, raw_unit},
                   {"cmd.y", "mm", ScalarType::i32, raw_unit},
                   {"cmd.z", "mm", ScalarType::i32, raw_unit},
                   {"fb.x", "mm", ScalarType::i32, raw_unit},
                   {"fb.y", "mm", ScalarType::i32, raw_unit},
                   {"fb.z", "mm", ScalarType::i32, raw_unit},
                   {"line", "", ScalarType::u32, 1.0}},
                  period, metadata),
          feedback_(start) {}

    void record(const Vec3& commanded, std::uint32_t line) {
        std::array<std::int32_t, 7> raw;
        for (int axis = 0; axis < 3; ++axis) {
            feedback_[axis] += (commanded[axis] - feedback_[axis]) * approach_[static_cast<std::size_t>(axis)];
            raw[static_cast<std::size_t>(axis)] = static_cast<std::int32_t>(std::lround(commanded[axis] / raw_unit));
            raw[static_cast<std::size_t>(axis) + 3] =
                static_cast<std::int32_t>(std::lround(feedback_[axis] / raw_unit));
        }
        raw[6] = static_cast<std::int32_t>(line);
        writer_.append(std::as_bytes(std::span(raw)));
    }
    void close() { writer_.close(); }

private:
    io::BiipWriter writer_;
    Vec3 feedback_;
    std::array<double, 3> approach_{1 - std::exp(-period / lag[0]), 1 - std::exp(-period / lag[1]),
                                    1 - std::exp(-period / lag[2])};
};

void write_log(const std::string& path, const std::string& program, const Part& part, std::int64_t points) {
    const ProgramReference ran = io::identify(io::map_file(program));
    LogFile log(path, io::with_programs("", std::span(&ran, 1)), part.start());
    constexpr std::uint32_t lines_of_head = 3;
    std::uint32_t line = lines_of_head + 1;  // of the pass's first waypoint
    std::int64_t left = points;
    Vec3 last = part.start();
    for (std::int64_t k = 0; left > 0; ++k) {
        const std::vector<Waypoint> route = part.pass(k);
        if (route.empty()) break;
        const Vec3 from = last;
        run(from, route, [&](const Vec3& p, std::size_t waypoint) {
            last = p;
            log.record(p, line + static_cast<std::uint32_t>(waypoint));
            return --left > 0;
        });
        if (left > 0) last = route.back().position;
        line += static_cast<std::uint32_t>(route.size());
    }
    for (; left > 0; --left) log.record(last, line);  // M30
    log.close();
}

int make(const std::vector<std::string>& words) {
    constexpr std::array<std::string_view, 3> names{"zigzag", "one-way", "loops"};
    std::int64_t points = 0;
    const auto name = words.size() == 4 ? std::find(names.begin(), names.end(), words[0]) : names.end();
    if (name == names.end() ||
        std::from_chars(words[1].data(), words[1].data() + words[1].size(), points).ec != std::errc() || points < 1) {
        std::fputs("usage: clsurf_make_sample zigzag|one-way|loops POINTS PROGRAM.nc LOG.biip\n", stderr);
        return 2;
    }
    const Part part(static_cast<Pattern>(name - names.begin()), points);
    write_program(words[2], part, *name, points);
    write_log(words[3], words[2], part, points);
    return 0;
}

}  // namespace
}  // namespace clsurf

int main(int argc, char** argv) {
    try {
        return clsurf::make(std::vector<std::string>(argv + 1, argv + argc));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "clsurf_make_sample: %s\n", error.what());
        return 4;
    }
}
