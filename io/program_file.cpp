#include "io/program_file.h"

#include <array>
#include <filesystem>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "core/spelling.h"
#include "io/compressed.h"
#include "io/tool_table_file.h"
#include "program/interpreter.h"

namespace clsurf::io {
namespace {

SourceText source_text(const Source& source) { return {source.name, source.text(), source.keep_alive}; }

/// Subprograms stand beside the program under their name, as the controls write it.
std::optional<SourceText> load_beside(const std::filesystem::path& folder, const std::string& name) {
    static constexpr std::array<std::string_view, 12> endings{"",     ".ngc", ".nc",  ".NC", ".spf", ".SPF",
                                                              ".mpf", ".MPF", ".tap", ".i",  ".I",   ".txt"};
    // A name with a path would leave the folder.
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
    options.load = [folder](const std::string& name) { return load_beside(folder.empty() ? "." : folder, name); };
    if (source.bytes.empty()) throw InputError(Place::of_file(source.name), "is empty, expected an NC program");
    return options;
}

}  // namespace

Program read_program(const std::string& path, const ProgramOptions& options) {
    return read_program(open_source(path), options);
}

Program read_program(const Source& source, const ProgramOptions& options) {
    const InterpreterOptions how = interpreter_options(source, options);
    return parse_program(source_text(source), how);
}

std::unique_ptr<ProgramReader> open_program(const Source& source, const ProgramOptions& options) {
    const InterpreterOptions how = interpreter_options(source, options);
    return std::make_unique<ProgramReader>(source_text(source), how);
}

}  // namespace clsurf::io
