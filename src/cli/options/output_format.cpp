#include "cli/options/output_format.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>

#include "cli/text.h"
#include "core/error.h"
#include "core/file_name.h"
#include "core/letter_case.h"

namespace clsurf::cli {
namespace {

constexpr std::array picture_table{OutputFormat{"png", ".png", true}, OutputFormat{"jpeg", ".jpg .jpeg", true},
                                   OutputFormat{"tiff", ".tif .tiff", true}, OutputFormat{"webp", ".webp", true}};
constexpr std::array drawing_table{OutputFormat{"png", ".png", true},
                                   OutputFormat{"jpeg", ".jpg .jpeg", true},
                                   OutputFormat{"tiff", ".tif .tiff", true},
                                   OutputFormat{"webp", ".webp", true},
                                   OutputFormat{"svg", ".svg"},
                                   OutputFormat{"pdf", ".pdf", true}};
constexpr std::array front_table{OutputFormat{"png", ".png", true},
                                 OutputFormat{"jpeg", ".jpg .jpeg", true},
                                 OutputFormat{"tiff", ".tif .tiff", true},
                                 OutputFormat{"webp", ".webp", true},
                                 OutputFormat{"svg", ".svg"},
                                 OutputFormat{"pdf", ".pdf", true},
                                 OutputFormat{"csv", ".csv"},
                                 OutputFormat{"json", ".json"}};
constexpr std::array page_table{OutputFormat{"html", ".html .htm"}};
constexpr std::array log_table{OutputFormat{"biip", ".biip", true}};
constexpr std::array column_table{OutputFormat{"csv", ".csv"}, OutputFormat{"biip", ".biip", true},
                                  OutputFormat{"vtp", ".vtp", true}, OutputFormat{"vtkhdf", ".vtkhdf .hdf", true}};
constexpr std::array report_table{OutputFormat{"text", ".txt"}, OutputFormat{"json", ".json"},
                                  OutputFormat{"csv", ".csv"}, OutputFormat{"sarif", ".sarif .sarif.json"},
                                  OutputFormat{"junit", ".xml"}};
constexpr std::array motion_table{OutputFormat{"csv", ".csv"}};

constexpr std::array toml_table{OutputFormat{"toml", ".toml"}};

constexpr OutputFormats all_kinds[] = {drawing_table, page_table, log_table, column_table, report_table};

std::vector<std::string_view> endings_of(const OutputFormat& format) {
    std::vector<std::string_view> endings;
    std::string_view rest = format.endings;
    while (!rest.empty()) {
        const std::size_t blank = std::min(rest.find(' '), rest.size());
        endings.push_back(rest.substr(0, blank));
        rest.remove_prefix(std::min(blank + 1, rest.size()));
    }
    return endings;
}

/// The format with the longest extension of the name; nullptr: none matches.
const OutputFormat* by_ending(const std::string& path, OutputFormats formats) {
    const std::string name = lower_case(file_name(path));
    const OutputFormat* found = nullptr;
    std::size_t longest = 0;
    for (const OutputFormat& format : formats) {
        for (const std::string_view ending : endings_of(format)) {
            if (!name.ends_with(ending) || ending.size() <= longest) continue;
            longest = ending.size();
            found = &format;
        }
    }
    return found;
}

bool is_terminal(const std::string& path) {
    return is_standard_output(path) ? ::isatty(STDOUT_FILENO) == 1 : path == "/dev/tty";
}

const OutputFormat& by_name(std::string_view name, OutputFormats formats) {
    const auto found =
        std::find_if(formats.begin(), formats.end(), [&](const OutputFormat& f) { return f.name == name; });
    if (found == formats.end()) throw UsageError(fmt::format("'{}' is not a format of this output", name));
    return *found;
}

}  // namespace

OutputFormats picture_formats() { return picture_table; }
OutputFormats drawing_formats() { return drawing_table; }
OutputFormats front_formats() { return front_table; }
OutputFormats page_formats() { return page_table; }
OutputFormats log_formats() { return log_table; }
OutputFormats table_formats() { return column_table; }
OutputFormats report_formats() { return report_table; }
OutputFormats toml_formats() { return toml_table; }
OutputFormats motion_formats() { return motion_table; }

std::string endings_of(OutputFormats formats) {
    std::vector<std::string_view> endings;
    for (const OutputFormat& format : formats) {
        for (const std::string_view ending : endings_of(format)) endings.push_back(ending);
    }
    return join_words(endings, "or");
}

const OutputFormat& output_format(const std::string& path, OutputFormats formats, std::string_view chosen,
                                  std::string_view option) {
    const OutputFormat* format = nullptr;
    if (is_stream(path)) {
        format = chosen.empty() ? &formats.front() : &by_name(chosen, formats);
    } else {
        format = by_ending(path, formats);
        if (!chosen.empty() && format != nullptr && format->name != chosen)
            throw UsageError(
                fmt::format("{}: '{}' is a name for {}, but --format asks for {}", option, path, format->name, chosen));
        if (!chosen.empty() && format == nullptr) format = &by_name(chosen, formats);
        if (format == nullptr)
            throw UsageError(fmt::format("{}: '{}' must end in {}", option, path, endings_of(formats)),
                             path.ends_with(".csv") ? "the ending chooses the format; `clsurf export` writes CSV"
                                                    : "the ending chooses the format");
    }
    if (format->binary && is_terminal(path))
        throw UsageError(fmt::format("{}: {} is binary and would be written to the terminal", option, format->name),
                         "redirect standard output, or name a file");
    return *format;
}

void require_program_ending(const std::string& path) {
    if (is_stream(path)) return;
    for (const OutputFormats formats : all_kinds) {
        const OutputFormat* other = by_ending(path, formats);
        if (other == nullptr || other->name == "text") continue;
        throw UsageError(fmt::format("-o: '{}' is a name for {}, but an NC program is written", path, other->name));
    }
}

bool is_stream(const std::string& path) {
    if (path == "-") return true;
    struct stat status {};
    const bool there = ::stat(path.c_str(), &status) == 0;
    // Standard output may be a file; it is nevertheless written as a stream.
    return is_standard_output(path) || (there && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode));
}

bool is_standard_output(const std::string& path) {
    return path == "-" || path == "/dev/stdout" || path == "/dev/fd/1" || path == "/proc/self/fd/1";
}

}  // namespace clsurf::cli
