#include "toolpath/fused_positions.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "core/units.h"
#include "log/quantum.h"

namespace clsurf {
namespace {

std::string channel_name(Role role, std::size_t axis) { return fmt::format("{}.{}", prefix_of(role), "xyz"[axis]); }

}  // namespace

bool FusedPositions::applies(const Log& log, const Trajectory& path) {
    return path.role == Role::actual && path.is_of_linear_axes() && log.has(Role::feedback);
}

FusedPositions::FusedPositions(const Log& log, const Trajectory& path, const std::vector<PointRange>& pieces,
                               NoiseFitter& fitter)
    : path_(path) {
    const std::vector<PointRange> whole = cut_at_gaps(log, {{0, path.count - 1}});
    const std::vector<PointRange> samples = sample_sections(pieces);
    auto columns = std::make_shared<std::array<std::vector<double>, 3>>();
    for (std::size_t k = 0; k < 3; ++k) {
        const Channel* encoder = log.find(channel_name(Role::feedback, k));
        // A lathe has no Y.
        if (encoder == nullptr || log.find(channel_name(Role::actual, k)) == nullptr) continue;
        axes_[k] = fuse_axis({path.axes[k], encoder->values, path.count, path.period, whole, samples}, fitter);
        const double coarse = quantum_of(path.axes[k]) / std::sqrt(12.0);
        const double fine = quantum_of(encoder->values) / std::sqrt(12.0);
        // Fast components are weighted by 1 − w (scale) and w (encoder).
        floor_ = std::max(
            floor_, axes_[k].weight == 0 ? 0 : std::hypot((1 - axes_[k].weight) * coarse, axes_[k].weight * fine));
        scale_floor_ = std::max(scale_floor_, coarse);
        (*columns)[k] = std::exchange(axes_[k].positions, {});
        path_.axes[k] = view_of((*columns)[k]);
    }
    // An axis at rest shows no step. It is assumed to have the step of the others.
    for (std::size_t k = 0; k < 3; ++k) {
        if (quantum_of(path.axes[k]) > 0) continue;
        for (float& sigma : axes_[k].sigmas[0]) sigma = std::hypot(sigma, static_cast<float>(scale_floor_));
    }
    // Channels that are not fused still refer to the log.
    path_.keep_alive = std::make_shared<std::pair<std::shared_ptr<const void>, std::shared_ptr<const void>>>(
        path.keep_alive, std::move(columns));
}

double FusedPositions::alone() const {
    double least = 0, most = 0;  // of the axes that are fused; of all scales
    for (const FusedAxis& axis : axes_) {
        if (axis.weight > 0) least = least == 0 ? axis.sigma() : std::min(least, axis.sigma());
        most = std::max(most, axis.scale_sigma);
    }
    return least == 0 ? 1 : most / least;
}

void FusedPositions::sigmas(std::size_t axis, int derivative, PointIndex first, std::span<double> out) const {
    const std::vector<float>& of = axes_[axis].sigmas[static_cast<std::size_t>(derivative)];
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = of.empty() ? 0.0 : static_cast<double>(of[static_cast<std::size_t>(first) + i]);
}

std::vector<PointRange> FusedPositions::fused_ranges(PointRange range) const {
    std::vector<PointRange> parts;
    PointIndex first = range.first;
    for (PointIndex i = range.first; i <= range.last + 1; ++i) {
        const bool alone = i > range.last || std::any_of(axes_.begin(), axes_.end(), [i](const FusedAxis& axis) {
                               return axis.weight > 0 && std::isinf(axis.sigmas[0][static_cast<std::size_t>(i)]);
                           });
        if (!alone) continue;
        if (i > first) parts.push_back({first, i - 1});
        first = i + 1;
    }
    return parts;
}

double FusedPositions::remaining(int derivative) const {
    double most = 0;
    for (const FusedAxis& axis : axes_) most = std::max(most, axis.remaining[static_cast<std::size_t>(derivative)]);
    return most;
}

std::string FusedPositions::note() const {
    double scale = 0, encoder = 0, lead = 0, yield = 0;
    bool backlash = false;
    for (const FusedAxis& axis : axes_) {
        if (axis.weight == 0) continue;
        scale = std::max(scale, axis.scale_sigma);
        encoder = std::max(encoder, axis.encoder_sigma);
        yield = std::max(yield, axis.yield);
        if (std::abs(axis.lead) > std::abs(lead)) lead = axis.lead;
        backlash = backlash || axis.backlash != 0;
    }
    if (scale == 0) return "scale alone";
    std::string text = fmt::format("scale \u00b1{:.2g} \u00b5m and encoder \u00b1{:.2g} \u00b5m", scale * um_per_mm,
                                   encoder * um_per_mm);
    if (yield > 0) text += fmt::format(" (the drive yields by {:.2g} \u00b5m)", yield * um_per_mm);
    if (lead != 0) text += fmt::format(", {:.3g} records {}", std::abs(lead), lead > 0 ? "ahead" : "behind");
    if (backlash) {
        text += ", backlash";
        for (std::size_t k = 0; k < 3; ++k)
            text += fmt::format("{}{:.2g}", k == 0 ? " " : "/", axes_[k].backlash * um_per_mm);
        text += " \u00b5m";
    }
    return text;
}

}  // namespace clsurf
