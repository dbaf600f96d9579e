#include "repair/feeds/ramp.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace clsurf {
namespace {

constexpr float speed_rounding = 0.001F;  ///< share of a speed: peaks are not lowered by less

class RampKeeper {
public:
    RampKeeper(const Ramp& ramp, double period, std::span<const float> own, std::span<float> speeds,
               std::span<std::int32_t> causes)
        : acceleration_(static_cast<float>(ramp.acceleration)),
          jerk_(static_cast<float>(ramp.jerk)),
          period_(static_cast<float>(period)),
          own_(own),
          speeds_(speeds),
          causes_(causes) {}

    void keep() {
        const auto n = static_cast<std::ptrdiff_t>(speeds_.size());
        // First with zero acceleration at each low place, so that all low places can be reached. Then they may be left as they
        // are reached, with the acceleration still negative.
        for (const float least_growth : {0.0F, -acceleration_}) {
            grow(0, n, 1, least_growth);
            grow(n - 1, -1, -1, least_growth);
        }
        round_peaks();
    }

private:
    /// Limits the rise of the speed from one end to the other; used in both directions.
    void grow(std::ptrdiff_t from, std::ptrdiff_t end, std::ptrdiff_t direction, float least_growth) {
        float growth = acceleration_;  // [mm/s²]
        for (std::ptrdiff_t i = from + direction; i != end; i += direction) {
            const auto k = static_cast<std::size_t>(i), before = static_cast<std::size_t>(i - direction);
            const float speed = speeds_[before];
            if (!(speed > 0)) continue;
            const float seconds = period_ * std::max(1.0F, own_[k] / speed);  // a lowered place takes longer
            const float faster = std::min(acceleration_, growth + jerk_ * seconds);
            const float reached = speed + std::max(faster * seconds, own_[k] - own_[before]);
            if (reached < speeds_[k]) {
                speeds_[k] = reached;
                if (causes_[k] < 0) causes_[k] = causes_[before];
                growth = faster;
            } else {
                growth = std::clamp((speeds_[k] - speed) / seconds, least_growth, acceleration_);
            }
        }
    }

    void round_peaks() {
        const std::vector<float> rounded = opened(speeds_), own_rounded = opened(own_);
        const std::size_t n = speeds_.size();
        for (std::size_t k = 0; k < n; ++k) {
            const float reached = rounded[k] + (own_[k] - own_rounded[k]);
            if (!(reached < (1 - speed_rounding) * speeds_[k])) continue;
            speeds_[k] = reached;
            if (causes_[k] < 0 && k > 0) causes_[k] = causes_[k - 1];
        }
        for (std::size_t k = n - 1; k-- > 0;) {
            if (causes_[k] < 0 && speeds_[k] < own_[k]) causes_[k] = causes_[k + 1];
        }
    }

    /// Morphological opening by the parabola of a speed at constant jerk: the greatest speeds below these whose peaks are no
    /// sharper.
    [[nodiscard]] std::vector<float> opened(std::span<const float> speeds) const {
        const float drop = 0.5F * jerk_ * period_ * period_;
        std::vector<float> curve = lowered_by_parabolas({speeds.begin(), speeds.end()}, drop);
        for (float& v : curve) v = -v;
        curve = lowered_by_parabolas(curve, drop);
        for (float& v : curve) v = -v;
        return curve;
    }

    /// The minimum of values[j] + bend (i − j)² over all j, for each i: a lower envelope of parabolas, each of which is the
    /// lowest on one section. O(values). Felzenszwalb, Huttenlocher, Distance Transforms of Sampled Functions, Theory of
    /// Computing 8 (2012) 415.
    static std::vector<float> lowered_by_parabolas(const std::vector<float>& values, float bend) {
        struct Lowest {
            std::size_t apex = 0;
            double from = 0;  ///< beginning of its section
        };
        std::vector<Lowest> lowest;
        for (std::size_t i = 0; i < values.size(); ++i) {
            double from = -1;
            while (!lowest.empty()) {
                const auto a = static_cast<double>(lowest.back().apex), b = static_cast<double>(i);
                const double rise = static_cast<double>(values[i]) - static_cast<double>(values[lowest.back().apex]);
                from = (rise + bend * (b * b - a * a)) / (2 * bend * (b - a));
                if (from > lowest.back().from) break;
                lowest.pop_back();
                from = -1;
            }
            lowest.push_back({i, from});
        }
        std::vector<float> result(values.size());
        for (std::size_t i = 0, k = 0; i < values.size(); ++i) {
            while (k + 1 < lowest.size() && lowest[k + 1].from < static_cast<double>(i)) ++k;
            const float apart = static_cast<float>(i) - static_cast<float>(lowest[k].apex);
            result[i] = values[lowest[k].apex] + bend * apart * apart;
        }
        return result;
    }

    float acceleration_, jerk_, period_;
    std::span<const float> own_;
    std::span<float> speeds_;
    std::span<std::int32_t> causes_;
};

/// The number of points, up to `most`, after which a lowered speed has certainly returned: twice what the machine needs from
/// rest.
std::size_t recovery(const Ramp& ramp, double period, double speed, std::size_t most) {
    const double seconds = speed / ramp.acceleration + ramp.acceleration / ramp.jerk;
    return static_cast<std::size_t>(std::min(static_cast<double>(most), std::ceil(2 * seconds / period)));
}

}  // namespace

Ramp ramp_of(const Machine& machine) {
    Ramp ramp{machine.path.max_acceleration, machine.path.max_jerk};
    for (const MachineAxis& axis : machine.axes) {
        ramp.acceleration = std::min(ramp.acceleration, axis.max_acceleration);
        if (axis.max_jerk > 0) ramp.jerk = std::min(ramp.jerk, axis.max_jerk);
    }
    return ramp;
}

void keep_to_ramp(const Ramp& ramp, double period, std::span<const float> own, std::span<float> speeds,
                  std::span<std::int32_t> causes) {
    if (!std::isfinite(ramp.jerk) || !std::isfinite(ramp.acceleration)) return;
    const auto lowered = [&](std::size_t from) {
        while (from < own.size() && (causes[from] < 0 || !(speeds[from] < own[from]))) ++from;
        return from;
    };
    std::size_t next = lowered(0);
    if (next == own.size()) return;
    const std::size_t reach = recovery(ramp, period, *std::max_element(own.begin(), own.end()), own.size());
    while (next < own.size()) {
        const std::size_t first = next - std::min(next, reach);
        std::size_t last = next;
        for (next = lowered(last + 1); next < own.size() && next - last <= 2 * reach; next = lowered(last + 1))
            last = next;
        const std::size_t count = std::min(own.size(), last + reach + 1) - first;
        RampKeeper(ramp, period, own.subspan(first, count), speeds.subspan(first, count), causes.subspan(first, count))
            .keep();
    }
}

}  // namespace clsurf
