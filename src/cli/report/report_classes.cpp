#include "cli/report/report_classes.h"

#include <algorithm>

#include "viz/field_classes.h"

namespace clsurf::cli {
namespace {

/// The classes of one log that have their own colour, without shares.
std::vector<io::PageClass> named_classes(const FieldInfo& info, const viz::ValueCounts& counts) {
    const viz::FieldClasses classes(info, counts);
    const double unit = info.unit.per_inside;
    std::vector<io::PageClass> named;
    for (const FieldClass& known : info.classes)
        named.push_back({known.name, known.value * unit, classes.rgb_of(known.value), 0});
    for (const viz::ShownClass& shown : classes.shown()) {
        const bool of_one_value = shown.value == shown.value;
        if (of_one_value && std::ranges::find(info.classes, shown.value, &FieldClass::value) == info.classes.end())
            named.push_back({shown.name, shown.value * unit, shown.rgb, 0});
    }
    return named;
}

/// Adds their shares in one log, in decreasing order.
std::vector<io::PageClass> with_shares(std::vector<io::PageClass> named, const FieldInfo& info,
                                       const viz::ValueCounts& counts) {
    double all = 0;
    for (const auto& [value, count] : counts) all += static_cast<double>(count);
    for (const auto& [value, count] : counts) {
        const double shown = value * info.unit.per_inside;
        for (io::PageClass& c : named) {
            if (c.value == shown) c.share = static_cast<double>(count) / all;
        }
    }
    std::stable_sort(named.begin(), named.end(),
                     [](const io::PageClass& a, const io::PageClass& b) { return a.share > b.share; });
    return named;
}

}  // namespace

void name_classes(std::vector<ReportLog>& logs) {
    const ReportLog& first = logs.front();
    for (std::size_t k = 0; k < first.fields.size(); ++k) {
        const FieldInfo& info = first.fields[k].info;
        std::vector<io::PageClass> named;
        for (ReportLog& log : logs) {
            if (!has_classes(info)) {
                log.classes.emplace_back();
                continue;
            }
            const viz::ValueCounts counts = viz::count_values(log.fields[k].values, log.surface.passes);
            if (&log == &first) named = named_classes(info, counts);
            log.classes.push_back(with_shares(named, info, counts));
        }
    }
}

}  // namespace clsurf::cli
