#include "limits/limit_report.h"

#include <algorithm>

#include "core/not_finite.h"

namespace clsurf {

double LimitReport::greatest_factor() const {
    if (!findings.empty()) return findings.front().factor;
    double greatest = missing<double>;
    for (const JudgedLimit& limit : judged) {
        if (!(greatest >= limit.factor)) greatest = limit.factor;
    }
    return greatest > 1 ? 1.0 : greatest;  // exceeded by at most its uncertainty
}

std::string_view name_of(LimitedQuantity quantity) { return row_of(quantity).name; }

std::string axis_name(const StatedLimit& limit) { return limit.axis == 0 ? "path" : std::string(1, limit.axis); }

const Unit& unit_of(const StatedLimit& limit) {
    const LimitTableRow& row = row_of(limit.quantity);
    return limit.axis != 0 && limit.axis < 'x' ? row.rotary_unit : row.unit;
}

std::string words_of(const StatedLimit& limit) {
    std::string words(name_of(limit.quantity));
    std::replace(words.begin(), words.end(), '_', ' ');
    if (limit.quantity == LimitedQuantity::tolerance) return "distance from the programmed path";
    if (words.starts_with("path ")) words.erase(0, 5);
    return words + (limit.axis == 0 ? " of the path" : std::string(" of ") + limit.axis);
}

void sort_findings(std::vector<LimitFinding>& findings) {
    std::sort(findings.begin(), findings.end(), [](const LimitFinding& a, const LimitFinding& b) {
        return a.factor != b.factor ? a.factor > b.factor : a.point < b.point;
    });
}

}  // namespace clsurf
