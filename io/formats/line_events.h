#pragma once
// Block events that are recorded separately from the samples: from some time on, a line of a program is active.
// Used inside io only.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/point.h"

namespace clsurf::io {

struct LineEvent {
    double at = 0;  ///< record, cycle or time, in the unit of the samples' clock
    LineNumber line = 0;
    std::uint32_t program = 0;  ///< index into the log's programs
};

/// Calls `visit(point, event)` for each point in order with the last event at or before it, nullptr
/// before the first event. Sorts `events`; of several events at the same time the last one counts.
/// If `at(point)` decreases (a clock that restarts or jitters), the event is searched again. A NaN gets the event of the
/// previous point. O(points + events), and O(log events) for every decrease.
/// Returns how many events are after the last point or, except for the last of them, before the first point.
template <typename At, typename Visit>
std::size_t for_each_event(std::vector<LineEvent>& events, PointIndex points, const At& at, const Visit& visit) {
    std::stable_sort(events.begin(), events.end(), [](const LineEvent& a, const LineEvent& b) { return a.at < b.at; });
    std::size_t next = 0;
    std::size_t first_used = events.size();
    std::size_t end_used = 0;
    double before = 0;
    for (PointIndex i = 0; i < points; ++i) {
        const double now = at(i);
        if (i > 0 && now < before) {
            const auto after = std::upper_bound(events.begin(), events.end(), now,
                                                [](double t, const LineEvent& event) { return t < event.at; });
            next = static_cast<std::size_t>(after - events.begin());
        }
        if (std::isfinite(now)) before = now;
        while (next < events.size() && events[next].at <= now) ++next;
        visit(i, next > 0 ? &events[next - 1] : nullptr);
        if (i == 0) first_used = next > 0 ? next - 1 : 0;
        end_used = std::max(end_used, next);
    }
    return points == 0 ? events.size() : first_used + (events.size() - end_used);
}

}  // namespace clsurf::io
