#include "cli/report_classes.h"

#include <algorithm>
#include <map>

#include "viz/field_classes.h"

namespace clsurf::cli {
namespace {

using ValueCounts = std::map<float, PointIndex>;

/// The classes of one log that have a colour of their own, without shares.
std::vector<io::PageClass> named_classes(const Field& field, const Passes& passes, const ValueCounts& counts) {
    const viz::FieldClasses classes(field.info, field.values, passes);
    const double unit = field.info.unit.per_inside;
    // The others, which have no colour of their own, stand last.
    const std::vector<viz::ShownClass>& shown = classes.shown();
    const auto end = shown.end() - (shown.size() > viz::FieldClasses::most_named ? 1 : 0);
    std::vector<io::PageClass> named;
    for (const FieldClass& known : field.info.classes)
        named.push_back({known.name, known.value * unit, classes.rgb_of(known.value), 0});
    for (const auto& [value, count] : counts) {
        const viz::Rgb rgb = classes.rgb_of(value);
        const auto taken = [&](const io::PageClass& c) { return c.rgb == rgb; };
        if (std::any_of(named.begin(), named.end(), taken)) continue;
        const auto found = std::find_if(shown.begin(), end, [&](const viz::ShownClass& c) { return c.rgb == rgb; });
        if (found != end) named.push_back({found->name, value * unit, rgb, 0});
    }
    return named;
}

/// With their shares in one log, the largest first.
std::vector<io::PageClass> with_shares(std::vector<io::PageClass> named, const FieldInfo& info,
                                       const ValueCounts& counts) {
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
            const ValueCounts counts = viz::count_values(log.fields[k].values, log.surface.passes);
            if (&log == &first) named = named_classes(first.fields[k], first.surface.passes, counts);
            log.classes.push_back(with_shares(named, info, counts));
        }
    }
}

}  // namespace clsurf::cli
