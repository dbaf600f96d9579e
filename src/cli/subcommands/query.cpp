// clsurf query: the line, the point and the values at a place, number or time.

#include <cstdio>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/options/part.h"
#include "cli/tables/query_options.h"
#include "core/units.h"
#include "io/reports/json_text.h"

namespace clsurf::cli {
namespace {

void print_matches(const std::vector<QueryMatch>& matches, bool of_a_line) {
    if (matches.empty())
        std::puts(of_a_line ? "the line has no logged points: a comment, a setting, or merged with the next block"
                            : "no logged point is there");
    for (const QueryMatch& m : matches) {
        fmt::print("line {}: {}\n", m.line, m.text);
        if (m.calls.subprogram)
            fmt::print("  in {} line {}: {}\n", m.calls.subprogram->file, m.calls.subprogram->line,
                       m.calls.subprogram->text);
        for (auto call = m.calls.calls.rbegin(); call != m.calls.calls.rend(); ++call)
            fmt::print("    called by {} line {}: {}\n", call->file, call->line, call->text);
        const auto text = [](const Vec3& p) {
            return fmt::format("X {:.4f} Y {:.4f} Z {:.4f} mm", p.x(), p.y(), p.z());
        };
        fmt::print("  point {} at {:.3f} s", m.point, m.time);
        if (m.pass) fmt::print(", pass {}", *m.pass);
        if (m.place.contact) fmt::print(", contact {}", text(*m.place.contact));
        fmt::print(", tool tip {}", text(m.place.tip));
        if (m.distance > 0) fmt::print(", {:.4f} mm away", m.distance);
        const auto known = [](const std::optional<double>& sigma, double factor) {
            return sigma ? fmt::format(" ±{:.2g}", *sigma * factor) : std::string();
        };
        fmt::print(
            "\n  speed {:.1f}{} mm/min, acceleration {:.1f}{} mm/s²; points {} … {} belong to the line (confidence {:.2f})\n",
            m.speed * seconds_per_minute, known(m.speed_uncertainty, seconds_per_minute), m.acceleration,
            known(m.acceleration_uncertainty, 1), m.line_points.first, m.line_points.last, m.confidence);
        if (m.fused) {
            const Vec3 sigma = m.fused->uncertainty * um_per_mm;
            fmt::print("  table {}, known to \u00b1{:.2g}, \u00b1{:.2g}, \u00b1{:.2g} \u00b5m\n",
                       text(m.fused->position), sigma.x(), sigma.y(), sigma.z());
        }
        if (!m.estimated_from.empty()) fmt::print("  {}\n", m.estimated_from);
        if (!m.why.reasons.empty()) fmt::print("  slow: {}\n", words_of(m.why, m.speed));
    }
}

void print_answer(const QueryAnswer& answer, const po::variables_map& values) {
    print_matches(answer.matches, values.count("line") > 0);
    if (answer.tip_line) {
        fmt::print("If this place was read off a map, it is a tool tip and belongs to line {}: --at tip:{}\n",
                   *answer.tip_line, values["at"].as<std::string>());
    }
}

ExitCode run_query(const po::variables_map& values) {
    if (values.count("point") + values.count("at") + values.count("line") + values.count("time") == 0) {
        throw UsageError("no point is given", "give one of --point N, --at X,Y,Z, --line N and --time T");
    }
    StageClock clock(read_common(values), 3);
    const Part part = load_part(read_part_options(values), clock);
    Diagnostics diagnostics = part.diagnostics;
    const QueryAnswer answer = find_matches(part, values, diagnostics);
    if (read_json(values)) {
        write_to_stdout(io::query_json(answer.matches, diagnostics));
    } else {
        print(diagnostics, values);
        if (!read_common(values).quiet) print_answer(answer, values);
    }
    return answer.matches.empty() ? ExitCode::check_failed : ExitCode::done;
}

}  // namespace

Subcommand query_subcommand() {
    return {
        .name = "query",
        .arguments = "PROGRAM LOG",
        .summary = "gives the line, the point and its values at a place, number or time",
        .description =
            "Finds points by number, place, line or time and names the program line that made them. The exit\n"
            "code is 1 if there are none. For points in a subprogram it also names the subprogram's line and\n"
            "the calls.\n\n"
            "  clsurf query part.nc run.biip --at 12.5,-3.0,1.2 --tool ball:6\n"
            "  clsurf query part.nc run.biip --line 1204 --json",
        .declare = declare_query,
        .positional = {"PROGRAM", "LOG"},
        .run = run_query,
    };
}

}  // namespace clsurf::cli
