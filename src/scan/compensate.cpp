#include "scan/compensate.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.h"
#include "scan/append_tips.h"

namespace clsurf {
namespace {

/// Tips at equal steps of x, between the tips of the program.
std::vector<Vec2> resampled(const std::vector<Vec2>& tips, double step) {
    std::vector<Vec2> even;
    const double begin = tips.front().x();
    const double length = tips.back().x() - begin;
    const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(length / step)));
    std::size_t k = 0;
    for (std::size_t n = 0; n <= count; ++n) {
        const double x = begin + length * static_cast<double>(n) / static_cast<double>(count);
        while (k + 2 < tips.size() && tips[k + 1].x() < x) ++k;
        const double t = std::clamp((x - tips[k].x()) / (tips[k + 1].x() - tips[k].x()), 0.0, 1.0);
        even.emplace_back(x, tips[k].y() + t * (tips[k + 1].y() - tips[k].y()));
    }
    return even;
}

/// The surface that the ball leaves: under each tip the point of contact. A program of lines has corners; its slope at a
/// tip is that of the chord over the length of a line of this tolerance.
std::vector<Vec2> contacts_of(const std::string& name, const std::vector<Vec2>& even, double radius, double tolerance) {
    if (radius == 0) return even;
    std::vector<Vec2> contacts;
    const double step = even[1].x() - even[0].x();
    const double chord = std::sqrt(8 * tolerance * radius);
    const auto reach = static_cast<std::size_t>(std::max(1.0, std::round(chord / step)));
    for (std::size_t i = 0; i < even.size(); ++i) {
        // Equal length on both sides: the chord is then parallel to the curve in the middle, to third order.
        const std::size_t n = std::max<std::size_t>(1, std::min({reach, i, even.size() - 1 - i}));
        const Vec2& before = even[i >= n ? i - n : i];
        const Vec2& after = even[std::min(i + n, even.size() - 1)];
        const double slope = (after.y() - before.y()) / (after.x() - before.x());
        const double length = std::hypot(1.0, slope);
        const Vec2 contact(even[i].x() + radius * slope / length, even[i].y() + radius - radius / length);
        if (!contacts.empty() && contact.x() <= contacts.back().x()) {
            if (contact.x() < contacts.back().x() - chord)
                throw InputError(
                    Place::of_file(name),
                    fmt::format("the pass is tighter than a ball of radius {:g} mm at X {:.3f} mm: it has gouged there",
                                radius, even[i].x()),
                    "--tool-offset is the radius of the ball that made the pass");
            continue;
        }
        contacts.push_back(contact);
    }
    return contacts;
}

/// The fitted deviation; beyond the first and the last one it is constant.
class FittedDeviation {
public:
    FittedDeviation(const std::string& name, std::span<const ScanPoint> deviations, const CompensationRules& rules)
        : name_(name), scan_(clean_scan(deviations, rules.outliers)) {
        const std::size_t fewest = std::max<std::size_t>(2, static_cast<std::size_t>(rules.fit.degree) + 1);
        if (scan_.x.size() < fewest)
            throw InputError(Place::of_file(name), fmt::format("has {} deviations of different x: degree {} needs {}",
                                                               scan_.x.size(), rules.fit.degree, fewest));
        fit_ = fit_windows(scan_.x, scan_.z, rules.fit);
    }

    /// Throws InputError if the pass continues without deviations.
    void check_cover(double from, double to) const {
        constexpr double share = 0.02;  // share of the pass that may be uncovered at each end
        const double most_beyond = share * (to - from);
        if (scan_.x.front() - from > most_beyond || to - scan_.x.back() > most_beyond)
            throw InputError(
                Place::of_file(name_),
                fmt::format("has deviations from X {:.3f} to {:.3f} mm: the pass goes from {:.3f} to {:.3f}",
                            scan_.x.front(), scan_.x.back(), from, to));
    }
    [[nodiscard]] double at(double x) const { return fit_.at(std::clamp(x, scan_.x.front(), scan_.x.back())); }
    [[nodiscard]] FitResiduals residuals() const { return fit_residuals(scan_, fit_); }
    [[nodiscard]] const CleanScan& scan() const { return scan_; }

private:
    const std::string& name_;
    CleanScan scan_;
    WindowedFit fit_;
};

}  // namespace

PassTips pass_tips(const Program& program) {
    const Motions& motions = program.motions;
    constexpr const char* hint = "one pass in the XZ plane, as `clsurf profile` writes it";
    const auto fail = [&](std::size_t k, const std::string& what) {
        throw InputError(Place::of_line(program.main().name(), motions.line[k]), what, hint);
    };
    PassTips pass;
    std::vector<Vec2>& tips = pass.places;
    for (std::int64_t i = 0; i < motions.size(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (!is_cut(motions.kind[k])) continue;
        const Xyz& end = motions.end[k];
        if (tips.empty()) {  // the approach
            pass.y = end.y;
            tips.emplace_back(end.x, end.z);
            continue;
        }
        constexpr double tolerance = 1e-6;  // mm
        if (std::abs(end.y - pass.y) > tolerance) fail(k, "the pass leaves its plane: Y changes");
        if (is_arc(motions.kind[k])) fail(k, "the pass has an arc: lines and splines can be corrected");
        append_tips(motions, i, tips);
    }
    const Place place = Place::of_file(program.main().name());
    if (tips.size() < 2) throw InputError(place, "has no pass at feed", hint);
    if (tips.back().x() < tips.front().x()) std::reverse(tips.begin(), tips.end());
    for (std::size_t k = 1; k < tips.size(); ++k) {
        if (!(tips[k].x() > tips[k - 1].x()))
            throw InputError(place, fmt::format("the pass turns back in X at {:.4f} mm", tips[k].x()), hint);
    }
    return pass;
}

Compensation compensate(const std::string& name, std::span<const ScanPoint> deviations, const std::vector<Vec2>& tips,
                        const CompensationRules& rules) {
    constexpr double fewest = 400, most = 20000;  // points of the profile
    const FittedDeviation deviation(name, deviations, rules);
    const double length = tips.back().x() - tips.front().x();
    const double wanted = 4.0 * static_cast<double>(std::max(tips.size(), deviations.size()));
    const std::vector<Vec2> even = resampled(tips, length / std::clamp(wanted, fewest, most));
    const std::vector<Vec2> contacts = contacts_of(name, even, rules.radius, rules.tolerance);
    deviation.check_cover(contacts.front().x(), contacts.back().x());
    Compensation result;
    result.deviations = deviation.scan();
    result.residuals = deviation.residuals();
    for (const Vec2& contact : contacts) {
        const double off = deviation.at(contact.x());
        if (std::abs(off) > result.greatest) {
            result.greatest = std::abs(off);
            result.greatest_x = contact.x();
        }
        result.target.push_back({contact.x(), contact.y() - off});
    }
    return result;
}

}  // namespace clsurf
