// Generated logs with one fault each, and its expected place and number; nothing else may be found.
#include "log/health.h"

#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <random>

#include <gtest/gtest.h>

namespace clsurf::health_test {
namespace {

constexpr double period = 0.002;  // [s]
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A good log: a zigzag of 40 passes of 40 mm, 0.3 mm apart, over a dome, accelerated by 1000 mm/s²
/// up to 50 mm/s. One line per pass and one per step-over. Feedback lags by 3 ms.
struct Made {
    std::map<std::string, std::vector<double>> columns;
    double stated_period = period;

    Made() {
        rest(200, 0);
        for (int pass = 0; pass < 40; ++pass) {
            move(pass % 2 == 0 ? 40 : -40, 0, 2 * pass + 1);
            move(0, 0.3, 2 * pass + 2);
        }
        rest(200, 0);
        for (const char axis : {'x', 'y', 'z'}) {
            std::vector<double> lagging = at(std::string("cmd.") + axis);
            for (std::size_t i = 1; i < lagging.size(); ++i)
                lagging[i] = lagging[i - 1] + (lagging[i] - lagging[i - 1]) * (1 - std::exp(-period / 0.003));
            columns[std::string("fb.") + axis] = std::move(lagging);
        }
    }

    std::vector<double>& at(const std::string& name) { return columns.at(name); }
    std::vector<double>& operator[](const char* name) { return columns.at(name); }
    [[nodiscard]] std::size_t size() const { return columns.at("cmd.x").size(); }

