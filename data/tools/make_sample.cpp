// clsurf_make_sample PATTERN POINTS PROGRAM.nc LOG.biip [options]: a finishing program on a wavy surface and the
// log of an ideal run of it, for benchmarks. The size of the part follows from the number of points:
// 0.05 mm between records and 0.1 mm between passes, as usual in finishing; 10^8 points are a
// square of 0.7 m. Both files are streamed pass by pass: memory does not depend on the number of points.
//
// The axes lag by 3, 4 and 5 ms unless --lag sets other values: the feedback of a zigzag then differs from pass to pass on
// every slope, as on a badly tuned machine. With one lag for all axes and a flat surface, the only defects are those
// of --slow, which are printed.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/compile.h>
#include <fmt/format.h>

#include "core/error.h"
#include "core/geometry.h"
#include "io/files/mapped_file.h"
#include "io/formats/biip.h"
#include "io/formats/program_identity.h"

namespace clsurf {
namespace {

constexpr double period = 0.001;      // [s]
constexpr double feed = 50;           // [mm/s]
constexpr double rapid_feed = 250;    // [mm/s]
constexpr double corner_speed = 5;    // [mm/s] speed at the ends of passes
constexpr double acceleration = 500;  // [mm/s²]
constexpr double step_over = 0.1;     // [mm]
constexpr double retract = 5;         // [mm] height above the surface
constexpr double slow_feed = 0.5;     // share of the feed at a slow place
constexpr double slow_length = 30;    // [mm]

enum class Pattern { zigzag, one_way, loops };
constexpr std::array<std::string_view, 3> pattern_names{"zigzag", "one-way", "loops"};

/// The settings of the command line.
struct Wishes {
    Pattern pattern = Pattern::zigzag;
    std::int64_t points = 0;
    double line = 0.5;                               ///< [mm] length of a programmed line
    double wave = 100;                               ///< [mm] wavelength of the surface
    double height = 3;                               ///< [mm] amplitude of its waves, if the part is larger than a wave
    std::array<double, 3> lag{0.003, 0.004, 0.005};  ///< [s] lag of the feedback
    std::int64_t slow = 0;                           ///< passes with a slow place
};

struct Waypoint {
    Vec3 position;
    bool rapid;
};

double to_micrometre(double v) { return std::round(v * 1000) / 1000; }

/// The side of a raster, or the diameter of the outermost loop, for the given number of points [mm].
double size_of(const Wishes& wishes) {
    const double area = static_cast<double>(wishes.points) * feed * period * step_over;
    return std::max(4.0, wishes.pattern == Pattern::loops ? std::sqrt(area * 4 / std::numbers::pi) : std::sqrt(area));
}

/// The passes of a part in order.
class Part {
public:
    explicit Part(const Wishes& wishes)
        : wishes_(wishes), size_(size_of(wishes)), wave_(std::min(size_, wishes.wave)) {}

    /// The largest coordinates [mm].
    [[nodiscard]] double size() const { return size_; }
    /// Sets the passes with a slow place, in increasing order.
    void set_slow(std::vector<std::int64_t> passes) { slow_ = std::move(passes); }
    [[nodiscard]] bool is_slow(std::int64_t k) const { return std::ranges::binary_search(slow_, k); }

    /// The position of the tool before the first pass.
    [[nodiscard]] Vec3 start() const { return {0, 0, to_micrometre(height_over_all())}; }

