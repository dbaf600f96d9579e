#include "cli/fields.h"

#include "cli/quality.h"
#include "quality/quality_fields.h"

namespace clsurf::cli {

Field Fields::get(std::string_view name) {
    if (is_quality_field(name)) {
        if (!signals_) signals_ = std::make_unique<Signals>(std::move(signals_of(part_, surface_, std::nullopt).signals));
        return quality_field(name, surface_, *signals_);
    }
    if (!set_.has(name)) unknown_field(name, all_fields(&part_.log));
    return set_.get(name);
}

std::vector<FieldInfo> all_fields(const Log* log) {
    std::vector<FieldInfo> fields = known_fields(nullptr);
    for (const FieldInfo& info : quality_fields()) fields.push_back(info);
    if (log == nullptr) return fields;
    const std::vector<FieldInfo> with_channels = known_fields(log);
    fields.insert(fields.end(), with_channels.begin() + static_cast<std::ptrdiff_t>(known_fields(nullptr).size()), with_channels.end());
    return fields;
}

}  // namespace clsurf::cli
