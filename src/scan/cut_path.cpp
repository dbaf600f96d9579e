#include "scan/cut_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace clsurf {
namespace {

/// Number of chords that stay within `error` of a piece, and of the path of a ball that follows it.
std::size_t chords_of(const FitPiece& piece, double radius, double error) {
    constexpr int examined = 8;
    double second = 0;
    for (int k = 0; k <= examined; ++k) {
        const double x = piece.begin + (piece.end - piece.begin) * k / examined;
        const FitJet jet = piece.jet(x);
        // The path turns like the fit, over a chord that is longer by the factor 1 + radius · curvature.
        const double curvature = std::abs(jet.second) / std::pow(1 + jet.slope * jet.slope, 1.5);
        second = std::max(second, std::abs(jet.second) * (1 + radius * curvature));
    }
    const double length = piece.end - piece.begin;
    constexpr double fewest = 4, most = 4096;
    return static_cast<std::size_t>(
        std::clamp(std::ceil(std::sqrt(second * length * length / (8 * error))), fewest, most));
}

/// Directions from a place [rad] that pass all samples so far within the tolerance.
struct Sleeve {
    double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();

    [[nodiscard]] bool takes(const Vec2& chord) const {
        const double direction = std::atan2(chord.y(), chord.x());
        return low <= direction && direction <= high;
    }
    void pass(const Vec2& chord, double tolerance) {
        const double length = chord.norm();
        if (length <= tolerance) return;
        const double direction = std::atan2(chord.y(), chord.x());
        const double half_angle = std::asin(tolerance / length);
        low = std::max(low, direction - half_angle);
        high = std::min(high, direction + half_angle);
    }
};

}  // namespace

Vec2 CutSpan::at(double t) const {
    const double s = 1 - t;
    return s * s * (1 + 2 * t) * begin + t * t * (1 + 2 * s) * end + s * s * t * begin_slope - t * t * s * end_slope;
}

CutPath::CutPath(WindowedFit fit, double radius, double tolerance)
    : fit_(std::move(fit)), radius_(radius), tolerance_(tolerance) {
    for (const FitPiece& piece : fit_.pieces) {
        constexpr double share = 0.05;  // of the tolerance
        const std::size_t chords = chords_of(piece, radius, share * tolerance);
        for (std::size_t k = 0; k <= chords; ++k) {
            const double part = static_cast<double>(k) / static_cast<double>(chords);
            const double x = k == chords ? piece.end : piece.begin + part * (piece.end - piece.begin);
            const Vec2 at = place(piece, x);
            constexpr double same = 1e-9;  // mm
            if (!samples_.empty() && (at - samples_.back()).norm() < same) continue;
            samples_.push_back(at);
            contacts_.emplace_back(x, piece.at(x));
        }
    }
}

Vec2 CutPath::place(const FitPiece& piece, double x) const {
    const FitJet jet = piece.jet(x);
    const double scale = radius_ / std::sqrt(1 + jet.slope * jet.slope);
    return {x - scale * jet.slope, jet.z + scale - radius_};
}

Vec2 CutPath::derivative(const FitPiece& piece, double x) const {
    const FitJet jet = piece.jet(x);
    return (1 - radius_ * jet.second / std::pow(1 + jet.slope * jet.slope, 1.5)) * Vec2(1, jet.slope);
}

std::optional<Gouge> CutPath::gouge() const {
    if (radius_ <= 0) return std::nullopt;
    Gouge deepest;
    std::size_t first = 0;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
        const Vec2 centre = samples_[i] + Vec2(0, radius_);
        // Contacts increase in x, centres need not: in a loop they go back.
        while (first < contacts_.size() && contacts_[first].x() < contacts_[i].x() - 2 * radius_) ++first;
        for (std::size_t k = first; k < contacts_.size() && contacts_[k].x() < contacts_[i].x() + 2 * radius_; ++k) {
            const double depth = radius_ - (contacts_[k] - centre).norm();
            if (depth > deepest.depth) deepest = {contacts_[i].x(), depth, 0};
        }
    }
    if (deepest.depth <= tolerance_) return std::nullopt;
    double curvature = 0;
    for (const Vec2& contact : contacts_) {
        const FitJet jet = fit_.piece_at(contact.x()).jet(contact.x());
        curvature = std::max(curvature, jet.second / std::pow(1 + jet.slope * jet.slope, 1.5));
    }
    deepest.least_radius = curvature > 0 ? 1 / curvature : std::numeric_limits<double>::infinity();
    return deepest;
}

std::vector<Vec2> CutPath::points() const {
    constexpr double share = 0.9;  // share of the tolerance; the rest is for chords between samples and rounding
    const double tolerance = share * tolerance_;
    std::vector<Vec2> ends{samples_.front()};
    Sleeve sleeve;
    for (std::size_t i = 1; i < samples_.size(); ++i) {
        if (!sleeve.takes(samples_[i] - ends.back())) {
            ends.push_back(samples_[i - 1]);
            sleeve = {};
        }
        sleeve.pass(samples_[i] - ends.back(), tolerance);
    }
    ends.push_back(samples_.back());
    return ends;
}

CutSpan CutPath::span_of(const FitPiece& piece, double from, double to) const {
    return {place(piece, from), place(piece, to), (to - from) * derivative(piece, from),
            (to - from) * derivative(piece, to)};
}

std::vector<CutSpan> CutPath::spans() const {
    std::vector<CutSpan> spans;
    for (const FitPiece& piece : fit_.pieces) {
        double from = piece.begin;
        double to = piece.end;
        while (from < piece.end) {
            const CutSpan span = span_of(piece, from, to);
            double error = 0;
            constexpr int examined = 16;
            for (int k = 1; k < examined; ++k) {
                const double t = static_cast<double>(k) / examined;
                error = std::max(error, (span.at(t) - place(piece, from + t * (to - from))).norm());
            }
            constexpr double share = 0.5, shortest = 1e-3;  // of the tolerance; mm
            if (error > share * tolerance_ && to - from > shortest) {
                to = from + 0.5 * (to - from);
                continue;
            }
            spans.push_back(span);
            from = to;
            to = piece.end;
        }
    }
    return spans;
}

}  // namespace clsurf
