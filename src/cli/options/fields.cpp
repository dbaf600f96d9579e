#include "cli/options/fields.h"

#include "pipeline/part_fields.h"

namespace clsurf::cli {

std::vector<FieldInfo> known_fields() {
    // An empty part has the same providers, but no channels.
    const Part part;
    const ClSurface surface;
    return fields_of(part, surface).fields();
}

}  // namespace clsurf::cli
