#pragma once
// Tool centre point control: whether a program's positions are those of the tool's tip in the workpiece
// (G43.4, G43.5, TRAORI, M128; a tilted plane of G68.2 or CYCLE800) or of the machine's axes (G49, TRAFOOF,
// M129, G69).

#include <cstdint>
#include <variant>

#include "program/event_cursor.h"
#include "program/program.h"

namespace clsurf {

/// Goes through the events of a program. Programs begin with it off.
class ToolCentrePoint {
public:
    explicit ToolCentrePoint(const Program& program) : program_(&program) {}

    /// Whether it is on at a motion; motions must be in ascending order.
    [[nodiscard]] bool on(std::int64_t motion) {
        cursor_.pass(program_->events, motion, [&](const ProgramEvent& event) {
            if (const auto* control = std::get_if<ToolCentrePointControl>(&event.meaning)) on_ = control->on;
        });
        return on_;
    }

private:
    const Program* program_;
    EventCursor cursor_;
    bool on_ = false;
};

}  // namespace clsurf
