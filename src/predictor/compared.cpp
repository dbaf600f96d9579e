#include "predictor/compared.h"

namespace clsurf {

std::string_view name_of(Quantity quantity) {
    switch (quantity) {
        case Quantity::speed: return "speed";
        case Quantity::acceleration: return "acceleration";
        case Quantity::normal_deviation: return "lag";
        case Quantity::relief: return "relief";
    }
    return "";
}

Compared compared_at(const Signals& signals, const PathLocation& at, const Eigen::Vector3f& normal) {
    const Sample& a = signals[at.point];
    Compared result{a.speed, a.normal_deviation, a.relief, vector_of(a.acceleration)};
    if (at.fraction > 0) {
        const Sample& b = signals[at.point + 1];
        result.speed += at.fraction * (b.speed - a.speed);
        result.normal_deviation += at.fraction * (b.normal_deviation - a.normal_deviation);
        result.relief += at.fraction * (b.relief - a.relief);
        result.acceleration += at.fraction * (vector_of(b.acceleration) - vector_of(a.acceleration));
    }
    if (signals.normal(at.nearest()).dot(normal) < 0) {
        result.normal_deviation = -result.normal_deviation;
        result.relief = -result.relief;
    }
    return result;
}

}  // namespace clsurf
