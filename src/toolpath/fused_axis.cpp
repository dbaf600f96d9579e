#include "toolpath/fused_axis.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/statistics.h"
#include "log/quantum.h"

namespace clsurf {
namespace {

constexpr PointIndex half_window = 8;  ///< records to each side over which displacement and speed are compared
constexpr double sure = 3;             ///< standard errors by which a lead must differ from a whole number
constexpr double known_lead = 0.1;     ///< records: the standard error below which a lead is used
constexpr double most_difference =
    0.3;                               ///< share of the motion: an encoder that differs by more belongs to another axis
constexpr int alignment_steps = 4;     ///< steps of the Gauss–Newton method
constexpr double sure_compliance = 5;  ///< standard errors
constexpr double reversal_sigmas = 12;  ///< an axis has reversed if it has moved back by this many standard deviations
/// Distance of the motor from a reversal [mm] at which the backlash is certainly crossed; measured between it and twice of
/// it. If the motor reverses again earlier, a quarter of the distance until then is used; below the least nothing is
/// measured.
constexpr double beyond_backlash = 0.1, least_beyond = 0.02;
constexpr double sure_backlash = 5;  ///< standard errors
constexpr double transit_backlash =
    1.5;  ///< travel of the motor after a reversal during which the table may be at rest …
constexpr double transit_sigmas = 3;           ///< … plus this many standard deviations of a difference
constexpr PointIndex margin = 1;               ///< records around it
constexpr PointIndex longest_range = 1 << 18;  ///< records that are smoothed at once: 200 bytes each
constexpr double not_known = std::numeric_limits<double>::infinity();

using Values = std::vector<double>;

/// The difference of positions of both encoders, with its terms.
struct Differences {
    Values scale, encoder;  ///< the encoder shifted to the scale's records
    [[nodiscard]] double at(PointIndex i) const {
        return encoder[static_cast<std::size_t>(i)] - scale[static_cast<std::size_t>(i)];
    }
};

std::vector<Values> cut_out(const Values& values, const std::vector<PointRange>& ranges) {
    std::vector<Values> parts;
    for (const PointRange& range : ranges)
        parts.emplace_back(values.begin() + range.first, values.begin() + range.last + 1);
    return parts;
}

/// Noise of a channel in motion and at rest, the larger of both.
NoiseFit noise_of(const Values& values, const std::vector<PointRange>& samples, double floor, NoiseFitter& fitter) {
    std::vector<Values> moving, resting;
    for (Values& part : cut_out(values, samples)) (moves(part, floor) ? moving : resting).push_back(std::move(part));
    NoiseFit fit = fitter.fit(moving, floor);
    fit.sigma = std::max(fit.sigma, noise_at_rest(resting));
    return fit;
}

double floor_of(const ChannelView& view) { return std::max(finest_position, quantum_of(view) / std::sqrt(12.0)); }

/// Whether both measure the same axis: the difference changes by much less than the position.
bool agree(const Differences& both, const std::vector<PointRange>& samples) {
    double of_difference = 0, of_scale = 0;
    for (const PointRange& sample : samples) {
        double count = 0, d_mean = 0, s_mean = 0;
        for (PointIndex i = sample.first; i <= sample.last; ++i) {
            const double d = both.at(i), s = both.scale[static_cast<std::size_t>(i)];
            if (std::isnan(d)) continue;
            ++count;
            const double d_before = d_mean, s_before = s_mean;
            d_mean += (d - d_mean) / count;
            s_mean += (s - s_mean) / count;
            of_difference += (d - d_before) * (d - d_mean);
            of_scale += (s - s_before) * (s - s_mean);
        }
    }
    return of_difference < most_difference * most_difference * of_scale;
}

/// The whole number of records at which the displacements of both over a window agree best.
double whole_lead(const Differences& both, const std::vector<PointRange>& samples) {
    std::array<double, 2 * most_lead + 1> squares{};
    const auto displacement = [](const Values& x, PointIndex i) {
        return x[static_cast<std::size_t>(i + half_window)] - x[static_cast<std::size_t>(i - half_window)];
    };
    constexpr PointIndex reach = half_window + most_lead;
    for (const PointRange& sample : samples) {
        for (PointIndex i = sample.first + reach; i + reach <= sample.last; ++i) {
            const double at = displacement(both.scale, i);
            std::array<double, 2 * most_lead + 1> off{};
            double sum = 0;
            for (PointIndex lead = -most_lead; lead <= most_lead; ++lead)
                sum += off[static_cast<std::size_t>(lead + most_lead)] = displacement(both.encoder, i - lead) - at;
            if (std::isnan(sum)) continue;
            for (std::size_t k = 0; k < off.size(); ++k) squares[k] += off[k] * off[k];
        }
    }
    const auto least = static_cast<std::size_t>(std::min_element(squares.begin(), squares.end()) - squares.begin());
    if (least == 0 || least + 1 == squares.size() || !(squares[least] < better_lead * squares[most_lead])) return 0;
    return static_cast<double>(least) - static_cast<double>(most_lead);
}

struct Alignment {
    double lead = 0, lead_error = not_known;              ///< [records], with its standard error
    double compliance = 0, compliance_error = not_known;  ///< [records²]
    double yield = 0;                                     ///< [mm] rms, over a window
};

/// The remaining difference between both displacements over a window is the remaining lead times the change of speed, plus
/// the compliance of the drive times the change of acceleration: least squares of both. Windows are inside `ranges`; the
/// motor does not reverse in them.
Alignment alignment_step(const Differences& both, const std::vector<PointRange>& ranges) {
    double vv = 0, va = 0, aa = 0, vd = 0, ad = 0, dd = 0, count = 0;
    const auto e = [&](PointIndex i) { return both.encoder[static_cast<std::size_t>(i)]; };
    const auto speed = [&](PointIndex i) { return 0.5 * (e(i + 1) - e(i - 1)); };  // [mm per record]
    // Over half a window to each side, so that rounding is negligible [mm per record²].
    constexpr PointIndex half = half_window / 2;
    const auto acceleration = [&](PointIndex i) { return (e(i + half) - 2 * e(i) + e(i - half)) / (half * half); };
    constexpr PointIndex reach = half_window + half;
    for (const PointRange& range : ranges) {
        for (PointIndex i = range.first + reach; i + reach <= range.last; ++i) {
            const double before = speed(i - half_window), after = speed(i + half_window);
            if (!(before * after > 0)) continue;
            const double d = both.at(i + half_window) - both.at(i - half_window);
            const double v = after - before;
            const double a = acceleration(i + half_window) - acceleration(i - half_window);
            if (std::isnan(d + a)) continue;
            vv += v * v, va += v * a, aa += a * a, vd += v * d, ad += a * d, dd += d * d;
            ++count;
        }
    }
    const double determinant = vv * aa - va * va;
    if (!(determinant > 1e-6 * vv * aa)) return {};
    Alignment found;
    found.lead = (aa * vd - va * ad) / determinant;
    found.compliance = (vv * ad - va * vd) / determinant;
    found.yield = found.compliance * std::sqrt(aa / count);
    // Windows that overlap are not independent.
    const double left = std::max(0.0, dd - found.lead * vd - found.compliance * ad) / count * 2 * half_window;
    found.lead_error = std::sqrt(left * aa / determinant);
    found.compliance_error = std::sqrt(left * vv / determinant);
    return found;
}

/// Shifts the encoder to the scale's records.
Alignment align(const AxisRecords& records, double start, const std::vector<PointRange>& ranges, Differences& both) {
    double lead = start;
    Alignment found;
    for (int k = 0; k < alignment_steps; ++k) {
        copy_ahead(records.encoder, records.count, 0, lead, both.encoder);
        found = alignment_step(both, ranges);
        lead = std::clamp(lead + found.lead, -double{most_lead}, double{most_lead});
    }
    if (!(found.lead_error < known_lead) || !(std::abs(lead) < most_lead)) lead = start;
    if (std::abs(lead - std::round(lead)) < sure * found.lead_error) lead = std::round(lead);
    if (!(found.compliance > sure_compliance * found.compliance_error)) found.yield = 0;
    copy_ahead(records.encoder, records.count, 0, lead, both.encoder);
    // Values interpolated across a gap are invalid.
    const auto beyond = static_cast<PointIndex>(std::ceil(std::abs(lead))) + (lead == std::round(lead) ? 0 : 1);
    for (const PointRange& piece : records.pieces) {
        const PointIndex n = std::min(beyond, piece.size());
        std::fill_n(both.encoder.begin() + piece.first, n, std::numeric_limits<double>::quiet_NaN());
        std::fill_n(both.encoder.begin() + piece.last + 1 - n, n, std::numeric_limits<double>::quiet_NaN());
    }
    found.lead = lead;
    return found;
}

struct Backlash {
    double size = 0;     ///< [mm]; 0: none
    double transit = 0;  ///< [mm] travel of the motor after a reversal during which the table may be at rest
};

/// Mean difference while the motor is between `least` and twice of it away from a reversal, before or after it; NaN: it
/// does not move that far.
double mean_on_side(const Differences& both, PointIndex from, int step, PointRange within, double least) {
    const double origin = both.encoder[static_cast<std::size_t>(from)];
    double sum = 0, count = 0;
    for (PointIndex i = from; i >= within.first && i <= within.last; i += step) {
        const double distance = std::abs(both.encoder[static_cast<std::size_t>(i)] - origin);
        if (distance > 2 * least) break;
        const double d = both.at(i);
        if (distance < least || std::isnan(d)) continue;
        sum += d;
        ++count;
    }
    return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

double distance_between(const Differences& both, PointIndex from, PointIndex to) {
    return std::abs(both.encoder[static_cast<std::size_t>(to)] - both.encoder[static_cast<std::size_t>(from)]);
}

/// At the same place before and after a reversal the pitch error is the same: the difference changes by the backlash.
Backlash measure_backlash(const Differences& both, const std::vector<std::vector<Reversal>>& reversals,
                          const std::vector<PointRange>& pieces, double sigma) {
    std::vector<double> sizes;
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        const std::vector<Reversal>& all = reversals[p];
        for (std::size_t k = 0; k < all.size(); ++k) {
            const PointIndex first = k == 0 ? pieces[p].first : all[k - 1].at;
            const PointIndex last = k + 1 == all.size() ? pieces[p].last : all[k + 1].at;
            const double shorter =
                std::min(distance_between(both, first, all[k].at), distance_between(both, all[k].at, last));
            const double beyond = std::min(beyond_backlash, 0.25 * shorter);
            if (!(beyond >= least_beyond)) continue;
            const double before = mean_on_side(both, all[k].at, -1, {first, last}, beyond);
            const double after = mean_on_side(both, all[k].at, 1, {first, last}, beyond);
            if (!std::isnan(before + after)) sizes.push_back(all[k].direction * (before - after));
        }
    }
    if (sizes.empty()) return {};
    const auto [size, deviation] = robust_spread(sizes);
    const double scatter = std::max(deviation, sigma);
    if (std::abs(size) < sure_backlash * scatter / std::sqrt(static_cast<double>(sizes.size()))) return {};
    return {size, transit_backlash * std::abs(size) + transit_sigmas * sigma};
}

/// Ranges in which the difference is smooth: pieces without missing records, cut at reversals, excluding the motor's
/// travel there.
std::vector<PointRange> smooth_ranges(const Differences& both, const std::vector<std::vector<Reversal>>& reversals,
                                      const std::vector<PointRange>& pieces, double transit) {
    std::vector<PointRange> ranges;
    const auto add = [&](PointRange range) {
        PointIndex first = range.first;
        for (PointIndex i = range.first; i <= range.last + 1; ++i) {
            if (i <= range.last && !std::isnan(both.at(i))) continue;
            for (; first < i; first += longest_range) ranges.push_back({first, std::min(i, first + longest_range) - 1});
            first = i + 1;
        }
    };
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        const auto beyond_transit = [&](PointIndex from) {
            PointIndex i = from;
            while (i <= pieces[p].last && !(distance_between(both, from, i) > transit)) ++i;
            return i + margin;
        };
        // At the beginning of a log it is unknown on which side of the backlash the table is.
        PointIndex first = pieces[p].first;
        while (first < pieces[p].last && std::isnan(both.encoder[static_cast<std::size_t>(first)])) ++first;
        if (transit > 0) first = beyond_transit(first);
        for (const Reversal& reversal : reversals[p]) {
            if (transit == 0) break;
            add({first, reversal.at - margin});
            first = std::max(first, beyond_transit(reversal.at));
        }
        add({first, pieces[p].last});
    }
    return ranges;
}

/// Factor of the standard deviations of b̂ for the scale's rounding that smoothing does not average out. If the positions of
/// the records of an estimate are at k different fractions of a code, they round like a code k times as fine. The encoder
/// gives these fractions, because its error changes slowly.
class Rounding {
public:
    Rounding(double quantum, std::span<const double> encoder) : quantum_(quantum) {
        if (quantum == 0) return;
        sums_.resize(encoder.size() + 1);
        for (std::size_t i = 0; i < encoder.size(); ++i) {
            const double codes = encoder[i] / quantum;
            sums_[i + 1] = sums_[i];
            ++sums_[i + 1][std::min(static_cast<std::size_t>(places * (codes - std::floor(codes))), places - 1)];
        }
    }

