// clsurf manual: man pages, completion and docs/reference, generated from the program's own
// tables. A test compares docs/reference with this output.

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/manual/completion.h"
#include "cli/manual/manual_man.h"
#include "cli/manual/manual_markdown.h"
#include "cli/options/options.h"
#include "cli/options/vocabulary.h"
#include "io/files/atomic_file.h"

namespace clsurf::cli {
namespace {

constexpr std::string_view manual_forms = "man|bash|zsh|fish|markdown";

void write_file(const std::filesystem::path& path, const std::string& text) {
    io::AtomicFile file(path.string());
    file.write(text);
    file.commit();
}

void write_files(const std::filesystem::path& folder, const std::vector<ManualFile>& files) {
    for (const ManualFile& file : files) write_file(folder / file.name, file.text);
}

ExitCode run_manual(const po::variables_map& values) {
    const std::string form = required(values, "FORM");
    const std::filesystem::path folder = required(values, "output");
    const std::vector<std::string> forms = words_of(manual_forms);
    if (std::find(forms.begin(), forms.end(), form) == forms.end())
        throw UsageError("'" + form + "' is not one of " + std::string(manual_forms));
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw SystemError("cannot make folder '" + folder.string() + "': " + error.message());
    if (form == "man") write_files(folder, man_pages());
    if (form == "bash") write_file(folder / "clsurf", bash_completion());
    if (form == "zsh") write_file(folder / "_clsurf", zsh_completion());
    if (form == "fish") write_file(folder / "clsurf.fish", fish_completion());
    if (form == "markdown") write_files(folder, reference_pages());
    return ExitCode::done;
}

}  // namespace

Subcommand manual_subcommand() {
    return {
        .name = "manual",
        .arguments = manual_forms,
        .summary = "man pages, completion or docs/reference, written from the option tables",
        .description = "A tool of the build. Files that a folder holds already are replaced.",
        .declare =
            [](po::options_description& options) {
                options.add_options()("output,o", po::value<std::string>()->value_name("FOLDER"),
                                      "where to write; made when it is not there");
            },
        .positional = {"FORM"},
        .run = run_manual,
        .hidden = true,
    };
}

}  // namespace clsurf::cli
