#include "cli/tables/info_text.h"

#include <cstdio>
#include <string>

#include <fmt/format.h>

#include "core/printable_text.h"
#include "io/formats/run_parameters.h"

namespace clsurf::cli {
namespace {

void print_diagnostics(const Diagnostics& diagnostics) {
    if (diagnostics.empty()) std::puts("  no findings");
    for (const Diagnostic& d : diagnostics.summary()) {
        const std::string where = d.where.text();
        fmt::print("  {}: {}{}{}\n", name_of(d.severity), where, where.empty() ? "" : ": ", d.text);
        if (!d.hint.empty()) fmt::print("      hint: {}\n", d.hint);
    }
}

}  // namespace

void print_errors(const Diagnostics& diagnostics) {
    for (const Diagnostic& d : diagnostics.kept()) {
        if (d.severity == Severity::error) std::fputs(to_text(d).c_str(), stderr);
    }
}

void print_program(const Program& program, const ToolpathSummary& s, const Diagnostics& diagnostics) {
    const std::string& guessed = program.dialect_guessed_from;
    fmt::print("{}: program, dialect {}{}\n", program.main().name(), program.dialect->name,
               guessed.empty() ? std::string() : fmt::format(" (a guess: {})", printable(guessed)));
    fmt::print("  {} lines; {} rapids, {} lines at feed, {} arcs, {} dwells\n", program.main().line_count(), s.rapids,
               s.feeds, s.arcs, s.dwells);
    if (s.splines > 0) fmt::print("  {} splines\n", s.splines);
    fmt::print("  {:.1f} mm at feed", s.cutting_length);
    if (!s.bounds.isEmpty()) {
        const Vec3 a = s.bounds.min();
        const Vec3 b = s.bounds.max();
        fmt::print(", within X {:.3f} … {:.3f}, Y {:.3f} … {:.3f}, Z {:.3f} … {:.3f} mm", a.x(), b.x(), a.y(), b.y(),
                   a.z(), b.z());
    }
    fmt::print("\n");
    print_diagnostics(diagnostics);
}

void print_log(const Log& log, const LogVerdict& verdict, const Diagnostics& diagnostics) {
    fmt::print("{}: log, format {}{}\n", log.name, log.format, log.closed ? "" : ", not closed");
    fmt::print("  {}\n", printable(verdict.text));
    fmt::print("  {} records every {:g} ms, {:.3f} s\n", log.records, log.period * 1e3,
               log.records > 0 ? log.time_of(log.records - 1) : 0.0);
    std::string channels;
    for (const Channel& c : log.channels)
        channels +=
            fmt::format("{}{}{}", channels.empty() ? "" : ", ", c.name, c.unit.empty() ? "" : " [" + c.unit + "]");
    fmt::print("  channels: {}\n", channels);
    if (const std::vector<RunParameter> parameters = io::parameters_of_metadata(log.metadata); !parameters.empty())
        fmt::print("  parameters: {}\n", io::list_of(parameters));
    if (!diagnostics.empty()) print_diagnostics(diagnostics);
}

}  // namespace clsurf::cli
