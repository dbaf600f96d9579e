// Speed and acceleration from all measurements of a log, compared with the truth of a made motion: the errors must be as
// large as stated and smaller than those of a window, and the time offset of a channel to the positions must be found.

#include "toolpath/motion_estimate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "numeric/derivative.h"

namespace clsurf::motion_estimate_test {
namespace {

constexpr double period = 0.001;

/// A circle of radius 20 whose speed varies between 30 and 60 mm/s in jerk-limited ramps.
struct Ramps {
    static constexpr int count = 12000;
    std::array<std::vector<double>, 3> positions;
    std::vector<double> speeds, exact_speed;  ///< recorded [mm/min]; true [mm/s]
    std::vector<Vec3> velocity, acceleration;
    Log log;
    std::vector<PointRange> pieces{{0, count - 1}};

    Ramps(double quantum, bool with_speed) {
        constexpr int fine = 50;
        constexpr double step = period / fine;
        constexpr double jerk = 60000;
        double s = 0, v = 30, a = 0;
        for (int i = 0; i < count; ++i) {
            const double angle = s / 20;
            const Vec3 along(-std::sin(angle), std::cos(angle), 0);
            const Vec3 inward(-std::cos(angle), -std::sin(angle), 0);
            const Vec3 p(20 * std::cos(angle), 20 * std::sin(angle), 4);
            for (int k = 0; k < 3; ++k)
                positions[static_cast<std::size_t>(k)].push_back(std::round(p[k] / quantum) * quantum);
            exact_speed.push_back(v);
            velocity.push_back(v * along);
            acceleration.push_back(a * along + v * v / 20 * inward);
            speeds.push_back(std::round(v * 60));
            for (int f = 0; f < fine; ++f) {
                // Every 0.3 s a ramp of 2 · 22.36 ms, alternately up and down: 60000 · 0.02236² = 30 mm/s.
                const double t = std::fmod(i * period + f * step, 0.3) - 0.1;
                const bool up = std::fmod(i * period + f * step, 0.6) < 0.3;
                constexpr double half = 0.0223606797749979;
                const double j = t < 0 || t >= 2 * half ? 0 : (t < half ? jerk : -jerk) * (up ? 1 : -1);
                s += v * step + 0.5 * a * step * step;
                v += a * step;
                a += j * step;
                if (t < 0 || t >= 2 * half) a = 0;
            }
        }
        log.name = "ramps";
        log.period = period;
        log.records = count;
        const auto view = [](const std::vector<double>& x) {
            return ChannelView{reinterpret_cast<const std::byte*>(x.data()), 8, count, ScalarType::f64, false, 1, 0};
        };
        for (std::size_t k = 0; k < 3; ++k)
            log.channels.push_back({std::string("cmd.") + "xyz"[k], "mm", view(positions[k])});
        if (with_speed) log.channels.push_back({"speed", "mm/min", view(speeds)});
    }

    void record_speed(double lead) {
        for (int i = 0; i < count; ++i) {
            // The motion of the axes `lead` records later, interpolated with the acceleration.
            const double at = std::clamp(i + lead, 0.0, count - 1.0);
            const auto whole = static_cast<std::size_t>(at);
            const double next = exact_speed[std::min<std::size_t>(whole + 1, count - 1)];
            const double part = at - static_cast<double>(whole);
            speeds[static_cast<std::size_t>(i)] = std::round(60 * (exact_speed[whole] * (1 - part) + next * part));
        }
    }

