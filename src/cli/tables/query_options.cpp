#include "cli/tables/query_options.h"

#include <charconv>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "cli/options/part.h"
#include "core/file_name.h"

namespace clsurf::cli {
namespace {

constexpr int most_nearest = 100'000;

constexpr std::string_view of_tip = "tip:";

/// "X,Y,Z" or "X,Y", also with blanks, and "tip:" before it.
WantedPlace parse_place(const std::string& given) {
    const bool tip = given.starts_with(of_tip);
    const std::string text = tip ? given.substr(of_tip.size()) : given;
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
        throw UsageError(fmt::format("--at: '{}' is not a place", given),
                         "--at X,Y,Z, or --at X,Y for what lies topmost there; --at tip:X,Y for the tool tip");
    wanted.of_tip = tip;
    wanted.from_above = numbers.size() == 2;
    wanted.at = Vec3(numbers[0], numbers[1], wanted.from_above ? 0 : numbers[2]);
    return wanted;
}

/// The nearest places. If the nearest pass is far away, the place is not on the part: a warning, or an error if
/// no height is given.
std::vector<FoundPlace> find_on_part(const PointQuery& query, const WantedPlace& wanted, const std::string& text,
                                     Diagnostics& diagnostics) {
    std::vector<FoundPlace> found = query.find_nearest(wanted);
    const double step_over = query.step_over();
    const bool is_far = !found.empty() && query.is_off_the_part(found.front().distance);
    if (wanted.from_above && (found.empty() || is_far)) {
        const std::string away = found.empty()
                                     ? "no cutter reaches there"
                                     : fmt::format("the nearest pass is {:.3f} mm away", found.front().distance);
        throw UsageError(fmt::format("--at {}: nothing was cut there, {}", text, away),
                         "`clsurf info` says where the part lies; --at X,Y,Z finds the nearest pass all the same");
    }
    if (is_far) {
        diagnostics.add(
            {Severity::warning,
             "query.off-the-part",
             Place::of_file(query.part().log.name),
             fmt::format("--at {} is not on the part: the nearest {} is {:.3f} mm away{}", text,
                         found.front().place.contact ? "contact point" : "tool tip", found.front().distance,
                         step_over > 0 ? fmt::format(", {:.0f} step-overs", found.front().distance / step_over)
                                       : std::string()),
             {}});
    }
    return found;
}

/// QueryAnswer::tip_line.
std::optional<LineNumber> tip_line(const PointQuery& query, WantedPlace wanted, const FoundPlace& contact) {
    if (wanted.of_tip || !query.knows_contacts()) return std::nullopt;
    wanted.of_tip = true;
    wanted.pieces = 1;
    const std::vector<FoundPlace> tips = query.find_nearest(wanted);
    if (tips.empty() || query.is_off_the_part(tips.front().distance)) return std::nullopt;
    // If a height is given, the closer of the two places is meant.
    if (!wanted.from_above && tips.front().distance > contact.distance) return std::nullopt;
    const LineMap& lines = *query.part().lines;
    const LineNumber line = lines.line_at(tips.front().point);
    return line == lines.line_at(contact.point) ? std::nullopt : std::optional(line);
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

}  // namespace

void declare_query(po::options_description& options) {
    // clang-format off
    options.add_options()
        ("point", po::value<long long>()->value_name("N"), "the point with this number, from 0")
        ("at", po::value<std::string>()->value_name("[tip:]X,Y[,Z]"), "the point nearest to a place on the part [mm], among contact points if the tool is known, else among tool tips; X,Y: the highest point there; tip:X,Y[,Z]: among tool tips, which the axes of maps show")
        ("nearest", po::value<int>()->value_name("K"), "with --at: the nearest point of each of the K nearest passes (of lines, if there is one pass)")
        ("line", po::value<std::string>()->value_name("N|FILE:N"), "every execution of this line, in the program or in a file that it calls; the first point of each")
        ("time", po::value<double>()->value_name("T"), "the point nearest to this time [s]")
        ("json", "one JSON object");
    // clang-format on
    declare_part(options);
    declare_tool(options);
    declare_derivative(options);
}

QueryAnswer find_matches(const Part& part, const po::variables_map& values, Diagnostics& diagnostics) {
    QueryAnswer answer;
    std::vector<QueryMatch>& matches = answer.matches;
    std::optional<WantedPlace> wanted;
    if (values.count("at") > 0) wanted = parse_place(values["at"].as<std::string>());
    if (values.count("nearest") > 0) {
        const int k = values["nearest"].as<int>();
        if (k < 1 || k > most_nearest) throw UsageError(fmt::format("--nearest must be 1 … {}", most_nearest));
        if (!wanted) throw UsageError("--nearest needs --at");
        wanted->pieces = static_cast<std::size_t>(k);
    }
    const PointQuery query(part, wanted.has_value());
    if (values.count("point") > 0) {
        const PointIndex point = values["point"].as<long long>();
        check_point(part.log, point);
        matches.push_back(query.match(point));
    }
    if (wanted) {
        const std::string text = values["at"].as<std::string>();
        const std::vector<FoundPlace> places = find_on_part(query, *wanted, text, diagnostics);
        if (!places.empty()) answer.tip_line = tip_line(query, *wanted, places.front());
        for (const FoundPlace& found : places) {
            matches.push_back(query.match(found.point));
            matches.back().distance = found.distance;
            if (found.place.contact) matches.back().place = found.place;
        }
    }
    if (values.count("time") > 0) {
        const double time = values["time"].as<double>();
        const double first = part.log.time_of(0), last = part.log.time_of(part.log.records - 1);
        if (!(time >= first - 0.5 * part.log.period && time <= last + 0.5 * part.log.period))
            throw UsageError(fmt::format("--time {:g}: the log lasts from {:g} to {:.6f} s", time, first, last));
        const PointIndex point = std::clamp<PointIndex>(point_at_time(part.log, time), 0, part.log.records - 1);
        matches.push_back(query.match(point));
    }
    if (values.count("line") > 0) {
        const PlaceInFile place = read_line(values["line"].as<std::string>(), part.program);
        for (const PointRange& range : query.points_of_line(place.file, place.line))
            matches.push_back(query.match(range.first));
    }
    return answer;
}

}  // namespace clsurf::cli
