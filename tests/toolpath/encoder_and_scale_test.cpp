// The encoder and the scale of an axis as one estimate, compared with the truth of a made table: backlash, pitch error, heat,
// quantisation of both, a time offset of the encoder. It must be better than each alone, and its stated errors must be right.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numeric>
#include <random>
#include <sstream>
#include <string>

#include "core/error.h"
#include "core/units.h"
#include "numeric/derivative.h"
#include "toolpath/motion_estimate.h"

namespace clsurf::encoder_and_scale_test {
namespace {

constexpr double period = 0.001;
constexpr int fine = 50;  ///< steps of the made motion in a period
constexpr double circle = 20;

ChannelView view_of(const std::vector<double>& x) {
    return {reinterpret_cast<const std::byte*>(x.data()),
            8,
            static_cast<PointIndex>(x.size()),
            ScalarType::f64,
            false,
            1,
            0};
}

struct Drive {
    double backlash = 0.010, pitch_error = 0.002, pitch = 10, heat = 0.0004;  ///< [mm], [mm], [mm], [mm/s]
    double encoder_quantum = 1e-4, scale_quantum = 1e-3;                      ///< [mm]
    double noise = 2e-4;    ///< noise of the scale before rounding [mm]
    double lead = 0;        ///< lead of the encoder [records]
    double compliance = 0;  ///< lead of the motor over the screw per acceleration [s²]
};

/// Motors move along a circle whose speed varies between 30 and 60 mm/s in jerk-limited ramps. The table follows
/// when the backlash is crossed, minus the pitch error and the thermal growth of the screw.
struct Machine {
    static constexpr int count = 12000;
    static constexpr int lead_room = 20;  ///< records of motion before and after the log
    std::array<std::vector<double>, 3> encoder, scale, position, velocity;  ///< the last two: truth of the table
    Log log;
    std::vector<PointRange> pieces{{0, count - 1}};

    explicit Machine(const Drive& drive, unsigned seed = 1) {
        const std::vector<double> way = ways();
        std::mt19937 random(seed);
        std::normal_distribution<double> normal;
        for (std::size_t k = 0; k < 3; ++k) {
            std::vector<double> table(way.size());
            double follows = motor(way[0], k);
            for (std::size_t f = 0; f < way.size(); ++f) {
                const double m = motor(way[f], k);
                follows = std::clamp(follows, m - drive.backlash / 2, m + drive.backlash / 2);
                table[f] = k == 2 ? m
                                  : follows - drive.pitch_error * std::sin(2 * M_PI * m / drive.pitch) -
                                        drive.heat * period * static_cast<double>(f) / fine;
            }
            for (int i = 0; i < count; ++i) {
                const auto f = static_cast<std::size_t>((i + lead_room) * fine);
                position[k].push_back(table[f]);
                // The speed over a tenth of a period: there is no better definition where the table starts and stops.
                velocity[k].push_back((table[f + fine / 10] - table[f - fine / 10]) / (0.2 * period));
                const auto ahead = static_cast<std::size_t>(std::lround((i + lead_room + drive.lead) * fine));
                const auto rounded = [](double x, double q) { return std::round(x / q) * q; };
                encoder[k].push_back(rounded(motor(way[ahead], k) + drive.compliance * acceleration(way, ahead, k),
                                             drive.encoder_quantum));
                scale[k].push_back(rounded(table[f] + drive.noise * normal(random), drive.scale_quantum));
            }
        }
        log.name = "machine";
        log.period = period;
        log.records = count;
        add_channels("act.", scale);
        add_channels("fb.", encoder);
    }

    void add_channels(const char* prefix, const std::array<std::vector<double>, 3>& of) {
        for (std::size_t k = 0; k < 3; ++k)
            log.channels.push_back({prefix + std::string(1, "xyz"[k]), "mm", view_of(of[k])});
    }

    static double motor(double s, std::size_t axis) {
        return axis == 0 ? circle * std::cos(s / circle) : axis == 1 ? circle * std::sin(s / circle) : 4.0003;
    }

    /// The acceleration over half a period on each side [mm/s²].
    static double acceleration(const std::vector<double>& way, std::size_t f, std::size_t axis) {
        constexpr std::size_t half = fine / 2;
        if (f < half || f + half >= way.size()) return 0;
        const double second = motor(way[f + half], axis) - 2 * motor(way[f], axis) + motor(way[f - half], axis);
        return second / std::pow(period / 2, 2);
    }

