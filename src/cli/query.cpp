// clsurf query: which line, which point, what happened there.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <utility>

#include <fmt/format.h>

#include "cli/part.h"
#include "core/file_name.h"
#include "core/units.h"
#include "field/field_set.h"
#include "io/reports/json_text.h"
#include "pipeline/contacts.h"

namespace clsurf::cli {
namespace {

constexpr PointIndex window = 256;  ///< points to each side that the derivatives may look at

constexpr int most_nearest = 100'000;

/// A part and, where the tool is known, its contact points.
struct QueriedPart {
    const Part& part;
    const CallChains chains;
    std::shared_ptr<const MotionEstimate> estimate;
    std::optional<ClSurface> surface;  ///< where places are asked for, or contact points
    std::unique_ptr<const PartContacts> contacts;

    QueriedPart(const Part& queried, bool needs_surface) : part(queried), chains(part.log, part.program, *part.lines) {
        if (part.derivative == DerivativeMethod::kalman)
            estimate = estimate_motion(part, find_runs(gather(part.path), *part.lines));
        if (needs_surface || part.tool) surface = stitch(part);
        if (part.tool) contacts = std::make_unique<const PartContacts>(part, *surface, *part.tool);
    }
    QueriedPart(const QueriedPart&) = delete;
    QueriedPart& operator=(const QueriedPart&) = delete;

    [[nodiscard]] CutterPlace place(PointIndex point) const {
        return contacts ? contacts->place(point) : CutterPlace{part.path.at(point), std::nullopt};
    }
};

/// "X,Y,Z" or "X,Y", also with blanks.
WantedPlace parse_place(std::string text) {
    std::string commas;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != ' ' && text[i] != '\t') {
            commas += text[i];
        } else if (!commas.empty() && commas.back() != ',') {
            const std::size_t next = text.find_first_not_of(" \t", i);
            if (next != std::string::npos && text[next] != ',') commas += ',';
        }
    }
    WantedPlace wanted;
    const std::vector<double> numbers = parse_numbers(commas, "--at", 0);
    if (numbers.size() != 2 && numbers.size() != 3)
        throw UsageError(fmt::format("--at: '{}' is not a place", text),
                         "--at X,Y,Z, or --at X,Y for what lies topmost there");
    wanted.from_above = numbers.size() == 2;
    wanted.at = Vec3(numbers[0], numbers[1], wanted.from_above ? 0 : numbers[2]);
    return wanted;
}

/// Pieces of passes with one line each.
Passes cut_by_lines(const Part& part, const Passes& passes) {
    Passes pieces;
    for (const Pass& pass : passes) {
        Pass piece{pass.first, pass.first, pass.kind};
        LineNumber line = part.lines->line_at(pass.first);
        for (PointIndex i = pass.first + 1; i <= pass.last; ++i) {
            const LineNumber now = part.lines->line_at(i);
            if (now != line) {
                pieces.push_back(piece);
                piece.first = i;
                line = now;
            }
            piece.last = i;
        }
        pieces.push_back(piece);
    }
    return pieces;
}

/// The nearest point of each of the nearest passes, or of each of the nearest lines where there is one pass only.
std::vector<FoundPlace> find_nearest(const QueriedPart& queried, const WantedPlace& wanted) {
    const Part& part = queried.part;
    if (queried.contacts && queried.contacts->known()) {
        std::vector<FoundPlace> found = queried.contacts->find(wanted);
        if (!found.empty() || wanted.from_above) return found;
    }
    const ClSurface& surface = *queried.surface;
    if (surface.step_over > 0) return find_places(part.path, surface.passes, nullptr, surface.step_over, wanted);
    return find_places(part.path, cut_by_lines(part, surface.passes), nullptr, 0, wanted);
}

/// A place from which the nearest pass lies far away is not on the part; under one without a height nothing was cut.
std::vector<FoundPlace> find_on_part(const QueriedPart& queried, const WantedPlace& wanted, const std::string& text,
                                     Diagnostics& diagnostics) {
    constexpr double far_away = 5;  // step-overs
    std::vector<FoundPlace> found = find_nearest(queried, wanted);
    const double step_over = queried.surface->step_over;
    const bool is_far = !found.empty() && step_over > 0 && found.front().distance > far_away * step_over;
    if (wanted.from_above && (found.empty() || is_far)) {
        const std::string away = found.empty()
                                     ? "no cutter reaches there"
                                     : fmt::format("the nearest pass is {:.3f} mm away", found.front().distance);
        throw UsageError(fmt::format("--at {}: nothing was cut there, {}", text, away),
                         "`clsurf info` says where the part lies; --at X,Y,Z finds the nearest pass all the same");
    }
    if (is_far) {
        diagnostics.add({Severity::warning,
                         "query.off-the-part",
                         Place::of_file(queried.part.log.name),
                         fmt::format("--at {} is not on the part: the nearest {} is {:.3f} mm away, {:.0f} step-overs",
                                     text, found.front().place.contact ? "contact point" : "tool tip",
                                     found.front().distance, found.front().distance / step_over),
                         {}});
    }
    return found;
}

