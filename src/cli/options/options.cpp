#include "cli/options/options.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include <fmt/format.h>

#include "cli/options/output_format.h"
#include "cli/options/used_config.h"
#include "cli/terminal.h"
#include "core/units.h"
#include "io/readers/machine_file.h"

namespace clsurf::cli {

void declare_common(po::options_description& options) {
    // clang-format off
    options.add_options()
        ("help,h", "show this help")
        ("quiet,q", "print errors only; files and --json or --format output are still written")
        ("verbose,v", "print notes and every step")
        ("threads", po::value<int>()->value_name("N"), "threads to use (default: all cores)")
        ("no-config", "do not read .clsurf.toml")
        ("progress", po::value<std::string>()->value_name("auto|always|never"), "show the progress of long stages (default: auto, on a terminal)");
    // clang-format on
}

CommonOptions read_common(const po::variables_map& values) {
    CommonOptions common;
    common.quiet = values.count("quiet") > 0;
    common.verbose = values.count("verbose") > 0;
    if (values.count("threads") > 0) {
        common.threads = values["threads"].as<int>();
        if (common.threads < 1) throw UsageError("--threads must be at least 1");
    }
    if (values.count("progress") > 0) common.progress = values["progress"].as<std::string>();
    return common;
}

void declare_program_options(po::options_description& options) {
    // clang-format off
    options.add_options()
        ("dialect", po::value<std::string>()->value_name("DIALECT"), "language of the program (default: detected; see `clsurf help dialects`)")
        ("block-delete", po::value<std::string>()->value_name("on|off"), "skip blocks that begin with / (default: on)")
        ("tools", po::value<std::string>()->value_name("FILE"), "tool table in LinuxCNC's format, mm: lengths for G43, diameters for G41 and G42");
    // clang-format on
}

io::ProgramOptions read_program_options(const po::variables_map& values) {
    io::ProgramOptions options;
    if (values.count("dialect") > 0) options.dialect = values["dialect"].as<std::string>();
    if (values.count("block-delete") > 0) options.block_delete = values["block-delete"].as<std::string>() == "on";
    if (values.count("tools") > 0) options.tools = values["tools"].as<std::string>();
    if (values.count("start") > 0) options.start = read_start(values);
    return options;
}

void declare_log_options(po::options_description& options) {
    // clang-format off
    options.add_options()
        ("layout", po::value<std::string>()->value_name("FILE"), "layout of a foreign fixed-record log (TOML)")
        ("mapping", po::value<std::string>()->value_name("FILE"), "names, units and roles of the columns of a text log (TOML)")
        ("period", po::value<double>()->value_name("S"), "sampling period [s], instead of the one that the log or its mapping states (default: that one, else the median step of time)");
    // clang-format on
}

io::LogOptions read_log_options(const po::variables_map& values) {
    io::LogOptions options;
    if (values.count("layout") > 0) options.layout = values["layout"].as<std::string>();
    if (values.count("mapping") > 0) options.mapping = values["mapping"].as<std::string>();
    if (values.count("period") > 0) {
        options.period = values["period"].as<double>();
        if (!(*options.period > 0)) throw UsageError("--period must be greater than 0");
    }
    return options;
}

void declare_force(po::options_description& options) {
    options.add_options()("force", "continue although the log does not belong to the program; nothing is judged");
}

void declare_kinematics(po::options_description& options, MachineUse use) {
    std::string meaning = "machine file; its kinematics convert five-axis positions into tool tips in the workpiece";
    switch (use) {
        case MachineUse::kinematics: break;
        case MachineUse::simulation:
            meaning += ", and a program without a log is simulated on it (default: that of clsurf machine --defaults)";
            break;
        case MachineUse::limits: meaning += ", and the commanded motion is compared with its limits"; break;
        case MachineUse::known:
            meaning +=
                ", and what the runs do not determine is taken from it (default: that of clsurf machine --defaults)";
            break;
    }
    options.add_options()("machine", po::value<std::string>()->value_name("FILE"), meaning.c_str());
}

std::shared_ptr<const Kinematics> load_kinematics(const std::string& path) {
    if (path.empty()) return nullptr;
    const Machine machine = io::read_machine(path);
    return machine.kinematics.has_rotary() ? std::make_shared<const Kinematics>(machine.kinematics) : nullptr;
}

void declare_simulation(po::options_description& options) {
    // clang-format off
    options.add_options()
        ("machine", po::value<std::string>()->value_name("FILE"), "machine file (default: that of clsurf machine --defaults)")
        ("start", po::value<std::string>()->value_name("X,Y,Z"), "position of the axes before the program, mm (default: 0,0,0)");
    // clang-format on
}

Vec3 read_start(const po::variables_map& values) {
    if (values.count("start") == 0) return Vec3::Zero();
    const std::vector<double> given = parse_numbers(values["start"].as<std::string>(), "--start", 3);
    return {given[0], given[1], given[2]};
}

void declare_json(po::options_description& options) {
    options.add_options()("json", "one JSON object instead of text");
}

bool read_json(const po::variables_map& values) { return values.count("json") > 0; }

bool read_json_with_output(const po::variables_map& values) {
    const bool json = read_json(values);
    if (json && values.count("output") > 0 && is_standard_output(values["output"].as<std::string>()))
        throw UsageError("--json and -o both write to standard output");
    return json;
}

void write_answer(std::string_view text, const po::variables_map& values) {
    if (read_common(values).quiet) return;
    if (values.count("output") > 0 && is_standard_output(values["output"].as<std::string>()))
        std::fwrite(text.data(), 1, text.size(), stderr);
    else
        write_to_stdout(text);
}

bool given(const po::variables_map& values, const char* name) {
    return values.count(name) > 0 && !values[name].defaulted();
}

void refuse_given(const po::variables_map& values, const po::options_description& options, const std::string& needed,
                  const std::string& hint) {
    for (const auto& option : options.options()) {
        if (given(values, option->long_name().c_str()))
            throw UsageError("--" + option->long_name() + " needs " + needed, hint);
    }
}

void refuse_program_options(const po::variables_map& values, const std::string& hint) {
    po::options_description of_programs;
    declare_program_options(of_programs);
    refuse_given(values, of_programs, "a program", hint);
}

namespace {

/// The values of one option, as on a command line.
std::vector<std::string> texts_of(const boost::any& value, const std::string& name) {
    if (const auto* text = boost::any_cast<std::string>(&value)) return {*text};
    if (const auto* texts = boost::any_cast<std::vector<std::string>>(&value)) return *texts;
    if (const auto* number = boost::any_cast<double>(&value)) return {fmt::format("{}", *number)};
    if (const auto* number = boost::any_cast<int>(&value)) return {fmt::format("{}", *number)};
    throw std::logic_error("--" + name + " has values of a type that words_of() does not write");
}

}  // namespace

std::vector<std::string> words_of(const po::options_description& group, const po::variables_map& values,
                                  const std::vector<std::string>& except) {
    std::vector<std::string> words;
    for (const auto& option : group.options()) {
        const std::string& name = option->long_name();
        if (values.count(name) == 0 || std::ranges::find(except, name) != except.end()) continue;
        if (option->semantic()->max_tokens() == 0) {
            words.push_back("--" + name);
            continue;
        }
        for (const std::string& text : texts_of(values[name].value(), name))
            words.insert(words.end(), {"--" + name, text});
    }
    return words;
}

void note_overruled(Diagnostics& diagnostics, const Log& log, const std::string& option, const std::string& configured,
                    const std::string& recorded) {
    diagnostics.add({Severity::note, "config.overruled", Place::of_file(log.name),
                     fmt::format("the log says {} {}: {} of {} is not used", option, recorded, configured, config_name),
                     fmt::format("--{} on the command line takes precedence", option)});
}

std::string required(const po::variables_map& values, const char* name) {
    if (values.count(name) == 0 || values[name].as<std::string>().empty()) {
        if (std::string_view(name) == "output") throw UsageError("no output file given", "add -o FILE");
        throw UsageError(std::string("missing argument: ") + name);
    }
    return values[name].as<std::string>();
}

std::string first_value(const po::variables_map& values, const char* name) {
    if (values.count(name) > 0) {
        if (const auto* list = boost::any_cast<std::vector<std::string>>(&values[name].value())) return list->front();
    }
    return required(values, name);
}

double parse_length(const std::string& text, const std::string& option) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
    const bool micro = unit == "um" || unit == "µm";
    if (error != std::errc() || !(value >= 0) || !std::isfinite(value) || (!micro && unit != "mm"))
        throw UsageError(option + ": '" + text + "' is not a length with its unit, such as 5um or 0.005mm");
    return micro ? value / um_per_mm : value;
}

