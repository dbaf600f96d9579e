#include "cli/fields.h"

#include <memory>

#include "intervals/interval_fields.h"
#include "pipeline/part_fields.h"

namespace clsurf::cli {

FieldSet all_fields_of(const Part& part, const ClSurface& surface) {
    return clsurf::fields_of(part, surface, {std::make_shared<const IntervalFields>(part.program, part.lines)});
}

std::vector<FieldInfo> known_fields() {
    // An empty part has the same providers, but no channels.
    const Part part;
    const ClSurface surface;
    return all_fields_of(part, surface).fields();
}

}  // namespace clsurf::cli