    /// Arc length along the circle at every fine step [mm].
    static std::vector<double> ways() {
        constexpr double step = period / fine, jerk = 60000, half = 0.0223606797749979;  // 60000 · half² = 30 mm/s
        std::vector<double> all;
        double s = 0, v = 30, a = 0;
        for (int f = 0; f < (count + 2 * lead_room) * fine; ++f) {
            all.push_back(s);
            const double t = std::fmod(f * step, 0.3) - 0.1;
            const bool up = std::fmod(f * step, 0.6) < 0.3;
            const double j = t < 0 || t >= 2 * half ? 0 : (t < half ? jerk : -jerk) * (up ? 1 : -1);
            s += v * step + 0.5 * a * step * step;
            v += a * step;
            a = t < 0 || t >= 2 * half ? 0 : a + j * step;
        }
        return all;
    }

    struct Errors {
        double position = 0, speed = 0;                  ///< rms, of an axis [mm]; along the path [mm/s]
        double position_covered = 0, speed_covered = 0;  ///< share within three standard deviations
        double stated = 0;                               ///< median of a position's standard deviation [mm]
    };

    [[nodiscard]] MotionEstimate estimate_of(const Log& of, Role role) const {
        return {of, reconstruct(of, role, Vec3::Zero()), pieces};
    }
    [[nodiscard]] Errors kalman(const Log& of, Role role) const { return kalman(estimate_of(of, role)); }
    [[nodiscard]] Errors kalman(const MotionEstimate& estimate) const {
        EXPECT_LE(estimate.nees(), 2);
        MotionEstimate::Scratch scratch;
        std::array<std::array<std::vector<double>, 3>, 4> out;
        estimate.estimate(pieces[0], 0, count - 1, scratch, out);
        std::array<std::vector<double>, 3> sigmas;
        for (std::vector<double>& axis : sigmas) axis.resize(count);
        estimate.position_sigmas(pieces[0], 0, scratch, sigmas);
        std::vector<double> of_speed(count);
        estimate.sigmas(1, pieces[0], 0, scratch, of_speed);
        return errors(out[0], out[1], &sigmas, &of_speed);
    }
    /// A window over the scale: speeds derived as with `savgol`, positions as recorded.
    [[nodiscard]] Errors window() const {
        std::array<std::vector<double>, 3> v;
        const Differentiator filter(derivative_filter(1, period));
        for (std::size_t k = 0; k < 3; ++k) {
            v[k].resize(count);
            filter.apply(scale[k], 0, pieces[0], 0, v[k]);
        }
        return errors(scale, v, nullptr, nullptr);
    }
    [[nodiscard]] Log scale_only() const {
        Log other = log;
        other.channels.resize(3);
        return other;
    }

private:
    [[nodiscard]] Errors errors(const std::array<std::vector<double>, 3>& p,
                                const std::array<std::vector<double>, 3>& v,
                                const std::array<std::vector<double>, 3>* sigmas,
                                const std::vector<double>* of_speed) const {
        Errors sums;
        double n = 0;
        std::vector<double> stated;
        for (std::size_t i = 100; i + 100 < count; ++i, ++n) {
            for (std::size_t k = 0; k < 3; ++k) {
                const double off = p[k][i] - position[k][i];
                if (k < 2) sums.position += 0.5 * off * off;  // Z does not move
                if (sigmas == nullptr) continue;
                sums.position_covered += std::abs(off) <= 3 * (*sigmas)[k][i] ? 1.0 / 3 : 0;
                if (k < 2) stated.push_back((*sigmas)[k][i]);
            }
            const double off = std::hypot(v[0][i], v[1][i], v[2][i]) - std::hypot(velocity[0][i], velocity[1][i]);
            sums.speed += off * off;
            if (of_speed != nullptr) sums.speed_covered += std::abs(off) <= 3 * (*of_speed)[i] ? 1 : 0;
        }
        if (!stated.empty()) {
            std::nth_element(stated.begin(), stated.begin() + static_cast<std::ptrdiff_t>(stated.size() / 2),
                             stated.end());
            sums.stated = stated[stated.size() / 2];
        }
        return {std::sqrt(sums.position / n), std::sqrt(sums.speed / n), sums.position_covered / n,
                sums.speed_covered / n, sums.stated};
    }
};

struct Case {
    const char* name;
    Drive drive;
};

std::vector<Case> cases() {
    Drive late, exact, coarse, fine_scale, poor, elastic, stiff;
    stiff.compliance = 1 / std::pow(2 * M_PI * 150, 2);
    elastic.compliance = 1 / std::pow(2 * M_PI * 60, 2);  // natural frequency 60 Hz
    late.lead = -1.6;
    exact.backlash = exact.pitch_error = exact.heat = 0;
    coarse.scale_quantum = 5e-3, coarse.lead = 2.4;
    fine_scale.scale_quantum = 5e-4, fine_scale.encoder_quantum = 1e-3, fine_scale.noise = 1e-4;
    poor.backlash = 0.03, poor.pitch_error = 0.01, poor.pitch = 5, poor.lead = 2;
    return {{"usual", Drive{}},         {"late encoder", late}, {"coarse scale, early encoder", coarse},
            {"elastic drive", elastic}, {"stiff drive", stiff}, {"poor drive", poor},
            {"fine scale", fine_scale}, {"exact drive", exact}};
}

void print(const char* what, const Machine::Errors& e) {
    std::printf("  %-8s %8.3f um %8.2f mm/min", what, e.position * um_per_mm, e.speed * seconds_per_minute);
    if (e.stated > 0)
        std::printf("; stated %.3f um; within three deviations %6.2f %% and %6.2f %%", e.stated * um_per_mm,
                    100 * e.position_covered, 100 * e.speed_covered);
    std::printf("\n");
}

/// Delay, backlash and noise are those of the drive.
void expect_measured(const std::array<FusedAxis, 3>& axes, const Case& of) {
    const Drive& drive = of.drive;
    const auto rounded = [](double noise, double quantum) { return std::sqrt(noise * noise + quantum * quantum / 12); };
    for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_NEAR(axes[k].lead, drive.lead, 0.01) << of.name;
        EXPECT_NEAR(axes[k].backlash, drive.backlash, 2e-4 + 0.1 * drive.scale_quantum) << of.name;
        if (drive.compliance == 0)
            EXPECT_NEAR(axes[k].encoder_sigma, rounded(0, drive.encoder_quantum), 0.1 * axes[k].encoder_sigma)
                << of.name;
        else
            EXPECT_GT(axes[k].yield, 1e-4) << of.name;
        EXPECT_NEAR(axes[k].scale_sigma, rounded(drive.noise, drive.scale_quantum), 0.1 * axes[k].scale_sigma)
            << of.name;
    }
}

// The table is printed: rms errors of a coordinate and of the path's speed.
TEST(EncoderAndScale, TogetherAreBetterThanEachAlone) {
    for (const Case& one : cases()) {
        const Machine machine(one.drive);
        const MotionEstimate estimate = machine.estimate_of(machine.log, Role::actual);
        expect_measured(estimate.fused()->axes(), one);
        const Machine::Errors fused = machine.kalman(estimate);
        const Machine::Errors scale = machine.kalman(machine.scale_only(), Role::actual);
        const Machine::Errors encoder = machine.kalman(machine.log, Role::feedback);
        const Machine::Errors window = machine.window();
        std::printf("%s: %s\n", one.name, estimate.note(1).c_str());
        print("fused", fused);
        print("scale", scale);
        print("encoder", encoder);
        print("window", window);
        EXPECT_GE(fused.position_covered, 0.99) << one.name;
        EXPECT_GE(fused.speed_covered, 0.99) << one.name;
        EXPECT_LT(fused.stated, 3 * fused.position) << one.name;
        for (const Machine::Errors& other : {scale, window}) {
            // An encoder that is off by the compliance of its drive hardly counts.
            const double share = one.drive.compliance > 0 ? 1.02 : 1;
            EXPECT_LT(fused.position, share * other.position) << one.name;
            EXPECT_LT(fused.speed, share * other.speed) << one.name;
        }
        // Only with a drive without errors is the encoder better, because it then measures the table.
        const bool exact = one.drive.backlash == 0;
        EXPECT_LT(fused.position, (exact ? 2 : 0.1) * encoder.position) << one.name;
        EXPECT_LT(fused.speed, (exact ? 1.05 : 0.5) * encoder.speed) << one.name;
    }
}

/// Rows of numbers, with commas between them.
std::vector<std::vector<double>> reference_rows() {
    std::ifstream file(TEST_SOURCES "/toolpath/vectors/fused_axis.csv");
    std::vector<std::vector<double>> rows;
    for (std::string line; std::getline(file, line);) {
        std::vector<double>& row = rows.emplace_back();
        std::istringstream numbers(line);
        for (std::string number; std::getline(numbers, number, ',');) row.push_back(std::stod(number));
    }
    return rows;
}

/// The result of SciPy's batch least squares for the same records (fused_axis_reference.py).
struct Reference {
    SmootherModel position, difference;
    double weight = 0;
    std::vector<double> scale, encoder, fused;
    std::vector<std::array<double, 4>> b, p, joint, sigmas;

