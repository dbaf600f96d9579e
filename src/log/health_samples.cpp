#include "log/health_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "core/statistics.h"
#include "log/placeholder.h"
#include "log/quantum.h"

namespace clsurf {
namespace {

constexpr PointIndex sampled = 200'000;  ///< records in total
constexpr PointIndex run_length = 1024;  ///< consecutive records
constexpr double worth_offset = 0.002;   ///< [mm] least reported offset between commanded and measured
constexpr double resting_step = 1e-4;    ///< [mm] per record that feedback may move at rest
constexpr std::size_t least_resting = 50;
constexpr std::size_t least_moving = 1000;  ///< records in each direction
constexpr double sure_sigmas = 5;
constexpr double correlated = 100;  ///< records that count as one measurement: errors change slowly

/// Commanded against measured along one axis.
class AxisOffset {
public:
    void add(double commanded_step, double measured_step, double difference) {
        if (!std::isfinite(difference)) return;
        if (commanded_step == 0 && std::abs(measured_step) < resting_step) {
            resting_.push_back(difference);
            return;
        }
        if (commanded_step == 0) return;
        // difference = offset − lag · step, least squares
        ++(commanded_step > 0 ? forth_ : back_);
        const double n = static_cast<double>(forth_ + back_);
        const double step_off = commanded_step - mean_step_;
        mean_step_ += step_off / n;
        step_squares_ += step_off * (commanded_step - mean_step_);
        const double difference_off = difference - mean_;
        mean_ += difference_off / n;
        squares_ += difference_off * (difference - mean_);
        products_ += step_off * (difference - mean_);
    }

    /// Offset [mm]; 0: none is significant. `resting`: whether it was measured at rest.
    [[nodiscard]] double offset(bool& resting) {
        resting = resting_.size() >= least_resting;
        if (resting) return median(resting_);
        if (forth_ < least_moving || back_ < least_moving) return 0;
        const double n = static_cast<double>(forth_ + back_);
        const double slope = products_ / step_squares_;
        const double offset = mean_ - slope * mean_step_;
        const double left = std::max(0.0, squares_ - slope * products_) / n;
        const double deviation = std::sqrt(left * (1 / n + mean_step_ * mean_step_ / step_squares_) * correlated);
        return std::abs(offset) > sure_sigmas * deviation ? offset : 0.0;
    }

private:
    std::vector<double> resting_;
    std::size_t forth_ = 0, back_ = 0;
    double mean_step_ = 0, step_squares_ = 0, mean_ = 0, squares_ = 0, products_ = 0;
};

void check_offset_of_axis(const Log& log, const Channel& commanded, const Channel& measured, Diagnostics& found) {
    AxisOffset axis;
    std::vector<double> c, m;
    const PointIndex stride = std::max<PointIndex>(run_length, log.records / (sampled / run_length));
    for (PointIndex begin = 0; begin < log.records; begin += stride) {
        const auto n = static_cast<std::size_t>(std::min(run_length, log.records - begin));
        c.resize(n);
        m.resize(n);
        copy_block(commanded.values, begin, c);
        copy_block(measured.values, begin, m);
        for (std::size_t i = 1; i < n; ++i) axis.add(c[i] - c[i - 1], m[i] - m[i - 1], m[i] - c[i]);
    }
    bool resting = false;
    const double offset = axis.offset(resting);
    if (std::abs(offset) < worth_offset) return;
    found.add(
        {Severity::warning,
         "log.offset",
         Place::of_file(log.name),
         fmt::format("{} differs from {} by {:.4f} {} {}: a constant offset, not a lag", measured.name, commanded.name,
                     offset, commanded.unit, resting ? "while the axis rests" : "whichever way the axis moves"),
         {}});
}

}  // namespace

void check_offset(const Log& log, Diagnostics& found) {
    for (const Role role : {Role::feedback, Role::actual}) {
        for (const char axis : std::string_view("xyzuvwabc")) {
            const Channel* commanded = log.find(fmt::format("{}.{}", prefix_of(Role::commanded), axis));
            const Channel* measured = log.find(fmt::format("{}.{}", prefix_of(role), axis));
            if (commanded != nullptr && measured != nullptr) check_offset_of_axis(log, *commanded, *measured, found);
        }
    }
}

void check_placeholders(const Log& log, Diagnostics& found) {
    for (const Role role : {Role::commanded, Role::feedback, Role::actual}) {
        const std::string prefix(prefix_of(role));
        if (!log.has(role) || log.find(prefix + ".y") == nullptr)
            continue;  // the log of a lathe shows no marks between passes
        const auto axis = [&](char letter) { return log.find(fmt::format("{}.{}", prefix, letter))->values; };
        const std::optional<Placeholder> placeholder = find_placeholder({axis('x'), axis('y'), axis('z')});
        if (!placeholder) continue;
        const auto& [x, y, z] = placeholder->position;
        found.add(
            {Severity::warning, "log.placeholder", Place::of_point(log.name, placeholder->first),
             fmt::format(
                 "the {} position jumps to X{:g} Y{:g} Z{:g} and back {} times, here for the first time, over up to {:.1f} mm: a placeholder; speeds and marks are not reliable",
                 name_of(role), x, y, z, placeholder->times, placeholder->farthest),
             "leave these records out"});
    }
}

void check_quantum(const Log& log, Diagnostics& found) {
    for (const Role role : {Role::commanded, Role::feedback, Role::actual}) {
        std::string text;
        for (const Channel& channel : log.channels) {
            if (!channel.name.starts_with(std::string(prefix_of(role)) + ".")) continue;
            const double quantum = quantum_of(channel.values);
            if (quantum > 0)
                text += fmt::format("{}{} {:.3g} {}", text.empty() ? "" : ", ", channel.name, quantum, channel.unit);
        }
        if (text.empty()) continue;
        found.add({Severity::note,
                   "log.quantum",
                   Place::of_file(log.name),
                   fmt::format("{} positions come in steps: {}", name_of(role), text),
                   {}});
    }
}

}  // namespace clsurf
