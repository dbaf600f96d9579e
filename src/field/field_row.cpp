#include "field/field_row.h"

#include <bit>
#include <stdexcept>

#include <fmt/format.h>

namespace clsurf {
namespace {

constexpr std::array<std::string_view, needs::kinds> need_names{
    "position",       "velocity",           "acceleration", "jerk", "commanded positions", "measured positions",
    "velocity sigma", "acceleration sigma", "jerk sigma",   "time", "position sigma",      "curvature"};

std::size_t index_of(unsigned need) { return static_cast<std::size_t>(std::countr_zero(need)); }

}  // namespace

const FieldBlock::Vector& FieldBlock::at(unsigned need) const {
    const Vector& columns = columns_.at(index_of(need));
    if (columns[0] == nullptr)
        throw std::logic_error(
            fmt::format("field '{}' reads {}, which its row does not need", row_->name, need_names.at(index_of(need))));
    return columns;
}

const FieldBlock::Vector& FieldBlock::vector(unsigned need) const {
    const Vector& columns = at(need);
    if (columns[1] == nullptr || columns[2] == nullptr)
        throw std::logic_error(fmt::format("field '{}' reads three components of {}, which has one", row_->name,
                                           need_names.at(index_of(need))));
    return columns;
}

const double* FieldBlock::component(unsigned need) const {
    const std::size_t axis = row_->subject == FieldSubject::rotary_axis ? 0 : std::string_view("xyz").find(row_->axis);
    if (axis == std::string_view::npos)
        throw std::logic_error(fmt::format("field '{}' reads a component, but its row names no axis", row_->name));
    return axis == 0 ? at(need)[0] : vector(need)[axis];
}

const double* FieldBlock::scalar(unsigned need) const { return at(need)[0]; }

void FieldBlock::set(unsigned need, const Vector& columns) { columns_.at(index_of(need)) = columns; }

FieldInfo info_of(const FieldRow& row) {
    FieldInfo info{std::string(row.name), std::string(row.label), row.unit, row.scale, {}};
    info.axis = row.axis;
    for (const std::string_view word : row.also) {
        if (!word.empty()) info.also.emplace_back(word);
    }
    info.report_rank = row.report_rank;
    info.percentiles = row.percentiles;
    info.preference = row.preference;
    info.least_span_of_median = row.least_span_of_median;
    return info;
}

int derivative_of(const FieldRow& row) {
    for (int d = 3; d >= 1; --d) {
        if ((row.needs & ((needs::velocity | needs::velocity_sigma) << (d - 1))) != 0) return d;
    }
    return 0;
}

}  // namespace clsurf
