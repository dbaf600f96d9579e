#pragma once
// A log made from columns.

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "log/channel.h"
#include "log/log.h"

namespace clsurf::test {

using NamedColumns = std::vector<std::pair<std::string, std::vector<double>>>;

/// Units are those of the names; all columns have the same length.
inline Log log_of_columns(double period, NamedColumns made) {
    const auto columns = std::make_shared<const NamedColumns>(std::move(made));
    Log log;
    log.name = "made";
    log.period = period;
    log.records = static_cast<PointIndex>(columns->front().second.size());
    for (const auto& [name, values] : *columns) {
        const bool is_rotary = is_position(name) && name.back() < 'x';
        log.channels.push_back({name, is_rotary ? "deg" : is_position(name) ? "mm" : "", view_of(values)});
    }
    log.keep_alive = columns;
    return log;
}

}  // namespace clsurf::test
