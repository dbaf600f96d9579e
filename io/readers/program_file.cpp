#include "io/readers/program_file.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/spelling.h"
#include "io/files/compressed.h"
#include "io/formats/foreign_content.h"
#include "io/readers/tool_table_file.h"
#include "program/interpreter.h"

namespace clsurf::io {
namespace {

SourceText source_text(const Source& source) { return {source.name, source.text(), source.keep_alive}; }

/// Subprograms are in the folder of the program, with the name that the control gives them.
std::optional<SourceText> load_from_folder(const std::filesystem::path& folder, const std::string& name) {
    static constexpr std::array<std::string_view, 14> endings{"",     ".ngc", ".nc", ".NC", ".spf", ".SPF", ".mpf",
                                                              ".MPF", ".tap", ".i",  ".I",  ".txt", ".h",   ".H"};
    // A name with a path could leave the folder.
    if (name.find('/') != std::string::npos) return std::nullopt;
    for (const std::string& stem :
         {name, "O" + name, "o" + name, "O" + std::string(name.size() < 4 ? 4 - name.size() : 0, '0') + name}) {
        for (const std::string_view ending : endings) {
            const std::filesystem::path path = folder / (stem + std::string(ending));
            std::error_code error;
            if (std::filesystem::is_regular_file(path, error)) return source_text(open_source(path.string()));
        }
    }
    return std::nullopt;
}

/// Throws InputError and UsageError.
InterpreterOptions interpreter_options(const Source& source, const ProgramOptions& wanted) {
    InterpreterOptions options;
    options.block_delete = wanted.block_delete;
    options.start = wanted.start;
    if (!wanted.tools.empty()) options.tools = read_tool_table(map_file(wanted.tools));
    if (const std::string& dialect = wanted.dialect; !dialect.empty()) {
        options.dialect = find_dialect(dialect);
        if (options.dialect == nullptr) {
            std::vector<std::string_view> names;
            for (const Dialect& d : dialects()) names.push_back(d.name);
            throw UsageError("unknown dialect '" + dialect + "'", did_you_mean(dialect, names));
        }
    }
    const std::filesystem::path folder = std::filesystem::path(source.name).parent_path();
    options.load = [folder](const std::string& name) { return load_from_folder(folder, name); };
    if (source.bytes.empty()) throw InputError(Place::of_file(source.name), "is empty, expected an NC program");
    require_program_text(source);
    return options;
}

}  // namespace

namespace {

/// A block begins with a word (N10, G1, X-3, #1=, o100), possibly after '/'; a comment with '(' or ';', a tape with '%'.
bool looks_like_block(std::string_view line) {
    const std::size_t first = line.find_first_not_of(" \t/:");
    if (first == std::string_view::npos) return true;
    line.remove_prefix(first);
    if (line[0] == '(' || line[0] == ';' || line[0] == '%' || line[0] == '#') return true;
    const bool letter = (line[0] >= 'A' && line[0] <= 'Z') || (line[0] >= 'a' && line[0] <= 'z');
    const std::size_t value = line.find_first_not_of(" \t", 1);
    return letter && value != std::string_view::npos &&
           std::string_view("0123456789+-.[#<=").find(line[value]) != std::string_view::npos;
}

}  // namespace

bool looks_like_program(const Source& source) {
    constexpr std::size_t looked_at = 4096;
    std::string_view text(reinterpret_cast<const char*>(source.bytes.data()), std::min(looked_at, source.bytes.size()));
    std::size_t blocks = 0, lines = 0;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, end);
        const bool is_text =
            std::none_of(line.begin(), line.end(), [](char c) { return c >= 0 && c < ' ' && c != '\t' && c != '\r'; });
        if (!is_text) return false;
        ++lines;
        blocks += looks_like_block(line) ? 1 : 0;
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines > 0 && blocks * 5 > lines * 4;
}

Program read_program(const std::string& path, const ProgramOptions& options) {
    return read_program(open_source(path), options);
}

Program read_program(const Source& source, const ProgramOptions& options) {
    const InterpreterOptions how = interpreter_options(source, options);
    Program program = parse_program(source_text(source), how);
    if (options.coordinates) (void)place_motions(program, {}, *options.coordinates);
    return program;
}

std::unique_ptr<ProgramReader> open_program(const Source& source, const ProgramOptions& options) {
    const InterpreterOptions how = interpreter_options(source, options);
    return std::make_unique<ProgramReader>(source_text(source), how);
}

}  // namespace clsurf::io
