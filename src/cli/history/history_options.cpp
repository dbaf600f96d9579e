#include "cli/history/history_options.h"

#include "cli/options/look.h"
#include "history/parameter_rules.h"
#include "io/files/utc.h"

namespace clsurf::cli {
namespace {

std::pair<LineNumber, LineNumber> parse_lines(const std::string& text) {
    const std::size_t dash = text.find('-');
    const auto number = [&](const std::string& word) {
        const bool digits =
            !word.empty() && word.size() < 10 && word.find_first_not_of("0123456789") == std::string::npos;
        const LineNumber line = digits ? static_cast<LineNumber>(std::stoul(word)) : 0;
        if (line == 0) throw UsageError("--lines: '" + text + "' is not a line or a range of lines, such as 500-670");
        return line;
    };
    const LineNumber first = number(text.substr(0, dash));
    const LineNumber last = dash == std::string::npos ? first : number(text.substr(dash + 1));
    if (last < first) throw UsageError("--lines: '" + text + "' ends before it begins");
    return {first, last};
}

}  // namespace

void declare_run_choice(po::options_description& options) {
    // clang-format off
    options.add_options()
        ("program", po::value<std::string>()->value_name("NAME"), "only runs of the program of that name")
        ("where", po::value<std::vector<std::string>>()->value_name("NAME=VALUE"), "only runs with that parameter; may be repeated")
        ("since", po::value<std::string>()->value_name("TIME"), "only runs from that time on, such as 2026-11-24")
        ("last", po::value<long long>()->value_name("N"), "only the latest N runs");
    // clang-format on
}

io::RunFilter read_run_choice(const po::variables_map& values) {
    io::RunFilter filter;
    filter.program = text_of(values, "program", "");
    if (values.count("where") > 0) {
        for (const std::string& text : values["where"].as<std::vector<std::string>>()) {
            if (text.find('=') == std::string::npos)
                throw UsageError("--where: '" + text + "' is not NAME=VALUE", "for example --where tool=D6R3");
            filter.parameters.push_back(parse_parameter(text));
        }
    }
    if (values.count("since") > 0) filter.since = io::parse_utc(values["since"].as<std::string>(), "--since");
    if (values.count("last") > 0) {
        const long long last = values["last"].as<long long>();
        if (last < 1) throw UsageError("--last must be at least 1");
        filter.last = static_cast<std::size_t>(last);
    }
    return filter;
}

void declare_trend(po::options_description& options) {
    // clang-format off
    options.add_options()
        ("quantity", po::value<std::string>()->value_name("QUANTITY"), "the quantity that the trend shows (default: worst_score; `clsurf help quantities`)")
        ("pass", po::value<long long>()->value_name("N"), "only defects on that pass")
        ("lines", po::value<std::string>()->value_name("FIRST-LAST"), "only defects on these lines of the program")
        ("cause", po::value<std::string>()->value_name("feed_drop|oscillation|lag_step|point_spacing|corner|reversal|pass_end|path_tolerance"), "only defects of that cause")
        ("by", po::value<std::string>()->value_name("NAME"), "mark the runs by a parameter, or by program, machine or tool")
        ("limit", po::value<double>()->value_name("VALUE"), "a limit line; runs above it are counted")
        ("size", po::value<std::string>()->value_name("WxH|hd|4k"), "size of the picture in pixels (default: 1600x900)")
        ("gl", po::value<std::string>()->value_name("osmesa|egl"), "renderer: osmesa uses the processor, egl a graphics card (default: osmesa)");
    // clang-format on
}

TrendOptions read_trend_options(const po::variables_map& values) {
    TrendOptions options;
    options.quantity = &find_history_quantity(text_of(values, "quantity", "worst_score"));
    if (values.count("pass") > 0) {
        options.filter.pass = values["pass"].as<long long>();
        if (*options.filter.pass < 1) throw UsageError("--pass: passes count from 1");
    }
    if (values.count("lines") > 0) options.filter.lines = parse_lines(values["lines"].as<std::string>());
    options.filter.cause = text_of(values, "cause", "");
    options.by = text_of(values, "by", "");
    if (values.count("limit") > 0) options.limit = values["limit"].as<double>();
    options.output = text_of(values, "output", "");
    const std::vector<double> size = read_size(text_of(values, "size", "1600x900"));
    options.look.width = static_cast<int>(size[0]);
    options.look.height = static_cast<int>(size[1]);
    options.look.gl = text_of(values, "gl", "osmesa");
    return options;
}

}  // namespace clsurf::cli