    /// The waypoints of pass k, which follow the last waypoint of pass k − 1; empty: no more passes.
    [[nodiscard]] std::vector<Waypoint> pass(std::int64_t k) const {
        std::vector<Waypoint> route;
        if (wishes_.pattern == Pattern::loops) {
            add_loop(route, 0.5 * size_ - static_cast<double>(k) * step_over, k == 0);
            return route;
        }
        const double y = static_cast<double>(k) * step_over;
        const bool back = wishes_.pattern == Pattern::zigzag && k % 2 == 1;
        if (k == 0) {
            route.push_back({place(0, y, height_over_all()), true});
        } else if (wishes_.pattern == Pattern::one_way) {
            route.push_back({place(size_, y - step_over, height_over_all()), true});
            route.push_back({place(0, y, height_over_all()), true});
        }
        route.push_back({on_surface(back ? size_ : 0, y), false});
        const auto lines = static_cast<int>(std::ceil(size_ / wishes_.line));
        for (int i = 1; i <= lines; ++i) {
            const double x = size_ * i / lines;
            route.push_back({on_surface(back ? size_ - x : x, y), false});
        }
        return route;
    }

private:
    void add_loop(std::vector<Waypoint>& route, double radius, bool first) const {
        if (radius < wishes_.line) return;
        if (first) route.push_back({place(radius, 0, height_over_all()), true});
        const auto lines = static_cast<int>(std::ceil(2 * std::numbers::pi * radius / wishes_.line));
        for (int i = 0; i <= lines; ++i) {
            const double angle = 2 * std::numbers::pi * i / lines;
            route.push_back({on_surface(radius * std::cos(angle), radius * std::sin(angle)), false});
        }
    }
    [[nodiscard]] double height_over_all() const { return std::max(0.03 * size_, wishes_.height) + retract; }
    /// Rounded to the three decimals of the program.
    static Vec3 place(double x, double y, double z) { return {to_micrometre(x), to_micrometre(y), to_micrometre(z)}; }
    [[nodiscard]] Vec3 on_surface(double x, double y) const {
        const double turns = 2 * std::numbers::pi / wave_;
        const double height = wishes_.height * wave_ / wishes_.wave;
        return place(x, y, height * std::cos(turns * x) * std::cos(0.7 * turns * y));
    }

