#include "io/reports/defect_fingerprint.h"

#include <cmath>
#include <map>

#include <fmt/format.h>

#include "io/reports/quality_words.h"

namespace clsurf::io {
namespace {

std::string coarse_name(const Defect& d) {
    constexpr double cell = 5;  // [mm]
    const auto coarse = [](double mm) { return static_cast<long>(std::floor(mm / cell)); };
    if (d.systematic) return std::string(rule_of(d).id);
    return fmt::format("{}/{}/{}/{}/{}/{}", name_of(d.cause), name_of(d.quantity),
                       d.sections.empty() ? 0 : d.sections.front().pass, coarse(d.place.tip.x()),
                       coarse(d.place.tip.y()), coarse(d.place.tip.z()));
}

}  // namespace

std::vector<std::string> fingerprints_of(const std::vector<Defect>& defects) {
    std::map<std::string, int> seen;
    std::vector<std::string> names;
    for (const Defect& defect : defects) {
        std::string name = coarse_name(defect);
        const int number = ++seen[name];
        names.push_back(number == 1 ? std::move(name) : fmt::format("{}/{}", name, number));
    }
    return names;
}

}  // namespace clsurf::io
