// Lines that run repeatedly, canned cycles and subprograms in other files: the motion of each point.
#include "mapping/motion_track.h"

#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "log/log.h"
#include "mapping/call_chain.h"
#include "mapping/line_map.h"
#include "mapping/map_lines.h"
#include "program/interpreter.h"
#include "toolpath/toolpath.h"

namespace clsurf::motion_track_test {
namespace {

constexpr double step = 0.4;  ///< [mm] distance from point to point

/// A log along motions of a program, with the true motion of each point.
struct Drive {
    std::vector<double> axis[3];
    std::vector<LineNumber> line;
    std::vector<std::int64_t> motion;

    /// Along motions [first, last]; each reports its own line, or that of `merged(motion)` after it.
    template <typename ReportedAs>
    void go(const Program& program, std::int64_t first, std::int64_t last, const ReportedAs& reported_as) {
        const Toolpath path(program.motions, Vec3::Zero());
        for (std::int64_t m = first; m <= last; ++m) {
            const int n = std::max(2, static_cast<int>(std::ceil(path.length(m) / step)));
            for (int i = 1; i <= n; ++i) {
                const Vec3 p = path.at(m, static_cast<double>(i) / n);
                for (int k = 0; k < 3; ++k) axis[k].push_back(p[k]);
                line.push_back(program.motions.line[static_cast<std::size_t>(reported_as(m))]);
                motion.push_back(m);
            }
        }
    }
    void go(const Program& program, std::int64_t first, std::int64_t last) {
        go(program, first, last, [](std::int64_t m) { return m; });
    }
    [[nodiscard]] Log log() const {
        Log log;
        log.name = "run";
        log.period = 0.001;
        log.records = static_cast<PointIndex>(line.size());
        const auto add = [&](const char* name, const void* data, ScalarType type, std::size_t stride) {
            log.channels.push_back(
                {name, "", {static_cast<const std::byte*>(data), stride, log.records, type, false, 1.0, 0.0}});
        };
        add("cmd.x", axis[0].data(), ScalarType::f64, 8);
        add("cmd.y", axis[1].data(), ScalarType::f64, 8);
        add("cmd.z", axis[2].data(), ScalarType::f64, 8);
        add("line", line.data(), ScalarType::u32, 4);
        return log;
    }
};

Program parse(const std::string& text, const std::string& sub = {}) {
    InterpreterOptions options;
    options.dialect = find_dialect("linuxcnc");
    const auto kept = [](const std::string& bytes) { return std::make_shared<const std::string>(bytes); };
    if (!sub.empty()) {
        options.load = [called = kept(sub)](const std::string&) {
            return std::optional(SourceText("rib.ngc", *called, called));
        };
    }
    const auto main = kept(text);
    return parse_program(SourceText("part.ngc", *main, main), options);
}

struct Mapped {
    Log log;
    Diagnostics diagnostics;
    LineMap lines;