    Reference() {
        std::vector<std::vector<double>> rows = reference_rows();
        const std::vector<double>& head = rows.at(0);
        const double sum = std::hypot(head[1], head[2]);
        position.period = difference.period = head[0];
        position.position_sigma = head[1] * head[2] / sum;
        position.wandering = head[3];
        difference.position_sigma = sum;
        difference.wandering = head[4];
        weight = std::pow(head[1] / sum, 2);
        rows.erase(rows.begin());
        for (const std::vector<double>& row : rows) {
            const auto four = [&row](std::size_t at) {
                return std::array<double, 4>{row.at(at), row.at(at + 1), row.at(at + 2), row.at(at + 3)};
            };
            scale.push_back(row.at(0));
            encoder.push_back(row.at(1));
            b.push_back(four(2));
            fused.push_back(row.at(6));
            p.push_back(four(7));
            joint.push_back(four(11));
            sigmas.push_back(four(15));
        }
    }
};

TEST(EncoderAndScale, AreFusedAsByBatchLeastSquares) {
    const Reference reference;
    const std::size_t n = reference.scale.size();
    ASSERT_EQ(n, 120U);
    const KalmanSmoother difference(reference.difference), position(reference.position);
    std::vector<double> fused(n);
    std::vector<std::array<double, 4>> b(n);
    fuse(reference.scale, reference.encoder, difference, reference.weight, fused, b);
    std::vector<SmoothedState> p(n);
    position.smooth({{fused, fused, fused}, {}, {}}, p);
    std::array<double, 4> off{};
    for (std::size_t i = 0; i < n; ++i) {
        EXPECT_NEAR(fused[i], reference.fused[i], 1e-9) << i;
        EXPECT_NEAR(b[i][0], reference.b[i][0], 1e-9) << i;
        EXPECT_NEAR(p[i][0][0], reference.p[i][0], 1e-9) << i;
        for (std::size_t d = 0; d < 4; ++d) {
            const double sigma = reference.sigmas[i][d];
            EXPECT_NEAR(b[i][d], reference.b[i][d], 1e-4 * sigma) << i << ' ' << d;
            EXPECT_NEAR(p[i][d][0], reference.p[i][d], 1e-4 * sigma) << i << ' ' << d;
            off[d] += std::pow((p[i][d][0] - reference.joint[i][d]) / sigma, 2) / static_cast<double>(n);
        }
    }
    // Two consecutive smoothers are nearly as accurate as a joint one: their errors are larger by less than a percent.
    for (std::size_t d = 0; d < 4; ++d) EXPECT_LT(std::sqrt(off[d]), 0.12) << d;
}

// The stated errors of both steps, added as independent ones, equal those of the joint solution.
TEST(EncoderAndScale, AreAsUncertainAsInTheJointSolution) {
    const Reference reference;
    const auto n = static_cast<PointIndex>(reference.scale.size());
    const KalmanSmoother difference(reference.difference), position(reference.position);
    for (int d = 0; d < 4; ++d) {
        std::vector<double> of_difference(reference.scale.size()), of_position(reference.scale.size());
        difference.sigmas(d, n, 0, of_difference);
        position.sigmas(d, n, 0, of_position);
        for (std::size_t i = 0; i < of_position.size(); ++i) {
            const double ours = std::hypot(of_position[i], reference.weight * of_difference[i]);
            EXPECT_GT(ours, 0.999 * reference.sigmas[i][static_cast<std::size_t>(d)]) << i << ' ' << d;
            EXPECT_LT(ours, 1.15 * reference.sigmas[i][static_cast<std::size_t>(d)]) << i << ' ' << d;
        }
    }
}

TEST(EncoderAndScale, AMotorTurnsWhereItComesBackByMoreThanTheThreshold) {
    const std::vector<double> x{0, 1, 2, 3, 2.9, 3, 2, 1, std::nan(""), 1, 1, 1.2, 2, 3};
    const std::vector<Reversal> reversals = find_reversals(x, {0, 13}, 0.5);
    ASSERT_EQ(reversals.size(), 2U);
    EXPECT_EQ(reversals[0].at, 5);  // the last of those near 3
    EXPECT_EQ(reversals[0].direction, 1);
    EXPECT_EQ(reversals[1].at, 11);  // 1.2 is within half the threshold of 1
    EXPECT_EQ(reversals[1].direction, -1);
    EXPECT_TRUE(find_reversals(x, {0, 5}, 0.5).empty());
}

/// A log of X alone, back and forth.
struct Shuttle {
    static constexpr PointIndex count = 8000;
    std::vector<double> scale, encoder, table;

