#include "pipeline/limits_of.h"

#include "limits/judge_limits.h"

namespace clsurf {
namespace {

Trajectory commanded_path(const Part& part) {
    if (part.path.role == Role::commanded || !can_reconstruct_like(part.log, Role::commanded, part.path))
        return part.path;
    return reconstruct_like(part.log, Role::commanded, part.path);
}

}  // namespace

LimitReport judge_limits(const Part& part, std::span<const StatedLimit> limits) {
    const Trajectory path = commanded_path(part);
    return judge_limits(LimitedRun{part.log, path, part.program, *part.lines}, limits);
}

std::shared_ptr<const LimitFields> limit_fields(const Part& part) {
    return std::make_shared<const LimitFields>(part.log, commanded_path(part), part.limits);
}

}  // namespace clsurf