    /// For an estimate of standard deviation `sigma` at a record, which is as good as the mean of `records`.
    [[nodiscard]] double factor(std::size_t at, std::size_t records, double sigma) const {
        if (quantum_ == 0) return 1;
        const std::size_t n = sums_.size() - 1;
        records = std::min(records, n);
        const std::size_t begin = std::min(at - std::min(at, records / 2), n - records);
        double squares = 0;
        for (std::size_t k = 0; k < places; ++k) {
            const double count = sums_[begin + records][k] - sums_[begin][k];
            squares += count * count;
        }
        const double step = quantum_ * squares / static_cast<double>(records * records);  // a k-th of the quantum
        return std::sqrt(1 + step * step / 12 / (sigma * sigma));
    }

private:
    static constexpr std::size_t places = 16;
    double quantum_;
    std::vector<std::array<std::uint32_t, places>> sums_;  ///< records at each place before a record
};

/// The same motion and noise, with only every second record known.
KalmanSmoother of_every_second(const KalmanSmoother& smoother) {
    SmootherModel model = smoother.model();
    model.period *= 2;
    model.wandering *= two_periods_7;
    return KalmanSmoother(model);
}

/// clsurf::hold_out(), with `half` = of_every_second(smoother), which is computed once for all ranges.
void hold_out(std::span<const double> differences, const KalmanSmoother& smoother, const KalmanSmoother& half,
              std::span<const double> factors, std::vector<double>& ratios) {
    const std::size_t count = (differences.size() + 1) / 2;
    const auto block = static_cast<std::size_t>(std::max<PointIndex>(2, mean_records(smoother) / 8));
    if (count < block + 2) return;
    Values even(count), sigmas(count);
    for (std::size_t k = 0; k < count; ++k) even[k] = differences[2 * k];
    std::vector<SmoothedState> states(count);
    half.smooth({{even, even, even}, {}, {}}, states);
    half.sigmas(0, static_cast<PointIndex>(count), 0, sigmas);
    const double noise = smoother.model().position_sigma;
    for (std::size_t k = 0; k + block < count; k += block) {
        // `block` records between block + 1 estimates; the trapezoidal mean of the estimates has the same centre.
        double off = 0, variance = 0;
        for (std::size_t i = k; i < k + block; ++i) {
            off += differences[2 * i + 1] - 0.5 * (states[i][0][0] + states[i + 1][0][0]);
            variance = std::max(variance, std::pow(sigmas[i] * factors[2 * i], 2));
        }
        off /= static_cast<double>(block);
        ratios.push_back(off * off / (variance + noise * noise / static_cast<double>(block)));
    }
}

/// Fuses a range, computes the uncertainty of the difference in it, and tests that on records that are held out.
void fuse_range(const Differences& both, PointRange range, const KalmanSmoother& smoother, const KalmanSmoother& half,
                double quantum, FusedAxis& axis) {
    const auto n = static_cast<std::size_t>(range.size());
    const auto part = [&](auto& x) { return std::span(x).subspan(static_cast<std::size_t>(range.first), n); };
    fuse(part(both.scale), part(both.encoder), smoother, axis.weight, part(axis.positions));
    const Rounding rounding(quantum, part(both.encoder));
    Values factors(n), sigmas(n), differences(n);
    for (int d = 0; d < 4; ++d) {
        smoother.sigmas(d, range.size(), 0, sigmas);
        for (std::size_t i = 0; d == 0 && i < n; ++i) {
            const double records = std::pow(smoother.model().position_sigma / sigmas[i], 2);
            factors[i] = rounding.factor(i, static_cast<std::size_t>(std::max(1.0, std::round(records))), sigmas[i]);
        }
        const std::span<float> out = part(axis.sigmas[static_cast<std::size_t>(d)]);
        for (std::size_t i = 0; i < n; ++i) out[i] = static_cast<float>(axis.weight * sigmas[i] * factors[i]);
    }
    for (std::size_t i = 0; i < n; ++i) differences[i] = both.at(range.first + static_cast<PointIndex>(i));
    hold_out(differences, smoother, half, factors, axis.held_out);
}

}  // namespace