    /// 2 s per stroke at `speed` [mm/s], with reversals of 40 ms; pitch error and backlash of 10 µm.
    explicit Shuttle(double speed) {
        double m = 0, follows = 0;
        for (int i = 0; i < count; ++i) {
            const double t = std::fmod(i * period, 4.0);
            const double v =
                t < 0.02 || t > 3.98 ? std::remainder(t, 4.0) / 0.02 : std::clamp((2 - t) / 0.02, -1.0, 1.0);
            m += speed * period * v;
            follows = std::clamp(follows, m - 0.005, m + 0.005);
            table.push_back(follows + 0.002 * std::sin(2 * M_PI * m / 10) + 0.0003);
            scale.push_back(std::round(table.back() / 1e-3) * 1e-3);
            encoder.push_back(std::round(m / 1e-4) * 1e-4);
        }
    }
    [[nodiscard]] FusedAxis fuse() const {
        NoiseFitter fitter;
        const std::vector<PointRange> all{{0, count - 1}};
        return fuse_axis({view_of(scale), view_of(encoder), count, period, all, sample_sections(all)}, fitter);
    }
    /// Share of the fused positions within three standard deviations of the table.
    [[nodiscard]] double covered(const FusedAxis& axis) const {
        double within = 0;
        for (std::size_t i = 0; i < table.size(); ++i) {
            const double alone = std::isinf(axis.sigmas[0][i]) ? axis.scale_sigma : 0;
            const double sigma = std::hypot(axis.sigma(), alone > 0 ? alone : static_cast<double>(axis.sigmas[0][i]));
            within += std::abs(axis.positions[i] - table[i]) <= 3 * sigma ? 1 : 0;
        }
        return within / static_cast<double>(table.size());
    }
};

// Without noise, at 50 µm per record or slower, the rounding error to 1 µm stays the same for long and is not reduced by
// averaging.
TEST(EncoderAndScale, ARoundingThatStaysIsNotAveragedAway) {
    for (const double speed : {50.0, 49.7, 5.0, 0.5, 0.1}) {
        const Shuttle shuttle(speed);
        const FusedAxis axis = shuttle.fuse();
        EXPECT_GE(shuttle.covered(axis), 0.99) << speed;
    }
}

TEST(EncoderAndScale, WhereTheEncoderIsMissingTheScaleIsUsedAlone) {
    Machine machine{Drive{}};
    std::fill_n(machine.encoder[0].begin() + 5000, 200, std::nan(""));
    const Trajectory path = reconstruct(machine.log, Role::actual, Vec3::Zero());
    const MotionEstimate estimate(machine.log, path, machine.pieces);
    MotionEstimate::Scratch scratch;
    std::array<std::array<std::vector<double>, 3>, 4> out;
    estimate.estimate(machine.pieces[0], 4800, 5399, scratch, out);
    std::array<std::vector<double>, 3> sigmas;
    for (std::vector<double>& axis : sigmas) axis.resize(600);
    estimate.position_sigmas(machine.pieces[0], 4800, scratch, sigmas);
    EXPECT_GT(sigmas[0][300], 2 * sigmas[0][50]);
    for (std::size_t i = 0; i < 600; ++i)
        EXPECT_NEAR(out[0][0][i], machine.position[0][4800 + i], 4 * sigmas[0][i]) << i;
}

TEST(EncoderAndScale, OnlyActualPositionsAreFused) {
    const Machine machine{Drive{}};
    const Log scale_only = machine.scale_only();
    EXPECT_TRUE(FusedPositions::applies(machine.log, reconstruct(machine.log, Role::actual, Vec3::Zero())));
    EXPECT_FALSE(FusedPositions::applies(machine.log, reconstruct(machine.log, Role::feedback, Vec3::Zero())));
    EXPECT_FALSE(FusedPositions::applies(scale_only, reconstruct(scale_only, Role::actual, Vec3::Zero())));
}

// The test on held-out records: noise, or the random walk of the difference, that is stated too small.
TEST(EncoderAndScale, WrongNoiseIsMoreThanTwiceWhatIsStated) {
    const Reference reference;  // its random walk of b is large enough for its difference
    std::mt19937 random(2);
    std::normal_distribution<double> normal;
    const double sigma = reference.difference.position_sigma;
    std::vector<double> differences, ones(4000, 1.0);
    for (int i = 0; i < 4000; ++i) differences.push_back(0.002 * std::sin(0.0314 * i) + sigma * normal(random));
    const auto nees = [&](double noise_share, double wandering_share) {
        SmootherModel model = reference.difference;
        model.position_sigma *= noise_share;
        model.wandering *= wandering_share;
        std::vector<double> ratios;
        hold_out(differences, KalmanSmoother(model), ones, ratios);
        return std::accumulate(ratios.begin(), ratios.end(), 0.0) / static_cast<double>(ratios.size());
    };
    EXPECT_GT(nees(1, 1), 0.5);
    EXPECT_LT(nees(1, 1), 1.2);
    EXPECT_GT(nees(0.5, 1), 2);
    EXPECT_GT(nees(1, 1e-9), 2);
}

// A speed that reads zero in one record of 500 is not an error that a standard deviation can describe.
TEST(EncoderAndScale, AreRefusedWhereTheirErrorsCannotBeStated) {
    Machine machine{Drive{}};
    std::vector<double> speed;
    for (std::size_t i = 0; i < Machine::count; ++i)
        speed.push_back(std::round(60 * std::hypot(machine.velocity[0][i], machine.velocity[1][i])));
    machine.log.channels.push_back({"speed", "mm/min", view_of(speed)});
    const Trajectory path = reconstruct(machine.log, Role::actual, Vec3::Zero());
    EXPECT_NO_THROW((void)MotionEstimate(machine.log, path, machine.pieces));
    for (std::size_t i = 250; i < speed.size(); i += 500) speed[i] = 0;
    try {
        const MotionEstimate estimate(machine.log, path, machine.pieces);
        FAIL() << estimate.nees();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("mean square"), std::string::npos) << error.what();
    }
}

TEST(EncoderAndScale, AnEncoderOfAnotherAxisIsNotUsed) {
    Machine machine{Drive{}};
    std::swap(machine.encoder[0], machine.encoder[1]);
    for (std::size_t k = 0; k < 2; ++k) machine.log.channels[3 + k].values = view_of(machine.encoder[k]);
    const MotionEstimate estimate = machine.estimate_of(machine.log, Role::actual);
    for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(estimate.fused()->axes()[k].weight, 0) << k;
}

// A motor's encoder that fails once in 600 records is noisier than the scale, and hardly counts.
TEST(EncoderAndScale, AFaultyEncoderHardlyCounts) {
    Machine machine{Drive{}};
    const Machine::Errors scale = machine.kalman(machine.scale_only(), Role::actual);
    for (std::size_t i = 300; i < Machine::count; i += 600) {
        for (std::size_t k = 0; k < 2; ++k) machine.encoder[k][i] += 0.3;
    }
    const Machine::Errors fused = machine.kalman(machine.log, Role::actual);
    EXPECT_LT(fused.position, 1.05 * scale.position);
    EXPECT_GE(fused.position_covered, 0.99);
}

}  // namespace
}  // namespace clsurf::encoder_and_scale_test