/// The number of the cut pass that a point lies on.
std::optional<std::int64_t> pass_at(const Passes& passes, PointIndex point) {
    std::int64_t number = 0;
    for (const Pass& pass : passes) {
        if (pass.kind == PassKind::cut) ++number;
        if (point >= pass.first && point <= pass.last)
            return pass.kind == PassKind::cut ? std::optional(number) : std::nullopt;
    }
    return std::nullopt;
}

PointIndex point_at_time(const Log& log, double time) {
    if (log.find("time") == nullptr) return std::llround(time / log.period);
    PointIndex low = 0;
    PointIndex high = log.records - 1;
    while (low < high) {
        const PointIndex middle = low + (high - low) / 2;
        (log.time_of(middle) < time ? low = middle + 1 : high = middle);
    }
    const bool before_is_nearer = low > 0 && time - log.time_of(low - 1) < log.time_of(low) - time;
    return before_is_nearer ? low - 1 : low;
}

/// The points round one that have the same line, or the same kind.
template <typename Same>
PointRange spread(PointIndex point, PointIndex count, PointIndex reach, Same&& same) {
    PointRange range{point, point};
    while (range.first > 0 && point - range.first < reach && same(range.first - 1)) --range.first;
    while (range.last + 1 < count && range.last - point < reach && same(range.last + 1)) ++range.last;
    return range;
}

io::QueryMatch match_of(const QueriedPart& queried, PointIndex point) {
    const Part& part = queried.part;
    io::QueryMatch match;
    const LineMap& lines = *part.lines;
    match.point = point;
    match.time = part.log.time_of(point);
    match.line = lines.line_at(point);
    match.calls = queried.chains.of(point);
    match.text = std::string(part.program.main().line(match.line));
    match.place = queried.place(point);
    if (queried.surface) match.pass = pass_at(queried.surface->passes, point);
    match.line_points =
        spread(point, part.log.records, part.log.records, [&](PointIndex i) { return lines.line_at(i) == match.line; });
    read_confidences(part.path, part.program, lines, point, {&match.confidence, 1});
    // Derivatives look no farther than this kind of motion lasts.
    const auto kind_at = [&](PointIndex i) {
        PointKind kind = PointKind::idle;
        lines.read_kinds(i, {&kind, 1});
        return kind;
    };
    const PointKind kind = kind_at(point);
    const PointRange piece = spread(point, part.log.records, window, [&](PointIndex i) { return kind_at(i) == kind; });
    Passes local;
    local.push_back({piece.first, piece.last, PassKind::cut});
    const FieldSet fields(part.log, part.path, local, {queried.estimate, 0});
    const auto value = [&](std::string_view name) { return fields.values(name, {point, point}).front(); };
    match.speed = value("speed");
    match.acceleration = value("acceleration");
    if (queried.estimate) {
        match.speed_uncertainty = value("speed_uncertainty");
        match.acceleration_uncertainty = value("acceleration_uncertainty");
    }
    return match;
}

void check_point(const Log& log, PointIndex point) {
    if (point < 0 || point >= log.records)
        throw UsageError(fmt::format("point {}: the log has points 0 … {}", point, log.records - 1));
}

struct PlaceInFile {
    std::size_t file = 0;  ///< index into Program::files
    LineNumber line = 0;
};

/// "N": a line of the main program; "FILE:N": of that file, with or without its folder.
PlaceInFile read_line(const std::string& text, const Program& program) {
    const std::size_t colon = text.rfind(':');
    const std::string number = colon == std::string::npos ? text : text.substr(colon + 1);
    PlaceInFile place;
    if (colon != std::string::npos) {
        const std::string name = text.substr(0, colon);
        std::string known;
        for (; place.file < program.files.size(); ++place.file) {
            const std::string& path = program.files[place.file].name();
            if (path == name || file_name(path) == name) break;
            known += (known.empty() ? "" : ", ") + file_name(path);
        }
        if (place.file == program.files.size())
            throw UsageError("--line " + text + ": the program has no file '" + name + "', only " + known);
    }
    const SourceText& file = program.files[place.file];
    const char* const end = number.data() + number.size();
    const auto [stop, error] = std::from_chars(number.data(), end, place.line);
    if (error == std::errc::invalid_argument || stop != end)
        throw UsageError("--line: '" + number + "' is not a whole number", "--line N, or --line FILE:N");
    if (error != std::errc() || place.line < 1 || place.line > file.line_count()) {
        throw UsageError(fmt::format("--line {}: {} has lines 1 … {}", text,
                                     place.file == 0 ? "the program" : file.name(), file.line_count()));
    }
    return place;
}

