#include "identify/identification.h"

#include <algorithm>
#include <cmath>

namespace clsurf {
namespace {

template <typename Parameters>
auto find_in(const Parameters& parameters, std::string_view name, std::string_view axis)
    -> decltype(parameters.data()) {
    const auto found = std::find_if(parameters.begin(), parameters.end(),
                                    [&](const auto& p) { return p.name == name && p.axis == axis; });
    return found == parameters.end() ? nullptr : &*found;
}

}  // namespace

const IdentifiedParameter* Identification::find(std::string_view name, std::string_view axis) const {
    return find_in(parameters, name, axis);
}

const UnidentifiedParameter* Identification::find_missing(std::string_view name, std::string_view axis) const {
    return find_in(unidentified, name, axis);
}

double rounded_to(double value, double standard_error) {
    if (!(standard_error > 0) || !std::isfinite(standard_error) || !std::isfinite(value)) return value;
    const double decimals = std::clamp(1 - std::floor(std::log10(standard_error)), -6.0, 12.0);
    // Powers of ten below 1 are not exact: division by the integer power keeps 0.1 exactly 0.1.
    const double unit = std::pow(10.0, std::abs(decimals));
    return decimals >= 0 ? std::round(value * unit) / unit : std::round(value / unit) * unit;
}

}  // namespace clsurf
