// Logs whose line numbers are some records ahead of or behind the motion, for a program that was edited after the run: a
// lead of records is not an edit. Lines of 0.4 mm at 40 mm/s take 10 ms, so that a lead of that time looks like one line,
// except where the tool slows down. Positions and lines are those of trapezoids computed here.
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "mapping/line_map.h"
#include "mapping/map_lines.h"
#include "program/motion_rows.h"

namespace clsurf::line_lead_test {
namespace {

constexpr int passes = 14, lines_of_pass = 75;
constexpr double spacing = 0.4, step_over = 0.3;  // mm
constexpr double feed = 40, acceleration = 2000;  // mm/s, mm/s²

using Text = std::vector<std::string>;

Text zigzag_text() {
    Text text{"G21 G90 G64", "(made for a test)", "G0 X0 Y0 Z0", "F2400"};
    for (int k = 0; k < passes; ++k) {
        text.push_back(fmt::format("G1 Y{:.1f}", k * step_over + step_over));
        for (int i = 1; i <= lines_of_pass; ++i)
            text.push_back(fmt::format("G1 X{:.1f}", (k % 2 == 0 ? i : lines_of_pass - i) * spacing));
    }
    text.emplace_back("M2");
    return text;
}

/// A straight line from rest to rest.
struct Stretch {
    Vec3 from, along;
    double length = 0;
    double line_length = 0;
    LineNumber first_line = 0;

    [[nodiscard]] double peak() const { return std::min(feed, std::sqrt(acceleration * length)); }
    [[nodiscard]] double time() const { return peak() / acceleration + length / peak(); }
    /// Arc length after a time, for a trapezoidal profile.
    [[nodiscard]] double at(double t) const {
        const double ramp = peak() / acceleration;
        if (t <= ramp) return acceleration * t * t / 2;
        const double left = std::max(0.0, time() - t);
        if (left <= ramp) return length - acceleration * left * left / 2;
        return peak() * (t - ramp / 2);
    }
};

std::vector<Stretch> stretches() {
    std::vector<Stretch> all;
    LineNumber line = 5;
    for (int k = 0; k < passes; ++k) {
        const double x = k % 2 == 0 ? 0 : lines_of_pass * spacing;
        all.push_back({Vec3(x, k * step_over, 0), Vec3::UnitY(), step_over, step_over, line++});
        all.push_back({Vec3(x, (k + 1) * step_over, 0), (k % 2 == 0 ? 1.0 : -1.0) * Vec3::UnitX(),
                       lines_of_pass * spacing, spacing, line});
        line += lines_of_pass;
    }
    return all;
}

struct MadeRun {
    std::vector<double> x, y, z;
    std::vector<LineNumber> line;
    Log log;
};

template <typename T>
ChannelView view_of(const std::vector<T>& values, ScalarType type) {
    return {reinterpret_cast<const std::byte*>(values.data()),
            sizeof(T),
            static_cast<PointIndex>(values.size()),
            type,
            false,
            1.0,
            0.0};
}

/// A record has the line of the record `lead` later.
std::shared_ptr<const MadeRun> run_of(double period, std::ptrdiff_t lead) {
    const auto run = std::make_shared<MadeRun>();
    double t = 0;
    std::vector<LineNumber> lines;
    for (const Stretch& s : stretches()) {
        for (; t < s.time(); t += period) {
            const double gone = s.at(t);
            const Vec3 p = s.from + gone * s.along;
            run->x.push_back(p.x());
            run->y.push_back(p.y());
            run->z.push_back(p.z());
            lines.push_back(s.first_line + static_cast<LineNumber>(gone / s.line_length));
        }
        t -= s.time();
    }
    const auto last = static_cast<std::ptrdiff_t>(lines.size()) - 1;
    for (std::ptrdiff_t i = 0; i <= last; ++i)
        run->line.push_back(lines[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i + lead, 0, last))]);
    run->log.name = "run.csv";
    run->log.records = last + 1;
    run->log.period = period;
    run->log.channels = {{"cmd.x", "mm", view_of(run->x, ScalarType::f64)},
                         {"cmd.y", "mm", view_of(run->y, ScalarType::f64)},
                         {"cmd.z", "mm", view_of(run->z, ScalarType::f64)},
                         {"line", "", view_of(run->line, ScalarType::u32)}};
    return run;
}

struct Edit {
    const char* name;
    const char* finding;  ///< beginning of the message
    LineNumber at;        ///< line of the old text from which lines are shifted
    int by;               ///< number of lines by which they are later
    std::function<void(Text&)> make;
};

constexpr LineNumber middle = 570;  ///< inside a pass

std::vector<Edit> edits() {
    const auto at = [](Text& text, LineNumber line) { return text.begin() + line - 1; };
    return {
        {"front", "1 line inserted before line ", 2, 1, [=](Text& t) { t.insert(at(t, 2), "(first)"); }},
        {"middle", "1 line inserted before line 570 since", middle, 1,
         [=](Text& t) { t.insert(at(t, middle), "(here)"); }},
        {"end", "the edit moved no line", 1'000'000, 0, [](Text& t) { t.emplace_back("(the end)"); }},
        {"spindle", "the edit moved no line", 1'000'000, 0, [](Text& t) { t[1] = "S11000"; }},
        {"a value", "the edit moved no line", 1'000'000, 0, [=](Text& t) { *at(t, middle) += " Z0.05"; }},
        {"deleted", "1 line deleted before line 571 since", middle + 1, -1, [=](Text& t) { t.erase(at(t, middle)); }},
    };
}

class LeadOfLines : public testing::TestWithParam<std::tuple<double, std::ptrdiff_t>> {};

TEST_P(LeadOfLines, IsNoEdit) {
    const auto& [period, lead] = GetParam();
    const std::shared_ptr<const MadeRun> run = run_of(period, lead);
    const Trajectory path = reconstruct(run->log, Role::commanded, Vec3::Zero());
    for (const Edit& edit : edits()) {
        Text text = zigzag_text();
        edit.make(text);
        const Program program = parse(fmt::format("{}\n", fmt::join(text, "\n")), "linuxcnc");
        Diagnostics diagnostics;
        const LineMap map = map_lines(path, run->log, program, true, diagnostics, ProgramIdentity::edited);
        std::string found;
        for (const Diagnostic& d : diagnostics.kept()) found += d.code == "map.edited" ? d.text : "";
        EXPECT_EQ(found.substr(0, std::string(edit.finding).size()), edit.finding) << edit.name << ": " << found;
        PointIndex wrong = 0;
        for (PointIndex i = 0; i < path.count; ++i) {
            const LineNumber ran = run->line[static_cast<std::size_t>(i)];
            if (edit.by < 0 && ran == edit.at - 1) continue;  // it was deleted
            wrong += map.line_at(i) != ran + static_cast<LineNumber>(ran >= edit.at ? edit.by : 0) ? 1 : 0;
        }
        EXPECT_EQ(wrong, 0) << edit.name << ": " << found;
    }
}

INSTANTIATE_TEST_SUITE_P(Periods, LeadOfLines,
                         testing::Combine(testing::Values(0.001, 0.002, 0.004), testing::Values(-1, 0, 1, 3)));

}  // namespace
}  // namespace clsurf::line_lead_test
