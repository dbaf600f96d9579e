#include "toolpath/smoother_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/block.h"

namespace clsurf {
namespace {

constexpr PointIndex section_points = 2000;  ///< points of a section on which the model is measured
constexpr PointIndex sections = 48;          ///< evenly spaced over the pieces
constexpr PointIndex least_piece = 100;      ///< points
constexpr double gap = 1.5;                  ///< periods; a longer interval between records ends a piece
constexpr double most_wandering = 1e6, least_wandering = 1e-17;
/// The likelihood determines the wandering only roughly: it is found to a factor of √10.
constexpr double wandering_step = 3.1622776601683795;
constexpr double moving_steps = 10;  ///< an axis that stays within this many steps has no information on the motion

}  // namespace

std::vector<PointRange> sample_sections(const std::vector<PointRange>& pieces) {
    PointIndex all = 0;
    for (const PointRange& piece : pieces) all += piece.size() >= least_piece ? piece.size() : 0;
    const PointIndex every = std::max(section_points, all / sections);
    std::vector<PointRange> samples;
    PointIndex next = 0;  // start of the next section, counted from the piece's first point
    for (const PointRange& piece : pieces) {
        if (piece.size() < least_piece) continue;
        for (; next < piece.size(); next += every) {
            const PointIndex first = piece.first + std::min(next, piece.size() - least_piece);
            samples.push_back({first, std::min(piece.last, first + section_points - 1)});
        }
        next -= piece.size();
    }
    if (samples.empty() && !pieces.empty())
        samples.push_back(*std::max_element(pieces.begin(), pieces.end(), [](const PointRange& a, const PointRange& b) {
            return a.size() < b.size();
        }));
    return samples;
}

void copy_ahead(const ChannelView& view, PointIndex count, PointIndex first, double lead, std::vector<double>& out) {
    const auto whole = static_cast<PointIndex>(std::floor(-lead));
    const double u = -lead - static_cast<double>(whole);
    const std::array<double, 4> weights{-u * (u - 1) * (u - 2) / 6, (u + 1) * (u - 1) * (u - 2) / 2,
                                        -(u + 1) * u * (u - 2) / 2, (u + 1) * u * (u - 1) / 6};
    const auto n = static_cast<PointIndex>(out.size());
    const PointIndex from = first + whole - 1;  // of the four records around the first point's
    std::vector<double> records(out.size() + 3, std::numeric_limits<double>::quiet_NaN());
    const PointIndex begin = std::max<PointIndex>(from, 0);
    const PointIndex end = std::min(from + n + 3, count);
    if (begin < end)
        copy_block(
            view, begin,
            std::span(records).subspan(static_cast<std::size_t>(begin - from), static_cast<std::size_t>(end - begin)));
    for (std::size_t i = 0; i < out.size(); ++i) {
        out[i] = u == 0 ? records[i + 1]
                        : weights[0] * records[i] + weights[1] * records[i + 1] + weights[2] * records[i + 2] +
                              weights[3] * records[i + 3];
    }
}

std::vector<PointRange> cut_at_gaps(const Log& log, std::vector<PointRange> pieces) {
    const Channel* time = log.find("time");
    if (time == nullptr) return pieces;
    std::vector<PointRange> whole;
    std::vector<double> t;
    for (PointRange piece : pieces) {
        for (PointIndex begin = piece.first; begin < piece.last; begin += block_points) {
            const PointIndex end = std::min(piece.last, begin + block_points);
            t.resize(static_cast<std::size_t>(end - begin + 1));
            copy_block(time->values, begin, t);
            for (std::size_t i = 1; i < t.size(); ++i) {
                if (t[i] - t[i - 1] <= gap * log.period) continue;
                const PointIndex cut = begin + static_cast<PointIndex>(i);
                whole.push_back({piece.first, cut - 1});
                piece.first = cut;
            }
        }
        whole.push_back(piece);
    }
    return whole;
}

const KalmanSmoother& NoiseFitter::filter(int step, double wandering) {
    const auto found = filters_.find(step);
    if (found != filters_.end()) return found->second;
    SmootherModel tried;
    tried.period = 1;
    tried.position_sigma = 1;
    tried.wandering = wandering;
    return filters_.emplace(step, tried).first->second;
}

NoiseFit NoiseFitter::fit(const std::vector<std::vector<double>>& series, double floor) {
    NoiseFit best;
    best.sigma = floor;
    double least = std::numeric_limits<double>::infinity();
    double most = 0;
    int step = 0;
    for (double wandering = most_wandering; wandering > least_wandering; wandering /= wandering_step, ++step) {
        const KalmanSmoother& tried = filter(step, wandering);
        double squares = 0;
        double count = 0;
        double log_variance = 0;
        for (const std::vector<double>& values : series) {
            const KalmanSmoother::Innovations sums = tried.innovations(values);
            squares += sums.squares;
            count += static_cast<double>(sums.count);
            log_variance = sums.log_variance;
        }
        // If the gains settle too late, few records remain, and not the same ones.
        most = std::max(most, count);
        if (!(count > 0.5 * most)) break;
        // The likelihood at its maximum over the uncertainty of a position, which is at least the uncertainty from the quantum.
        const double variance = std::max(squares / count, floor * floor);
        const double cost = std::log(variance) + squares / count / variance + log_variance;
        if (!(cost < least)) continue;
        least = cost;
        best.sigma = std::sqrt(variance);
        best.rounding_rules = variance <= 2 * floor * floor && floor > finest_position;
        best.wandering = wandering;
        best.moved = true;
    }
    return best;
}

bool moves(const std::vector<double>& positions, double floor) {
    const auto [low, high] = std::minmax_element(positions.begin(), positions.end());
    return low != positions.end() && *high - *low > moving_steps * floor;
}

double noise_at_rest(const std::vector<std::vector<double>>& series) {
    double squares = 0, count = 0;
    for (const std::vector<double>& x : series) {
        for (std::size_t i = 1; i + 1 < x.size(); ++i) {
            const double second = x[i - 1] - 2 * x[i] + x[i + 1];
            if (std::isnan(second)) continue;
            squares += second * second;
            ++count;
        }
    }
    return count > 0 ? std::sqrt(squares / count / 6) : 0;
}

}  // namespace clsurf