    struct Errors {
        double speed = 0, acceleration = 0;  ///< rms
        double covered = 0;                  ///< share of the speeds within three standard deviations
    };
    [[nodiscard]] Errors kalman(std::string* note = nullptr, double* speed_sigma = nullptr,
                                double* acceleration_sigma = nullptr) const {
        const Trajectory path = reconstruct(log, Role::commanded, Vec3::Zero());
        const MotionEstimate estimate(log, path, pieces);
        EXPECT_LE(estimate.nees(), 2);
        if (note != nullptr) *note = estimate.note(2);
        if (speed_sigma != nullptr) *speed_sigma = estimate.sigma(1);
        if (acceleration_sigma != nullptr) *acceleration_sigma = estimate.sigma(2);
        MotionEstimate::Scratch scratch;
        std::array<std::array<std::vector<double>, 3>, 4> out;
        estimate.estimate(pieces[0], 0, count - 1, scratch, out);
        Errors sums = errors(out[1], out[2]);
        std::vector<double> sigmas(count);
        estimate.sigmas(1, pieces[0], 0, scratch, sigmas);
        for (std::size_t i = 100; i + 100 < count; ++i) {
            const double off = Vec3(out[1][0][i], out[1][1][i], out[1][2][i]).norm() - exact_speed[i];
            if (std::abs(off) <= 3 * sigmas[i]) sums.covered += 1.0 / (count - 200);
        }
        return sums;
    }
    [[nodiscard]] Errors window() const {
        std::array<std::array<std::vector<double>, 3>, 2> out;
        for (int d = 1; d <= 2; ++d) {
            const Differentiator filter(derivative_filter(d, period));
            for (std::size_t k = 0; k < 3; ++k) {
                std::vector<double>& values = out[static_cast<std::size_t>(d - 1)][k];
                values.resize(count);
                filter.apply(positions[k], 0, pieces[0], 0, values);
            }
        }
        return errors(out[0], out[1]);
    }

private:
    [[nodiscard]] Errors errors(const std::array<std::vector<double>, 3>& v,
                                const std::array<std::vector<double>, 3>& a) const {
        Errors sums;
        int n = 0;
        for (std::size_t i = 100; i + 100 < count; ++i, ++n) {
            const Vec3 speed(v[0][i], v[1][i], v[2][i]);
            sums.speed += std::pow(speed.norm() - exact_speed[i], 2);
            sums.acceleration += (Vec3(a[0][i], a[1][i], a[2][i]) - acceleration[i]).squaredNorm();
        }
        return {std::sqrt(sums.speed / n), std::sqrt(sums.acceleration / n), 0};
    }
};

TEST(MotionEstimate, KnowsMoreThanAWindowWhereTheSpeedIsRecorded) {
    const Ramps ramps(0.001, true);
    const Ramps::Errors ours = ramps.kalman();
    const Ramps::Errors window = ramps.window();
    EXPECT_LT(ours.speed, 0.5 * window.speed) << ours.speed << " against " << window.speed;
    EXPECT_LT(ours.acceleration, 0.6 * window.acceleration) << ours.acceleration << " against " << window.acceleration;
}

TEST(MotionEstimate, SaysWhatPositionsAloneCannotTell) {
    double speed_sigma = 0, acceleration_sigma = 0, known_speed = 0;
    std::string note;
    const Ramps::Errors blind = Ramps(0.001, false).kalman(&note, &speed_sigma, &acceleration_sigma);
    (void)Ramps(0.001, true).kalman(nullptr, &known_speed);
    EXPECT_NE(note.find("acceleration known to"), std::string::npos) << note;
    EXPECT_LT(known_speed, 0.5 * speed_sigma);
    // The stated errors are the true ones: speed has one component, acceleration two
    // (z does not move).
    EXPECT_GT(blind.speed, 0.4 * speed_sigma);
    EXPECT_LT(blind.speed, 2 * speed_sigma);
    EXPECT_GT(blind.acceleration, 0.4 * acceleration_sigma * std::sqrt(2));
    EXPECT_LT(blind.acceleration, 2 * acceleration_sigma * std::sqrt(2));
    const Ramps::Errors window = Ramps(0.001, false).window();
    EXPECT_LT(blind.acceleration, window.acceleration);
}

TEST(MotionEstimate, MissingPositionsStayMissing) {
    Ramps ramps(0.001, false);
    for (std::size_t k = 0; k < 3; ++k) ramps.positions[k][5000] = std::nan("");
    const Trajectory path = reconstruct(ramps.log, Role::commanded, Vec3::Zero());
    const MotionEstimate estimate(ramps.log, path, ramps.pieces);
    MotionEstimate::Scratch scratch;
    std::array<std::array<std::vector<double>, 3>, 4> out;
    estimate.estimate(ramps.pieces[0], 4900, 5100, scratch, out);
    for (int i = 0; i <= 200; ++i) {
        EXPECT_EQ(std::isnan(out[1][0][static_cast<std::size_t>(i)]), i == 100) << i;
        if (i == 100) continue;
        EXPECT_NEAR(out[1][0][static_cast<std::size_t>(i)], ramps.velocity[static_cast<std::size_t>(4900 + i)].x(),
                    1.5);
    }
}

// LinuxCNC's speed belongs to the position two records later (measured, in its logs); other controls filter theirs.
TEST(MotionEstimate, FindsHowFarTheChannelOfTheSpeedIsAhead) {
    for (const double lead : {0.0, 2.0, 2.4, -3.0}) {
        Ramps ramps(0.001, true);
        ramps.record_speed(lead);
        const Trajectory path = reconstruct(ramps.log, Role::commanded, Vec3::Zero());
        const MotionEstimate estimate(ramps.log, path, ramps.pieces);
        EXPECT_NEAR(estimate.speed_lead(), lead, 0.1);
        EXPECT_EQ(estimate.note(1).find("ahead of the positions") != std::string::npos, lead > 0) << estimate.note(1);
        EXPECT_LT(ramps.kalman().speed, 0.6 * ramps.window().speed) << lead;
    }
}

TEST(MotionEstimate, ThreeDeviationsHoldTheErrors) {
    for (const double quantum : {1e-7, 1e-4, 1e-3}) {
        for (const bool with_speed : {false, true}) {
            Ramps ramps(quantum, with_speed);
            if (with_speed) ramps.record_speed(2);
            const Ramps::Errors ours = ramps.kalman();
            EXPECT_GE(ours.covered, 0.99) << quantum << ' ' << with_speed;
            EXPECT_LT(ours.speed, ramps.window().speed) << quantum << ' ' << with_speed;
        }
    }
}

TEST(MotionEstimate, APartOfARunIsKnownAsWellAsInTheWhole) {
    const Ramps ramps(1e-4, false);
    const Trajectory path = reconstruct(ramps.log, Role::commanded, Vec3::Zero());
    const MotionEstimate estimate(ramps.log, path, ramps.pieces);
    MotionEstimate::Scratch scratch;
    std::array<std::array<std::vector<double>, 3>, 4> out;
    std::vector<double> whole(Ramps::count), part(50);
    estimate.estimate(ramps.pieces[0], 0, Ramps::count - 1, scratch, out);
    estimate.sigmas(1, ramps.pieces[0], 0, scratch, whole);
    for (PointIndex first = 1000; first < 1650; first += 7) {  // two ramps and the motion between them
        estimate.estimate(ramps.pieces[0], first, first + 49, scratch, out);
        estimate.sigmas(1, ramps.pieces[0], first, scratch, part);
        for (std::size_t i = 0; i < part.size(); ++i)
            ASSERT_NEAR(part[i], whole[static_cast<std::size_t>(first) + i], 1e-3 * part[i]) << first << ' ' << i;
    }
}

// A programmed feed has the name of the speed in some logs.
TEST(MotionEstimate, AChannelThatIsNotTheSpeedTeachesNothing) {
    Ramps ramps(0.001, true);
    std::fill(ramps.speeds.begin(), ramps.speeds.end(), 3000.0);
    const double with = ramps.kalman().speed;
    EXPECT_EQ(with, Ramps(0.001, false).kalman().speed);
}

// A speed that reads zero in one record of 500 is not an error that a standard deviation can describe.
TEST(MotionEstimate, IsRefusedWhereItsErrorsCannotBeStated) {
    Ramps ramps(0.001, true);
    for (std::size_t i = 250; i < ramps.speeds.size(); i += 500) ramps.speeds[i] = 0;
    const Trajectory path = reconstruct(ramps.log, Role::commanded, Vec3::Zero());
    try {
        const MotionEstimate estimate(ramps.log, path, ramps.pieces);
        FAIL() << estimate.nees();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("mean square"), std::string::npos) << error.what();
        EXPECT_EQ(error.diagnostic().hint, "use --derivative savgol");
    }
}

}  // namespace
}  // namespace clsurf::motion_estimate_test
