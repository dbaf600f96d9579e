#include "io/readers/fitted_machine.h"

#include <memory>
#include <span>

#include "core/error.h"
#include "identify/identify.h"
#include "pipeline/part.h"
#include "pipeline/placement.h"

namespace clsurf::io {

Program TextReader::as_programmed(const std::string& text) const {
    auto bytes = std::make_shared<std::string>(text);
    Source changed = source;
    changed.bytes = std::as_bytes(std::span(bytes->data(), bytes->size()));
    changed.keep_alive = bytes;
    ProgramOptions same = options;
    same.dialect = dialect;
    same.coordinates.reset();
    return read_program(changed, same);
}

Program TextReader::level(const std::string& text) const {
    Program program = as_programmed(text);
    (void)place_motions(program, poses, Coordinates::level);
    return program;
}

Machine fitted_machine(const TextReader& reader, const std::vector<ControllerLog>& logs, const Machine& known,
                       Diagnostics& diagnostics) {
    const auto keep_known = [&](const std::string& reason) {
        diagnostics.add({Severity::warning, "optimize.machine", Place::of_file(logs.back().log.name),
                         "the machine cannot be fitted to the log: " + reason, "give --machine"});
        return known;
    };
    try {
        std::vector<Part> parts;
        for (const ControllerLog& each : logs) {
            PartRules rules;
            rules.poses = reader.poses;
            parts.push_back(assemble(reader.as_programmed(each.text), Log(each.log), rules));
        }
        if (const std::string reason = why_not_simulated(parts, known); !reason.empty()) return keep_known(reason);
        return identify_parts(parts, known).machine;
    } catch (const InputError& error) { return keep_known(error.what()); }
}

}  // namespace clsurf::io