void write_to_stdout(std::string_view text) {
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) {
        throw SystemError(std::string("cannot write to standard output: ") + std::strerror(errno));
    }
}

std::vector<double> parse_numbers(const std::string& text, const std::string& option, std::size_t count) {
    std::vector<double> numbers;
    const char* at = text.data();
    const char* const end = at + text.size();
    for (;;) {
        while (at != end && *at == ' ') ++at;
        if (at != end && *at == '+') ++at;
        double value = 0;
        const auto read = std::from_chars(at, end, value);
        if (read.ec != std::errc() || !std::isfinite(value)) break;
        numbers.push_back(value);
        at = read.ptr;
        // Numbers are separated by commas, blanks, or both.
        const bool blank = at != end && *at == ' ';
        while (at != end && *at == ' ') ++at;
        if (at == end || (*at != ',' && !blank)) break;
        if (*at == ',') ++at;
    }
    if (at != end || numbers.empty() || (count != 0 && numbers.size() != count)) {
        throw UsageError(option + ": '" + text + "' is not " +
                         (count == 0 ? std::string("a list of numbers") : std::to_string(count) + " numbers") +
                         " separated by commas");
    }
    return numbers;
}

std::vector<std::string> split_names(const std::string& text) {
    std::vector<std::string> names;
    std::size_t at = 0;
    while (at <= text.size()) {
        const std::size_t end = std::min(text.find(',', at), text.size());
        if (end > at) names.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return names;
}

std::vector<double> read_size(const std::string& text) {
    if (text == "hd") return {1920, 1080};
    if (text == "4k") return {3840, 2160};
    const std::size_t x = text.find_first_of("xX");
    const auto pixels = [](std::string_view number) {
        double value = 0;
        const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
        constexpr double least = 64;
        constexpr double most = 8192;
        const bool good = error == std::errc() && end == number.data() + number.size() && value >= least &&
                          value <= most && value == std::floor(value);
        return good ? value : 0.0;
    };
    const std::string_view all = text;
    const double width = pixels(all.substr(0, x));
    const double height = x == std::string::npos ? 0.0 : pixels(all.substr(x + 1));
    if (width == 0 || height == 0)
        throw UsageError("--size: '" + text +
                         "' is not WIDTHxHEIGHT in whole pixels, 64 to 8192, such as 1600x1200, or hd or 4k");
    return {width, height};
}

void print(const Diagnostics& diagnostics, const po::variables_map& values) {
    const CommonOptions common = read_common(values);
    for (const Diagnostic& diagnostic : diagnostics.summary()) {
        const bool shown = diagnostic.severity == Severity::error ||
                           (diagnostic.severity == Severity::warning && !common.quiet) ||
                           (diagnostic.severity == Severity::note && common.verbose);
        if (shown) write_message(to_text(diagnostic));
    }
}

}  // namespace clsurf::cli
