#include "history/run_record.h"

#include <algorithm>

#include "core/error.h"

namespace clsurf {

const std::string* RunRecord::parameter(std::string_view name) const {
    const auto at = std::ranges::find(parameters, name, &RunParameter::name);
    return at == parameters.end() ? nullptr : &at->value;
}

std::string identity_text(const RunRecord& run) {
    // A file that could not be read has no hash: its name is used instead.
    const auto file = [](const std::string& hash, const std::string& name) {
        return hash.empty() ? "name " + name : "sha256 " + hash;
    };
    std::string text = file(run.program_sha256, run.program) + "\n" + file(run.log_sha256, run.log) + "\n";
    for (const RunParameter& parameter : run.parameters) text += parameter.name + "=" + parameter.value + "\n";
    return text;
}

bool supersedes(const RunRecord& judged, const RunRecord& failed) {
    if (judged.failed() || !failed.failed()) return false;
    if (failed.program_sha256.empty() ? judged.program != failed.program
                                      : judged.program_sha256 != failed.program_sha256)
        return false;
    if (failed.log_sha256.empty() ? judged.log != failed.log : judged.log_sha256 != failed.log_sha256) return false;
    return std::ranges::all_of(failed.parameters, [&](const RunParameter& p) {
        const std::string* value = judged.parameter(p.name);
        return value != nullptr && *value == p.value;
    });
}

void sort_parameters(std::vector<RunParameter>& parameters) {
    std::ranges::sort(parameters, {}, &RunParameter::name);
    const auto twice = std::ranges::adjacent_find(parameters, {}, &RunParameter::name);
    if (twice != parameters.end()) throw UsageError("--param: '" + twice->name + "' is given more than once");
}

}  // namespace clsurf