    Diagnostics check(LineNumber program_lines = 80) const {
        Log log;
        log.name = "run";
        log.period = stated_period;
        log.records = static_cast<PointIndex>(size());
        for (const auto& [name, values] : columns) {
            const char* unit = name == "time" ? "s" : name == "line" ? "" : "mm";
            log.channels.push_back({name, unit, view_of(values)});
        }
        return check_health(log, program_lines);
    }

private:
    void record(double line) {
        columns["time"].push_back(period * static_cast<double>(columns["time"].size()));
        columns["cmd.x"].push_back(x_);
        columns["cmd.y"].push_back(y_);
        columns["cmd.z"].push_back(10 - 0.01 * (x_ * x_ + y_ * y_));
        columns["line"].push_back(line);
    }
    void rest(int records, double line) {
        for (int i = 0; i < records; ++i) record(line);
    }
    void move(double dx, double dy, double line) {
        const double length = std::hypot(dx, dy);
        const double x = x_;
        const double y = y_;
        double speed = 0;
        for (double arc_length = 0; arc_length < length;) {
            speed = std::min({50.0, speed + 1000 * period, std::sqrt(2 * 1000 * (length - arc_length)) + 1});
            arc_length = std::min(length, arc_length + speed * period);
            x_ = x + dx * arc_length / length;
            y_ = y + dy * arc_length / length;
            record(line);
        }
    }
    double x_ = 0, y_ = 0;
};

/// The only finding, with that code; an empty one if there is not exactly one.
Diagnostic only(const Diagnostics& found, const std::string& code, std::uint64_t times = 1) {
    EXPECT_EQ(found.count(code), times);
    for (const Diagnostic& d : found.kept()) EXPECT_EQ(d.code, code) << to_text(d);
    return found.kept().empty() ? Diagnostic{} : found.kept().front();
}

void expect_says(const Diagnostic& d, const char* words) { EXPECT_NE(d.text.find(words), std::string::npos) << d.text; }

TEST(Health, HasNothingToSayOfAGoodLog) {
    const Made made;
    ASSERT_GT(made.size(), 16'500u);  // more than one block
    const Diagnostics found = made.check();
    for (const Diagnostic& d : found.kept()) ADD_FAILURE() << to_text(d);
}

TEST(Health, CountsTheRecordsMissingInAGap) {
    Made made;
    for (std::size_t i = 1000; i < made.size(); ++i) made["time"][i] += 5 * period;
    const Diagnostic d = only(made.check(), "log.time-gap");
    EXPECT_EQ(d.where.number, 1000u);
    expect_says(d, "5 records are missing: a step of 0.012000 s");
}

TEST(Health, KnowsAPlaceholderByItsReturn) {
    Made made;
    for (const std::size_t at : {1000, 1500, 2200, 3100}) {
        for (std::size_t i = at; i < at + 3; ++i) {
            made["cmd.x"][i] = 198;
            made["cmd.y"][i] = 158;
            made["cmd.z"][i] = 119;
        }
    }
    const Diagnostics found = made.check();
    EXPECT_EQ(found.count("log.placeholder"), 1U);
    for (const Diagnostic& d : found.kept()) {
        if (d.code != "log.placeholder") continue;
        EXPECT_EQ(d.where.number, 1000U);
        expect_says(d, "jumps to X198 Y158 Z119 and back 4 times");
    }
}

TEST(Health, DoesNotTakeOneSpikeForAPlaceholder) {
    Made made;
    made["cmd.x"][1000] += 50;
    made["cmd.y"][1000] += 50;
    EXPECT_EQ(made.check().count("log.placeholder"), 0U);
}

TEST(Health, SaysThatARecordEveryTenthOfASecondShowsNoMarks) {
    Made made;
    made.stated_period = 0.1;
    for (std::size_t i = 0; i < made.size(); ++i) made["time"][i] = 0.1 * static_cast<double>(i);
    const Diagnostic d = only(made.check(), "log.coarse");
    expect_says(d, "a record every 100 ms");
}

TEST(Health, DoesNotCallTheArcLengthOfAGapAJump) {
    Made made;
    for (auto& [name, values] : made.columns) values.erase(values.begin() + 1000, values.begin() + 1040);
    expect_says(only(made.check(), "log.time-gap"), "40 records are missing");
    made.columns.erase("time");  // without a clock it is a jump
    EXPECT_EQ(made.check().count("log.jump"), 2u);
}

TEST(Health, SeesTimeGoBackAndStandStill) {
    Made made;
    made["time"][700] = made["time"][699];
    made["time"][9000] = 1;
    const Diagnostics found = made.check();
    EXPECT_EQ(found.count("log.time-back"), 2u);
    EXPECT_EQ(found.kept()[0].where.number, 700u);
    expect_says(found.kept()[0], "stands still");
    EXPECT_EQ(found.kept()[2].where.number, 9000u);
    expect_says(found.kept()[2], "goes back: 1.000000 s after 17.998000 s");
    EXPECT_EQ(found.count("log.time-gap"), 2u);  // each time up to the clock as it was
}

TEST(Health, MeasuresTheJitter) {
    Made made;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> off(-0.0003, 0.0003);  // steps: rms 0.0003 · √(2/3) = 0.245 ms
    for (double& t : made["time"]) t += off(random);
    expect_says(only(made.check(), "log.jitter"), "jitters by 0.24");
}

TEST(Health, ComparesTheClockWithTheStatedPeriod) {
    Made made;
    made.stated_period = 0.001;
    expect_says(only(made.check(), "log.period"), "wrong by a factor of 2");
}

TEST(Health, FindsAJumpThatStays) {
    Made made;
    for (std::size_t i = 5000; i < made.size(); ++i) made["cmd.y"][i] += 3;
    for (std::size_t i = 5000; i < made.size(); ++i) made["fb.y"][i] += 3;
    const Diagnostics found = made.check();
    const Diagnostic d = only(found, "log.jump", 2);  // of both roles
    EXPECT_EQ(d.where.number, 5000u);
    expect_says(d, "the position cmd jumps by 3.00");
}

TEST(Health, DoesNotTakeOtherBytesForPositions) {
    Made made;
    std::mt19937_64 random(1);
    for (const char* channel : {"cmd.x", "cmd.y", "cmd.z"}) {
        for (double& value : made[channel]) value = std::bit_cast<double>(random());
    }
    const Diagnostics found = made.check();
    EXPECT_GE(found.count("log.jump"), made.size() / 20);
    EXPECT_EQ(found.count("log.far"), 3u);
}

TEST(Health, CountsASpikeOnce) {
    Made made;
    made["fb.z"][16384] += 2;  // the first record of a block
    const Diagnostic d = only(made.check(), "log.jump");
    EXPECT_EQ(d.where.number, 16384u);
    expect_says(d, "the position fb jumps by 2.0");
    expect_says(d, "the next one comes back");
}

TEST(Health, DoesNotTakeAFastStartForAJump) {
    // Idealised logs have no acceleration: 40 m/min in one step, with corners.
    Made made;
    made.columns.clear();
    for (int i = 0; i < 3000; ++i) {
        const int k = i / 500;
        made.columns["cmd.x"].push_back((k % 2 == 0 ? i % 500 : 500 - i % 500) * 1.33);
        made.columns["cmd.y"].push_back(0);
        made.columns["cmd.z"].push_back(0.001 * i);
    }
    EXPECT_EQ(made.check().count("log.jump"), 0u);
}

TEST(Health, CountsMissingValuesFromTheFirstOn) {
    Made made;
    made["fb.z"][77] = nan;
    made["fb.z"][12'345] = nan;
    const Diagnostic d = only(made.check(), "log.missing-value");
    EXPECT_EQ(d.where.number, 77u);
    expect_says(d, "'fb.z' has no value at 2 of");
}

TEST(Health, NamesWhatTheLogDoesNotHave) {
    Made made;
    made.columns.erase("line");
    expect_says(only(made.check(), "log.missing-channel"), "no channel 'line'");
    made = Made();
    for (const char* axis : {"fb.x", "fb.y", "fb.z"}) made.columns.erase(axis);
    expect_says(only(made.check(), "log.missing-channel"), "no feedback positions");
    made.columns.erase("cmd.y");
    EXPECT_FALSE(made.check().has_errors()) << "a lathe";
    made.columns.erase("cmd.z");
    EXPECT_TRUE(made.check().has_errors());
}

TEST(Health, FindsLinesThatTheProgramDoesNotHave) {
    Made made;
    made["line"][3000] = 81;
    made["line"][3001] = -1;
    const Diagnostics found = made.check();
    const Diagnostic d = only(found, "log.line-range");
    EXPECT_EQ(d.where.number, 3000u);
    expect_says(d,
                "2 points have a line number that the program of 80 lines does not have: -1 … 81; the first is here");
}

TEST(Health, FindsALineThatFlickersForOneRecord) {
    Made made;
    made["line"][3000] = 55;
    const Diagnostic d = only(made.check(), "log.line-wild");
    EXPECT_EQ(d.where.number, 3000u);
    expect_says(d, "line 55 for one record, between records of line");
}

TEST(Health, FindsALineThatStays) {
    Made made;
    std::size_t from = 0;
    while (made["line"][from] != 21) ++from;
    for (std::size_t i = from; i < made.size(); ++i) made["line"][i] = 21;
    const Diagnostic d = only(made.check(), "log.line-stuck");
    EXPECT_EQ(d.where.number, from);
    expect_says(d, "the line number stays 21 for 1326.9 mm, while the tool turns left by 2700°");  // 15 of 30 turns
}

TEST(Health, FindsALineThatIsAlwaysZero) {
    Made made;
    for (double& line : made["line"]) line = 0;
    expect_says(only(made.check(), "log.line-stuck"), "0 all the time");
}

TEST(Health, LetsOneMotionTurnToOneSideAsLongAsItLikes) {
    // A helix of 40 turns is one line, and so is a straight motion of 2 m.
    Made made;
    made.columns.clear();
    for (int i = 0; i < 40'000; ++i) {
        made.columns["cmd.x"].push_back(3 * std::cos(i * 0.00628));
        made.columns["cmd.y"].push_back(3 * std::sin(i * 0.00628));
        made.columns["cmd.z"].push_back(0.0001 * i);
        made.columns["line"].push_back(7);
    }
    EXPECT_EQ(made.check().count("log.line-stuck"), 0u);
    for (int i = 0; i < 40'000; ++i) {
        made["cmd.x"][static_cast<std::size_t>(i)] = 0.05 * i + (i % 2) * 1e-4;
        made["cmd.y"][static_cast<std::size_t>(i)] = (i % 7) * 1e-4;
    }
    EXPECT_EQ(made.check().count("log.line-stuck"), 0u);
}

TEST(Health, FindsAConstantOffsetWhileTheMachineRests) {
    Made made;
    for (double& y : made["fb.y"]) y += 0.0125;
    expect_says(only(made.check(), "log.offset"), "fb.y differs from cmd.y by 0.0125 mm while the axis rests");
}

TEST(Health, FindsAConstantOffsetInALogThatNeverRests) {
    Made made;
    for (auto& [name, values] : made.columns) values = std::vector<double>(values.begin() + 250, values.end() - 250);
    const double first = made["time"].front();
    for (double& t : made["time"]) t -= first;
    EXPECT_TRUE(made.check().empty());
    for (double& x : made["fb.x"]) x -= 0.02;
    for (std::size_t i = 0; i < made.size(); ++i)
        made["fb.x"][i] += 1e-3 * std::sin(0.9 * static_cast<double>(i));  // rests nowhere
    const Diagnostic d = only(made.check(), "log.offset");
    expect_says(d, "fb.x differs from cmd.x by -0.02");
    expect_says(d, "whichever way the axis moves");
}

TEST(Health, NamesTheStepOfEachAxis) {
    Made made;
    for (double& x : made["fb.x"]) x = std::round(x / 0.001) * 0.001;
    for (double& y : made["fb.z"]) y = std::round(y / 0.00025) * 0.00025;
    const Diagnostic d = only(made.check(), "log.quantum");
    EXPECT_EQ(d.severity, Severity::note);
    expect_says(d, "feedback positions come in steps: fb.x 0.001 mm, fb.z 0.00025 mm");
}

TEST(Health, TellsADeadChannelFromAnAxisAtRest) {
    Made made;
    for (double& y : made["fb.y"]) y = 0;
    const Diagnostics dead = made.check();
    EXPECT_EQ(dead.count("log.still"), 1u);
    EXPECT_EQ(dead.kept().front().severity, Severity::warning);
    expect_says(dead.kept().front(), "fb.y stays at 0 mm while cmd.y moves over 12.000 mm");
    made = Made();
    for (const char* axis : {"cmd.y", "fb.y"}) std::fill(made[axis].begin(), made[axis].end(), 0.0);
    EXPECT_EQ(only(made.check(), "log.still", 2).severity, Severity::note);
}

}  // namespace
}  // namespace clsurf::health_test