    Mapped(const Drive& run, const Program& program, bool use_channel = true)
        : log(run.log()),
          lines(map_lines(reconstruct(log, Role::commanded, Vec3::Zero()), log, program, use_channel, diagnostics)) {}
};

std::string loop_of(int passes) {
    return fmt::format(
        "G21 G90\n#1=0\no1 repeat [{}]\nG1 X0 Y[#1*0.3] Z0 F3000\nX4 Z0.2\nX8 Z0.5\nX12 Z0.2\nX16 Z0\nX12 Z0.3\nX2 "
        "Z0.1\n#1=[#1+1]\no1 endrepeat\nG0 Z10\nM2\n",
        passes);
}

/// The share of points on a wrong motion.
double wrong_share(const Drive& run, const LineMap& lines) {
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < run.motion.size(); ++i) {
        const std::int64_t found = lines.motion_at(static_cast<PointIndex>(i));
        wrong += found != run.motion[i] ? 1 : 0;
    }
    return static_cast<double>(wrong) / static_cast<double>(run.motion.size());
}

TEST(MotionTrack, ALoopsLinesAreThoseOfTheRightRound) {
    const Program program = parse(loop_of(300));
    Drive run;
    run.go(program, 0, program.motions.size() - 1);
    const Mapped mapped(run, program);
    EXPECT_EQ(wrong_share(run, mapped.lines), 0.0);
    EXPECT_TRUE(mapped.diagnostics.empty());
}

TEST(MotionTrack, ALogThatBeginsInsideALoopFindsItsRound) {
    const Program program = parse(loop_of(50));
    Drive run;
    run.go(program, 7 * 31, program.motions.size() - 1);
    EXPECT_EQ(wrong_share(run, Mapped(run, program).lines), 0.0);
}

TEST(MotionTrack, ALogWithoutSomeRoundsOfALoopFindsTheNext) {
    const Program program = parse(loop_of(50));
    Drive run;
    run.go(program, 0, 7 * 12 - 1);
    run.go(program, 7 * 20, program.motions.size() - 1);
    EXPECT_LT(wrong_share(run, Mapped(run, program).lines), 0.003);
}

TEST(MotionTrack, ALineThatIsReportedForSeveralRoundsIsFollowedFromRoundToRound) {
    // A kernel that merges: each motion reports the last line of its loop pass.
    const Program program = parse(loop_of(40));
    Drive run;
    run.go(program, 0, 6);
    run.go(program, 7, program.motions.size() - 2, [](std::int64_t m) { return m / 7 * 7 + 6; });
    const Mapped mapped(run, program);
    for (std::size_t i = 0; i < run.motion.size(); ++i) {
        const std::int64_t found = mapped.lines.motion_at(static_cast<PointIndex>(i));
        ASSERT_NEAR(static_cast<double>(found), static_cast<double>(run.motion[i]), 7) << i;
    }
    EXPECT_EQ(mapped.diagnostics.count("map.disagreement"), 0u);
}

TEST(MotionTrack, RapidsOfACannedCycleAreRapids) {
    const Program program = parse("G21 G90 G17\nG0 X0 Y0 Z10\nG1 X5 F600\nG81 X20 Y0 Z-4 R2 F300\nX30\nG80\nM2\n");
    Drive run;
    run.go(program, 0, program.motions.size() - 1);
    for (const bool use_channel : {true, false}) {
        const Mapped mapped(run, program, use_channel);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < run.motion.size(); ++i) {
            PointKind kind = PointKind::idle;
            mapped.lines.read_kinds(static_cast<PointIndex>(i), {&kind, 1});
            const bool rapid = program.motions.kind[static_cast<std::size_t>(run.motion[i])] == MotionKind::rapid;
            wrong += (kind == PointKind::rapid) != rapid ? 1 : 0;
        }
        // A point at the end of a motion is also at the start of the next one.
        EXPECT_LE(wrong, static_cast<std::size_t>(program.motions.size())) << use_channel;
    }
}

TEST(MotionTrack, ALineOfAnotherFileIsToldFromThatOfTheMainProgram) {
    // Lines 2 and 3 are in both files.
    const Program program = parse("G21 G90\nG1 X0 Y5 Z0 F3000\nX9 Y5\no<rib> call [1]\nX9 Y8\no<rib> call [2]\nM2\n",
                                  "o<rib> sub\nG1 X0 Y[#1] F3000\nX9 Y[#1]\nX9 Y[#1+0.5]\no<rib> endsub\nM2\n");
    ASSERT_EQ(program.files.size(), 2u);
    Drive run;
    run.go(program, 0, program.motions.size() - 1);
    const Mapped mapped(run, program);
    EXPECT_EQ(wrong_share(run, mapped.lines), 0.0);
    const CallChains chains(mapped.log, program, mapped.lines);
    for (std::size_t i = 0; i < run.motion.size(); ++i) {
        const auto point = static_cast<PointIndex>(i);
        const auto m = static_cast<std::size_t>(run.motion[i]);
        const CallChain chain = chains.of(point);
        ASSERT_EQ(chain.subprogram.has_value(), program.motions.file[m] != 0);
        if (!chain.subprogram) {
            EXPECT_EQ(mapped.lines.line_at(point), program.motions.line[m]);
            continue;
        }
        EXPECT_EQ(chain.subprogram->file, "rib.ngc");
        EXPECT_EQ(chain.subprogram->line, program.motions.line[m]);
        ASSERT_EQ(chain.calls.size(), 1u);
        EXPECT_EQ(chain.calls.front().line, mapped.lines.line_at(point));
    }
    // The calling line has the points of its call.
    const std::vector<PointRange> first_call = mapped.lines.points_of(4);
    ASSERT_EQ(first_call.size(), 1u);
    EXPECT_EQ(run.motion[static_cast<std::size_t>(first_call.front().first)], 2);
    EXPECT_EQ(run.motion[static_cast<std::size_t>(first_call.front().last)], 4);
}

}  // namespace
}  // namespace clsurf::motion_track_test
