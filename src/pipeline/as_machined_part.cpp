#include "pipeline/as_machined_part.h"

#include "pipeline/judge.h"

namespace clsurf {

AsMachinedPart::AsMachinedPart(const Part& part, const ClSurface& surface, std::optional<Role> role,
                               const CuttingTool& tool, const QualityReport* report)
    : upright_(upright_part(part.log, part.path, *part.lines, role, tool)) {
    if (!upright_ || report == nullptr) read_ = signals_of(part, surface, role);
    QualityReport found;
    if (report == nullptr) {
        found = find_defects(part, surface, read_);
        report = &found;
    }
    if (upright_) read_ = {};
    const ToolRun run = upright_ ? upright_->run() : ToolRun{part.path, surface, read_};
    as_machined_.emplace(run.as_machined(tool, report));
}

}  // namespace clsurf