    Wishes wishes_;
    double size_ = 0, wave_ = 0;      ///< [mm]
    std::vector<std::int64_t> slow_;  ///< passes, increasing
};

/// Distance [mm] from a slow place in the middle of a section; 0: inside.
double distance_from_slow_place(double gone, double length) {
    return std::max(0.0, std::abs(gone - 0.5 * length) - 0.5 * std::min(slow_length, length / 3));
}

/// The speed [mm/s] allowed at that distance from a slow place.
double speed_near_slow_place(double distance) {
    const double least = slow_feed * feed;
    return std::sqrt(least * least + 2 * acceleration * distance);
}

/// Moves along waypoints with bounded acceleration; calls record(position, waypoint index, whether the place is slow) once per
/// period. `slow`: cutting sections have a slow place in their middle.
template <typename Record>
void run(Vec3 from, const std::vector<Waypoint>& route, bool slow, Record&& record) {
    std::size_t i = 0;
    while (i < route.size()) {
        // A section of one kind begins and ends at low speed.
        std::size_t end = i;
        double length = 0;
        for (Vec3 last = from; end < route.size() && route[end].rapid == route[i].rapid; ++end) {
            length += (route[end].position - last).norm();
            last = route[end].position;
        }
        const double most = route[i].rapid ? rapid_feed : feed;
        double gone = 0;         // arc length in the section
        double before_line = 0;  // arc length at the beginning of the line
        while (gone < length) {
            const double speed_up = std::sqrt(corner_speed * corner_speed + 2 * acceleration * gone);
            const double slow_down = std::sqrt(corner_speed * corner_speed + 2 * acceleration * (length - gone));
            double speed = std::min({most, speed_up, slow_down});
            const bool has_slow_place = slow && !route[i].rapid;
            const double distance = has_slow_place ? distance_from_slow_place(gone, length) : length;
            if (has_slow_place) speed = std::min(speed, speed_near_slow_place(distance));
            gone = std::min(length, gone + speed * period);
            double line = (route[i].position - from).norm();
            while (i + 1 < end && gone > before_line + line) {
                before_line += line;
                from = route[i++].position;
                line = (route[i].position - from).norm();
            }
            const double fraction = line > 0 ? std::min(1.0, (gone - before_line) / line) : 1.0;
            if (!record(Vec3(from + fraction * (route[i].position - from)), i, distance == 0)) return;
        }
        from = route[end - 1].position;
        i = end;
    }
}

/// Evenly spaced passes among those for which there are enough points.
std::vector<std::int64_t> choose_slow(const Part& part, const Wishes& wishes) {
    std::int64_t points_of_one = 0;
    const std::vector<Waypoint> before = part.pass(0), one = part.pass(1);
    if (one.empty()) return {};
    run(before.back().position, one, false, [&](const Vec3&, std::size_t, bool) { return ++points_of_one > 0; });
    // Loops become shorter: their number is the radius of the disc over the step-over.
    const double there = wishes.pattern == Pattern::loops
                             ? 0.5 * part.size() / step_over
                             : static_cast<double>(wishes.points) / static_cast<double>(points_of_one);
    std::vector<std::int64_t> passes;
    for (std::int64_t i = 0; i < wishes.slow; ++i)
        passes.push_back(std::llround((static_cast<double>(i) + 0.5) * there / static_cast<double>(wishes.slow)));
    return passes;
}

/// Writes the program up to the pass in which the points are used up.
void write_program(const std::string& path, const Part& part, const Wishes& wishes) {
    io::AtomicFile file(path);
    file.write(fmt::format("(clsurf_make_sample {} {})\nG21 G17 G90 G94\nF{:.0f}\n",
                           pattern_names[static_cast<std::size_t>(wishes.pattern)], wishes.points, feed * 60));
    std::int64_t left = wishes.points;
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
        run(from, route, part.is_slow(k), [&](const Vec3&, std::size_t, bool) { return --left > 0; });
        from = route.back().position;
    }
    file.write("M30\n");
    file.commit();
}

/// The size [mm] of one unit in the log, such that 32 bits are enough for the part: a nanometre, or ten on large parts.
double raw_unit_of(const Part& part) {
    constexpr double largest = 1500;  // [mm] size of a part; a raster may exceed it
    return part.size() <= largest ? 1e-6 : 1e-5;
}

class LogFile {
public:
    LogFile(const std::string& path, const std::string& metadata, const Part& part, const std::array<double, 3>& lag)
        : raw_unit_(raw_unit_of(part)),
          writer_(path,
                  {{"cmd.x", "mm", ScalarType::i32, raw_unit_},
                   {"cmd.y", "mm", ScalarType::i32, raw_unit_},
                   {"cmd.z", "mm", ScalarType::i32, raw_unit_},
                   {"fb.x", "mm", ScalarType::i32, raw_unit_},
                   {"fb.y", "mm", ScalarType::i32, raw_unit_},
                   {"fb.z", "mm", ScalarType::i32, raw_unit_},
                   {"line", "", ScalarType::u32, 1.0}},
                  period, metadata),
          feedback_(part.start()) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            approach_[axis] = lag[axis] > 0 ? 1 - std::exp(-period / lag[axis]) : 1;
    }

    void record(const Vec3& commanded, std::uint32_t line) {
        std::array<std::int32_t, 7> raw;
        for (int axis = 0; axis < 3; ++axis) {
            feedback_[axis] += (commanded[axis] - feedback_[axis]) * approach_[static_cast<std::size_t>(axis)];
            raw[static_cast<std::size_t>(axis)] = static_cast<std::int32_t>(std::lround(commanded[axis] / raw_unit_));
            raw[static_cast<std::size_t>(axis) + 3] =
                static_cast<std::int32_t>(std::lround(feedback_[axis] / raw_unit_));
        }
        raw[6] = static_cast<std::int32_t>(line);
        writer_.append(std::as_bytes(std::span(raw)));
    }
    void close() { writer_.close(); }

private:
    double raw_unit_;
    io::BiipWriter writer_;
    Vec3 feedback_;
    std::array<double, 3> approach_{};
};

/// Where a pass was slow.
struct SlowPlace {
    Vec3 first = Vec3::Zero(), last = Vec3::Zero();
    std::uint32_t first_line = 0, last_line = 0;  ///< 0: nowhere