double FusedAxis::sigma() const {
    return weight == 0 ? scale_sigma : scale_sigma * encoder_sigma / std::hypot(scale_sigma, encoder_sigma);
}

std::vector<Reversal> find_reversals(std::span<const double> positions, PointRange range, double threshold) {
    std::vector<Reversal> reversals;
    int direction = 0;
    double low = not_known, high = -not_known;  // since the last reversal
    PointIndex at = range.first;                // the last record near the extreme
    for (PointIndex i = range.first; i <= range.last; ++i) {
        const double here = positions[static_cast<std::size_t>(i)];
        if (std::isnan(here)) continue;
        low = std::min(low, here);
        high = std::max(high, here);
        if (direction == 0) {
            if (high - low > threshold) direction = here == high ? 1 : -1;
            at = i;
            continue;
        }
        const double back = direction > 0 ? high - here : here - low;
        if (back <= 0.5 * threshold) at = i;
        if (back <= threshold) continue;
        reversals.push_back({at, direction});
        direction = -direction;
        low = high = here;
        at = i;
    }
    return reversals;
}

void fuse(std::span<const double> scale, std::span<const double> encoder, const KalmanSmoother& difference,
          double weight, std::span<double> fused, std::span<std::array<double, 4>> smoothed) {
    Values d(scale.size());
    for (std::size_t i = 0; i < d.size(); ++i) d[i] = encoder[i] - scale[i];
    std::vector<SmoothedState> states(d.size());
    difference.smooth({{d, d, d}, {}, {}}, states);
    for (std::size_t i = 0; i < d.size(); ++i) {
        fused[i] = scale[i] + weight * (d[i] - states[i][0][0]);
        for (std::size_t k = 0; k < 4 && !smoothed.empty(); ++k) smoothed[i][k] = states[i][k][0];
    }
}