std::vector<io::QueryMatch> find_matches(const Part& part, const po::variables_map& values, Diagnostics& diagnostics) {
    std::vector<io::QueryMatch> matches;
    std::optional<WantedPlace> wanted;
    if (values.count("at") > 0) wanted = parse_place(values["at"].as<std::string>());
    if (values.count("nearest") > 0) {
        const int k = values["nearest"].as<int>();
        if (k < 1 || k > most_nearest) throw UsageError(fmt::format("--nearest must be 1 … {}", most_nearest));
        if (!wanted) throw UsageError("--nearest goes with --at");
        wanted->pieces = static_cast<std::size_t>(k);
    }
    const QueriedPart queried(part, wanted.has_value());
    if (values.count("point") > 0) {
        const PointIndex point = values["point"].as<long long>();
        check_point(part.log, point);
        matches.push_back(match_of(queried, point));
    }
    if (wanted) {
        const std::string text = values["at"].as<std::string>();
        for (const FoundPlace& found : find_on_part(queried, *wanted, text, diagnostics)) {
            matches.push_back(match_of(queried, found.point));
            matches.back().distance = found.distance;
            if (found.place.contact) matches.back().place = found.place;
        }
    }
    if (values.count("time") > 0) {
        const double time = values["time"].as<double>();
        const PointIndex point = point_at_time(part.log, time);
        if (point < 0 || point >= part.log.records || !std::isfinite(time)) {
            throw UsageError(fmt::format("--time {:g}: the log lasts from 0 to {:.6f} s", time,
                                         part.log.time_of(part.log.records - 1)));
        }
        matches.push_back(match_of(queried, point));
    }
    if (values.count("line") > 0) {
        const PlaceInFile place = read_line(values["line"].as<std::string>(), part.program);
        const std::vector<PointRange> ranges = place.file == 0
                                                   ? part.lines->points_of(place.line)
                                                   : points_of(part.program, *part.lines, place.file, place.line);
        for (const PointRange& range : ranges) matches.push_back(match_of(queried, range.first));
    }
    return matches;
}

void print_matches(const std::vector<io::QueryMatch>& matches) {
    if (matches.empty())
        std::puts("the line has no logged points: a comment, a setting, or merged with the next block");
    for (const io::QueryMatch& m : matches) {
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
    }
}

ExitCode run_query(const po::variables_map& values) {
    if (values.count("point") + values.count("at") + values.count("line") + values.count("time") == 0) {
        throw UsageError("what to look for is missing", "--point N, --at X,Y,Z, --line N or --time T");
    }
    StageClock clock(read_common(values), 3);
    const Part part = load_part(read_part_options(values), clock);
    Diagnostics diagnostics = part.diagnostics;
    const std::vector<io::QueryMatch> matches = find_matches(part, values, diagnostics);
    if (read_json(values)) {
        write_to_stdout(io::query_json(matches, diagnostics));
    } else {
        print(diagnostics, values);
        if (!read_common(values).quiet) print_matches(matches);
    }
    return matches.empty() ? ExitCode::check_failed : ExitCode::done;
}

}  // namespace

Subcommand query_subcommand() {
    return {
        .name = "query",
        .arguments = "PROGRAM LOG",
        .summary = "which line, which point, what happened there",
        .description =
            "Finds points by number, place, line or time and says which line of the program made them;\n"
            "exits with 1 if there are none. Of points in a subprogram it also names the subprogram's line and the calls.\n\n"
            "  clsurf query part.nc run.biip --at 12.5,-3.0,1.2 --tool ball:6\n"
            "  clsurf query part.nc run.biip --line 1204 --json",
        .declare =
            [](po::options_description& options) {
                // clang-format off
                options.add_options()
                    ("point", po::value<long long>()->value_name("N"), "the point of that number, from 0")
                    ("at", po::value<std::string>()->value_name("X,Y[,Z]"), "the point nearest to a place on the part [mm]: among contact points where the tool is known, else among tool tips; X,Y: what lies topmost there")
                    ("nearest", po::value<int>()->value_name("K"), "with --at: the nearest point of each of the K nearest passes (of lines, where there is one pass)")
                    ("line", po::value<std::string>()->value_name("N|FILE:N"), "every run of points of that line, of the program or of a file that it calls; the first point of each")
                    ("time", po::value<double>()->value_name("T"), "the point nearest to that time [s]")
                    ("json", "one JSON object");
                // clang-format on
                declare_part(options);
                declare_tool(options);
                declare_derivative(options);
            },
        .positional = {"PROGRAM", "LOG"},
        .run = run_query,
    };
}

}  // namespace clsurf::cli
