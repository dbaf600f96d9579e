#pragma once
// Fields of a part: those of the field table, the log's channels and the predictor's, by one name.

#include <memory>
#include <string_view>
#include <vector>

#include "field/field_set.h"
#include "pipeline/part.h"
#include "predictor/signals.h"

namespace clsurf::cli {

class Fields {
public:
    /// Both must outlive it.
    Fields(const Part& part, const ClSurface& surface)
        : part_(part),
          surface_(surface),
          set_(part.log, part.path, surface.passes, {estimate_motion(part, surface.passes), 0}) {}

    /// One value per point. Throws UsageError: unknown (with a suggestion), or the log lacks what it needs.
    [[nodiscard]] Field get(std::string_view asked);

private:
    /// Planned speeds of the program's constant-speed intervals, at the points of their lines.
    [[nodiscard]] Field interval_field() const;

    const Part& part_;
    const ClSurface& surface_;
    FieldSet set_;
    std::unique_ptr<Signals> signals_;  ///< derived when the first field needs them
};

/// The field that people mean by another word ("mismatch", "accel"); `name` itself where it is none of these, or a
/// channel of the log.
[[nodiscard]] std::string_view usual_name(std::string_view name, const Log& log);

/// All of them by name; with a log its channels too.
[[nodiscard]] std::vector<FieldInfo> all_fields(const Log* log);

}  // namespace clsurf::cli