    void add(const Vec3& position, std::uint32_t line) {
        if (first_line == 0) first = position;
        if (first_line == 0) first_line = line;
        last = position;
        last_line = line;
    }
    void print(std::int64_t pass) const {
        if (first_line == 0) return;
        fmt::print("pass {} is slow from X{:.3f} Y{:.3f} to X{:.3f} Y{:.3f}, lines {} to {}\n", pass + 1, first.x(),
                   first.y(), last.x(), last.y(), first_line, last_line);
    }
};

void write_log(const std::string& path, const std::string& program, const Part& part, const Wishes& wishes) {
    const ProgramReference ran = io::identify(io::map_file(program));
    LogFile log(path, io::with_programs("", std::span(&ran, 1)), part, wishes.lag);
    constexpr std::uint32_t lines_of_head = 3;
    std::uint32_t line = lines_of_head + 1;  // line of the pass's first waypoint
    std::int64_t left = wishes.points;
    Vec3 last = part.start();
    for (std::int64_t k = 0; left > 0; ++k) {
        const std::vector<Waypoint> route = part.pass(k);
        if (route.empty()) break;
        const Vec3 from = last;
        SlowPlace slow;
        run(from, route, part.is_slow(k), [&](const Vec3& p, std::size_t waypoint, bool is_slow) {
            last = p;
            const std::uint32_t at = line + static_cast<std::uint32_t>(waypoint);
            log.record(p, at);
            if (is_slow) slow.add(p, at);
            return --left > 0;
        });
        slow.print(k);
        if (left > 0) last = route.back().position;
        line += static_cast<std::uint32_t>(route.size());
    }
    for (; left > 0; --left) log.record(last, line);  // M30
    log.close();
}

constexpr const char* usage =
    "usage: clsurf_make_sample zigzag|one-way|loops POINTS PROGRAM.nc LOG.biip [options]\n"
    "  --line MM    length of a programmed line (0.5)\n"
    "  --wave MM    length of the waves of the surface (100)\n"
    "  --height MM  height of the waves (3)\n"
    "  --lag MS     lag of all axes, 0: none (3, 4 and 5 ms of X, Y and Z)\n"
    "  --slow N     N passes are slow for 30 mm: half of the feed. They are printed (0)\n";

template <typename Number>
bool read_number(std::string_view text, Number least, Number& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size() && number >= least;
}

/// Reads one of the options with its value; false: not such an option.
bool read_option(std::string_view name, std::string_view value, Wishes& wishes) {
    constexpr double shortest = 0.01;  // [mm]
    if (name == "--line") return read_number(value, shortest, wishes.line);
    if (name == "--wave") return read_number(value, shortest, wishes.wave);
    if (name == "--height") return read_number(value, 0.0, wishes.height);
    if (name == "--slow") return read_number(value, std::int64_t{0}, wishes.slow);
    double milliseconds = 0;
    if (name != "--lag" || !read_number(value, 0.0, milliseconds)) return false;
    wishes.lag.fill(milliseconds / 1000);
    return true;
}

int make(const std::vector<std::string>& words) {
    constexpr std::size_t arguments = 4;
    Wishes wishes;
    bool understood = words.size() >= arguments && words.size() % 2 == 0;
    if (understood) {
        const auto* const name = std::ranges::find(pattern_names, words[0]);
        wishes.pattern = static_cast<Pattern>(name - pattern_names.begin());
        understood = name != pattern_names.end() && read_number(words[1], std::int64_t{1}, wishes.points);
    }
    for (std::size_t k = arguments; understood && k < words.size(); k += 2)
        understood = read_option(words[k], words[k + 1], wishes);
    if (!understood) {
        std::fputs(usage, stderr);
        return 2;
    }
    Part part(wishes);
    part.set_slow(choose_slow(part, wishes));
    write_program(words[2], part, wishes);
    write_log(words[3], words[2], part, wishes);
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