PointIndex mean_records(const KalmanSmoother& smoother) {
    return std::max<PointIndex>(1, std::lround(std::pow(smoother.model().position_sigma / smoother.sigma(0), 2)));
}

void hold_out(std::span<const double> differences, const KalmanSmoother& smoother, std::span<const double> factors,
              std::vector<double>& ratios) {
    hold_out(differences, smoother, of_every_second(smoother), factors, ratios);
}

FusedAxis fuse_axis(const AxisRecords& records, NoiseFitter& fitter) {
    const auto n = static_cast<std::size_t>(records.count);
    FusedAxis axis;
    Differences both{Values(n), Values(n)};
    copy_block(records.scale, 0, both.scale);
    copy_block(records.encoder, 0, both.encoder);
    axis.positions = both.scale;
    for (std::vector<float>& sigmas : axis.sigmas) sigmas.assign(n, static_cast<float>(not_known));
    // An axis at rest in these sections may move between them.
    std::vector<PointRange> samples = records.samples;
    NoiseFit scale = noise_of(both.scale, samples, floor_of(records.scale), fitter);
    if (!scale.moved) {
        samples = sample_sections(records.pieces);
        scale = noise_of(both.scale, samples, floor_of(records.scale), fitter);
    }
    const NoiseFit encoder = noise_of(both.encoder, samples, floor_of(records.encoder), fitter);
    axis.scale_sigma = scale.sigma;
    axis.encoder_sigma = encoder.sigma;
    Alignment alignment = align(records, whole_lead(both, samples), samples, both);
    if (scale.moved && !agree(both, samples)) return axis;
    const double sigma = std::hypot(scale.sigma, encoder.sigma);
    const double threshold = reversal_sigmas * encoder.sigma;
    std::vector<std::vector<Reversal>> reversals;
    std::vector<PointRange> ranges;
    // The first lead is measured without regard to backlash.
    for (int pass = 0; pass < 2; ++pass) {
        if (pass > 0) alignment = align(records, alignment.lead, ranges, both);
        reversals.clear();
        for (const PointRange& piece : records.pieces)
            reversals.push_back(find_reversals(both.encoder, piece, threshold));
        const Backlash backlash = measure_backlash(both, reversals, records.pieces, sigma);
        axis.backlash = backlash.size;
        ranges = smooth_ranges(both, reversals, records.pieces, backlash.transit);
    }
    axis.lead = alignment.lead;
    axis.yield = alignment.yield;
    std::vector<Values> differences;
    for (const PointRange& range : ranges) {
        Values d;
        for (PointIndex i = range.first; i <= range.last; ++i) d.push_back(both.at(i));
        differences.push_back(std::move(d));
    }
    const NoiseFit fit = fitter.fit(differences, std::hypot(floor_of(records.scale), floor_of(records.encoder)));
    if (!fit.moved) return axis;
    // The deflection of the drive is an error of its encoder.
    axis.encoder_sigma = std::hypot(encoder.sigma, axis.yield);
    axis.weight = std::pow(scale.sigma / std::hypot(scale.sigma, axis.encoder_sigma), 2);
    SmootherModel model;
    model.period = records.period;
    model.position_sigma = fit.sigma;
    model.wandering = fit.wandering;
    const KalmanSmoother smoother(model);
    for (int d = 0; d < 4; ++d) axis.remaining[static_cast<std::size_t>(d)] = axis.weight * smoother.sigma(d);
    const KalmanSmoother half = of_every_second(smoother);
    const double quantum = quantum_of(records.scale);
    for (const PointRange& range : ranges) fuse_range(both, range, smoother, half, quantum, axis);
    return axis;
}

}  // namespace clsurf
