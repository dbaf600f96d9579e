// New lines: no very short ones between longer ones.

#include "repair/points/new_lines.h"

#include <gtest/gtest.h>

#include <cmath>

namespace clsurf::new_lines_test {
namespace {

// An old point that is off the line between two aligned points by a little more than allowed is kept as a point. If
// an aligned point is close to it, one of both is dropped: lines of 0.03 mm between lines of 0.1 mm stop controllers that
// replace corners by arcs.
TEST(NewLines, HaveNoStumps) {
    const auto height = [](double x) { return 0.3 * std::sin(0.8 * x); };
    OldSegment old;
    SmoothSegment curve;
    std::vector<AlignedPoint> aligned;
    double length = 0;
    const auto add_old = [&](double x, double off) {
        const Vec3 p(x, 0, height(x) + off);
        if (!old.points.empty()) length += (p - old.points.back()).norm();
        old.points.push_back(p);
        old.arc_length.push_back(length);
        old.motion.push_back(static_cast<std::int64_t>(old.points.size()) - 1);
    };
    for (int k = 0; k <= 40; ++k) add_old(0.13 * k + 0.01, k % 3 == 1 ? 0.0032 : -0.0008);
    const double scale = length / (0.13 * 40);
    for (int k = 0; k <= 52; ++k) {
        const double x = 0.01 + 0.1 * k;
        const Vec3 p(x, 0, height(x));
        curve.points.push_back(k == 0 ? old.points.front() : k == 52 ? old.points.back() : p);
        curve.places.push_back(curve.points.back());
        curve.arc_length.push_back(std::min(length, scale * 0.1 * k));
        if (k > 0 && k < 52) aligned.push_back({.arc_length = curve.arc_length.back(), .number = k, .part = 0.1});
    }
    const LineRules rules{.spacing = 0.1,
                          .usual = 0.1,
                          .shortest_line = 0.02,
                          .chord_error = 0.002,
                          .most = 0.003,
                          .radius = 0.0025,
                          .most_turned = 0};
    const std::vector<NewPlace> ends = new_lines(old, curve, aligned, rules, nullptr);
    ASSERT_GT(ends.size(), 20U);
    EXPECT_EQ(ends.back().position, old.points.back());
    std::vector<double> lengths;
    Vec3 from = old.points.front();
    for (const NewPlace& end : ends) {
        lengths.push_back((end.position - from).norm());
        from = end.position;
    }
    std::size_t stumps = 0;
    for (std::size_t k = 1; k + 1 < lengths.size(); ++k)
        stumps += lengths[k] < 0.3 * std::min(lengths[k - 1], lengths[k + 1]) ? 1 : 0;
    EXPECT_EQ(stumps, 0U);
}

}  // namespace
}  // namespace clsurf::new_lines_test
