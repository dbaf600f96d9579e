#include "log/health.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "core/block.h"

namespace clsurf {
namespace {

constexpr double gap_periods = 1.5;     ///< a longer step in time lost records
constexpr double jitter_share = 0.05;   ///< of a period, rms; less is not worth a word
constexpr double jump_factor = 20.0;    ///< a step this many times the 99.9th percentile is a jump
constexpr double least_jump = 0.5;      ///< [mm]
constexpr double stuck_way = 50.0;      ///< [mm] gone on one line before it is called stuck
constexpr double worth_offset = 0.002;  ///< [mm] between commanded and feedback while resting
constexpr double resting_step = 1e-4;   ///< [mm] per record that feedback may move at rest
constexpr std::size_t least_resting = 50;
constexpr double least_quantum = 5e-6;  ///< [mm]; finer steps are rounding of the file
constexpr PointIndex sampled = 200'000;

Diagnostic finding(Severity severity, const char* code, Place where, std::string text, std::string hint = {}) {
    return {severity, code, std::move(where), std::move(text), std::move(hint)};
}

void check_time(const Log& log, Diagnostics& found) {
    const Channel* time = log.find("time");
    if (time == nullptr || log.records < 2) return;
    double squares = 0;
    double worst = 0;
    std::vector<double> t;
    for (PointIndex begin = 0; begin + 1 < log.records; begin += block_points) {
        const PointIndex end = std::min(log.records - 1, begin + block_points);
        t.resize(static_cast<std::size_t>(end - begin + 1));
        copy_block(time->values, begin, t);
        for (std::size_t i = 1; i < t.size(); ++i) {
            const double step = t[i] - t[i - 1];
            const Place where = Place::of_point(log.name, begin + static_cast<PointIndex>(i));
            if (step <= 0) {
                found.add(finding(Severity::warning, "log.time-back", where, fmt::format("time goes back or stands still: {:.6f} s after {:.6f} s", t[i], t[i - 1])));
            } else if (step > gap_periods * log.period) {
                found.add(finding(Severity::warning, "log.time-gap", where, fmt::format("{:.0f} records are missing: a step of {:.6f} s, the period is {:.6f} s", std::round(step / log.period) - 1, step, log.period)));
            } else {
                squares += (step - log.period) * (step - log.period);
                worst = std::max(worst, std::abs(step - log.period));
            }
        }
    }
    const double rms = std::sqrt(squares / static_cast<double>(log.records));
    if (rms > jitter_share * log.period) {
        found.add(finding(Severity::warning, "log.jitter", Place::of_file(log.name), fmt::format("the period jitters by {:.3g} ms rms, {:.3g} ms at most", rms * 1e3, worst * 1e3)));
    }
}

/// What is counted in a block of one channel.
struct ChannelCount {
    PointIndex missing = 0, first_missing = -1;
    bool moves = false;
};

void check_values(const Log& log, Diagnostics& found) {
    for (const Channel& channel : log.channels) {
        const auto blocks = static_cast<std::size_t>((log.records + block_points - 1) / block_points);
        const ScalarType type = channel.values.type;
        const bool real = type == ScalarType::f32 || type == ScalarType::f64;
        const bool position = channel.name.starts_with("cmd.") || channel.name.starts_with("fb.") || channel.name.starts_with("act.");
        if (!real && !position) continue;
        std::vector<ChannelCount> counts(blocks);
        const double first = channel.values.at(0);
        for_each_block(log.records, [&](PointIndex begin, PointIndex end) {
            ChannelCount& count = counts[static_cast<std::size_t>(begin / block_points)];
            std::vector<double> values(static_cast<std::size_t>(end - begin));
            copy_block(channel.values, begin, values);
            for (std::size_t i = 0; i < values.size(); ++i) {
                if (!std::isfinite(values[i])) {
                    if (count.missing++ == 0) count.first_missing = begin + static_cast<PointIndex>(i);
                } else if (values[i] != first) {
                    count.moves = true;
                }
            }
        });
        PointIndex missing = 0;
        PointIndex at = -1;
        bool moves = false;
        for (const ChannelCount& count : counts) {
            if (missing == 0) at = count.first_missing;
            missing += count.missing;
            moves = moves || count.moves;
        }
        if (missing > 0) {
            found.add(finding(Severity::warning, "log.missing-value", Place::of_point(log.name, at), fmt::format("channel '{}' has no value at {} of {} points", channel.name, missing, log.records)));
        }
        if (position && !moves && log.records > 1) {
            found.add(finding(Severity::note, "log.still", Place::of_file(log.name), fmt::format("axis '{}' does not move: {:g} {} all the time", channel.name, first, channel.unit)));
        }
    }
}

void check_channels(const Log& log, Diagnostics& found) {
    if (!log.has(Role::commanded) && !log.has(Role::feedback) && !log.has(Role::actual)) {
        found.add(finding(Severity::error, "log.missing-channel", Place::of_file(log.name), "no role has x, y and z: nothing can be drawn", "name the channels with --mapping or --layout"));
        return;
    }
    if (!log.has(Role::commanded)) found.add(finding(Severity::note, "log.missing-channel", Place::of_file(log.name), "no commanded positions (cmd.x, cmd.y, cmd.z)"));
    if (!log.has(Role::feedback) && !log.has(Role::actual)) found.add(finding(Severity::note, "log.missing-channel", Place::of_file(log.name), "no feedback positions: following errors are not known"));
    if (log.find("line") == nullptr) found.add(finding(Severity::note, "log.missing-channel", Place::of_file(log.name), "no channel 'line': lines are found by geometry"));
}

Role first_role(const Log& log) { return log.has(Role::commanded) ? Role::commanded : log.has(Role::feedback) ? Role::feedback : Role::actual; }

struct Axes {
    std::array<const Channel*, 3> channel{};
    Axes(const Log& log, Role role) {
        for (std::size_t k = 0; k < 3; ++k) channel[k] = log.find(std::string(prefix_of(role)) + "." + "xyz"[k]);
    }
    [[nodiscard]] bool complete() const { return channel[0] != nullptr && channel[1] != nullptr && channel[2] != nullptr; }
    void read(PointIndex begin, std::size_t n, std::array<std::vector<double>, 3>& out) const {
        for (std::size_t k = 0; k < 3; ++k) {
            out[k].resize(n);
            copy_block(channel[k]->values, begin, out[k]);
        }
    }
};

void check_jumps(const Log& log, const Axes& axes, Diagnostics& found) {
    std::array<std::vector<double>, 3> p;
    const auto step_of = [&](std::size_t i) {
        return std::hypot(p[0][i] - p[0][i - 1], p[1][i] - p[1][i - 1], p[2][i] - p[2][i - 1]);
    };
    std::vector<double> steps;
    const PointIndex stretch = 1024;
    const PointIndex stride = std::max<PointIndex>(stretch, log.records / (sampled / stretch));
    for (PointIndex begin = 0; begin < log.records; begin += stride) {
        const auto n = static_cast<std::size_t>(std::min(stretch, log.records - begin));
        axes.read(begin, n, p);
        for (std::size_t i = 1; i < n; ++i) {
            const double step = step_of(i);
            if (step > 0) steps.push_back(step);
        }
    }
    if (steps.empty()) return;
    auto high = steps.begin() + static_cast<std::ptrdiff_t>(0.999 * static_cast<double>(steps.size() - 1));
    std::nth_element(steps.begin(), high, steps.end());
    const double limit = std::max(least_jump, jump_factor * *high);
    const auto blocks = static_cast<std::size_t>((log.records + block_points - 1) / block_points);
    std::vector<Diagnostics> of_block(blocks);
    for_each_block(log.records, [&](PointIndex first, PointIndex last) {
        const PointIndex begin = std::max<PointIndex>(0, first - 1);
        std::array<std::vector<double>, 3> q;
        axes.read(begin, static_cast<std::size_t>(last - begin), q);
        for (std::size_t i = 1; i < q[0].size(); ++i) {
            const double step = std::hypot(q[0][i] - q[0][i - 1], q[1][i] - q[1][i - 1], q[2][i] - q[2][i - 1]);
            if (step <= limit) continue;
            of_block[static_cast<std::size_t>(first / block_points)].add(
                finding(Severity::warning, "log.jump", Place::of_point(log.name, begin + static_cast<PointIndex>(i)),
                        fmt::format("the position jumps by {:.3f} mm in one period; 99.9 % of the steps are under {:.3f} mm", step, *high)));
        }
    });
    for (const Diagnostics& d : of_block) found.append(d);
}

/// The step of an axis: the smallest difference that occurs often.
double quantum_of(const Channel& channel, PointIndex records) {
    std::vector<double> steps;
    const auto n = static_cast<std::size_t>(std::min<PointIndex>(records, 20'000));
    std::vector<double> values(n);
    copy_block(channel.values, (records - static_cast<PointIndex>(n)) / 2, values);
    for (std::size_t i = 1; i < n; ++i) {
        const double step = std::abs(values[i] - values[i - 1]);
        if (step > 0 && std::isfinite(step)) steps.push_back(step);
    }
    if (steps.size() < 100) return 0;
    std::sort(steps.begin(), steps.end());
    const double candidate = steps[steps.size() / 100];
    // A grid: nearly all steps are whole multiples of the smallest one.
    const double smallest = steps.front();
    std::size_t on_grid = 0;
    for (const double step : steps) {
        const double ratio = step / smallest;
        if (std::abs(ratio - std::round(ratio)) < 0.02) ++on_grid;
    }
    const bool grid = candidate < 50 * smallest && on_grid > steps.size() * 98 / 100 && smallest > least_quantum;
    return grid ? smallest : 0;
}

void check_quantum(const Log& log, const Axes& axes, Role role, Diagnostics& found) {
    std::string text;
    for (const Channel* channel : axes.channel) {
        const double quantum = quantum_of(*channel, log.records);
        if (quantum > 0) text += fmt::format("{}{} {:.3g} µm", text.empty() ? "" : ", ", channel->name, quantum * 1e3);
    }
    if (!text.empty()) found.add(finding(Severity::note, "log.quantum", Place::of_file(log.name), fmt::format("{} positions come in steps: {}", name_of(role), text)));
}

/// Feedback minus commanded while the machine rests, which is no following error.
void check_offset(const Log& log, Diagnostics& found) {
    for (const Role role : {Role::feedback, Role::actual}) {
        if (!log.has(role) || !log.has(Role::commanded)) continue;
        const Axes commanded(log, Role::commanded);
        const Axes measured(log, role);
        std::array<std::vector<double>, 3> c, m;
        std::array<std::vector<double>, 3> differences;
        const PointIndex stretch = 1024;
        const PointIndex stride = std::max<PointIndex>(stretch, log.records / (sampled / stretch));
        for (PointIndex begin = 0; begin < log.records; begin += stride) {
            const auto n = static_cast<std::size_t>(std::min(stretch, log.records - begin));
            commanded.read(begin, n, c);
            measured.read(begin, n, m);
            for (std::size_t i = 1; i < n; ++i) {
                bool rests = true;
                for (std::size_t k = 0; k < 3; ++k) {
                    rests = rests && c[k][i] == c[k][i - 1] && std::abs(m[k][i] - m[k][i - 1]) < resting_step;
                }
                for (std::size_t k = 0; rests && k < 3; ++k) differences[k].push_back(m[k][i] - c[k][i]);
            }
        }
        if (differences[0].size() < least_resting) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            std::vector<double>& d = differences[k];
            auto middle = d.begin() + static_cast<std::ptrdiff_t>(d.size() / 2);
            std::nth_element(d.begin(), middle, d.end());
            if (std::abs(*middle) < worth_offset) continue;
            found.add(finding(Severity::warning, "log.offset", Place::of_file(log.name),
                              fmt::format("{} differs from cmd.{} by {:.4f} mm while the machine rests: a constant offset, not a lag", measured.channel[k]->name, "xyz"[k], *middle)));
        }
    }
}

void check_lines(const Log& log, const Axes& axes, std::uint32_t program_lines, Diagnostics& found) {
    const Channel* line = log.find("line");
    if (line == nullptr) return;
    constexpr std::uint32_t bad = 0xffffffffu;
    std::vector<std::uint32_t> lines;
    std::array<std::vector<double>, 3> p;
    std::uint32_t before = 0;
    std::uint32_t highest = 0;
    double way = 0;
    PointIndex since = 0;
    bool told = false;
    Vec3 last = Vec3::Zero();
    for (PointIndex begin = 0; begin < log.records; begin += block_points) {
        const auto n = static_cast<std::size_t>(std::min<PointIndex>(block_points, log.records - begin));
        lines.resize(n);
        copy_block(line->values, begin, lines, bad);
        axes.read(begin, n, p);
        for (std::size_t i = 0; i < n; ++i) {
            const PointIndex point = begin + static_cast<PointIndex>(i);
            const Vec3 here(p[0][i], p[1][i], p[2][i]);
            const double step = point > 0 ? (here - last).norm() : 0.0;
            last = here;
            if (lines[i] == bad || (program_lines > 0 && lines[i] > program_lines)) {
                found.add(finding(Severity::warning, "log.line-range", Place::of_point(log.name, point),
                                  fmt::format("line {} is none of the program's {} lines", line->values.at(point), program_lines)));
            } else {
                highest = std::max(highest, lines[i]);
            }
            if (lines[i] != before) {
                before = lines[i];
                way = 0;
                since = point;
                told = false;
            } else if (before != 0 && std::isfinite(step)) {
                way += step;
            }
            if (way > stuck_way && !told && highest < 2) {
                told = true;
                found.add(finding(Severity::warning, "log.stuck-line", Place::of_point(log.name, since), fmt::format("the line number stays {} while the tool goes {:.0f} mm and more", before, stuck_way)));
            }
        }
    }
    if (highest == 0 && log.records > 0) found.add(finding(Severity::warning, "log.stuck-line", Place::of_file(log.name), "the line number is 0 all the time"));
}

}  // namespace

Diagnostics check_health(const Log& log, std::uint32_t program_lines) {
    Diagnostics found;
    check_channels(log, found);
    if (log.records == 0) {
        found.add(finding(Severity::error, "log.empty", Place::of_file(log.name), "holds no records"));
        return found;
    }
    check_time(log, found);
    check_values(log, found);
    const Role role = first_role(log);
    const Axes axes(log, role);
    if (!axes.complete()) return found;
    check_jumps(log, axes, found);
    check_offset(log, found);
    check_lines(log, axes, program_lines, found);
    for (const Role each : {Role::commanded, Role::feedback, Role::actual}) {
        if (log.has(each)) check_quantum(log, Axes(log, each), each, found);
    }
    return found;
}

}  // namespace clsurf
