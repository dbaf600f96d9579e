#pragma once
// BlockStream: the motions of a program as path elements, in sections between two exact stops. Each stage that
// shapes the path before PathStream reads its elements from such a source and is one itself.

#include <vector>

#include "core/geometry.h"
#include "machine/machine.h"
#include "program/event_cursor.h"
#include "program/motion_source.h"
#include "simulation/path/path_element.h"

namespace clsurf {

/// Elements of a section in order; each begins where the one before ends.
class ElementSource {
public:
    ElementSource() = default;
    ElementSource(const ElementSource&) = delete;
    ElementSource& operator=(const ElementSource&) = delete;
    virtual ~ElementSource() = default;
    /// False: the section has no more. Throws InputError.
    [[nodiscard]] virtual bool next(PathElement& element) = 0;
};

/// Where sections end.
enum class Stops : std::uint8_t {
    at_corners,  ///< also at corners of an exact path and at reversals
    programmed,  ///< at dwells only: how blocks end is for the planner to decide
};

class BlockStream final : public ElementSource {
public:
    /// Both must outlive it; the source is at its begin. `start`: where the axes stand; coordinates that the
    /// program has not set stay there [mm].
    BlockStream(MotionSource& source, const Machine& machine, const Vec3& start, Stops stops = Stops::at_corners);

    /// Goes to the next section. False: the program has ended.
    /// Throws InputError (feed 0, rotary axes).
    [[nodiscard]] bool begin_section();
    [[nodiscard]] bool next(PathElement& element) override;

    /// Wait after the section [s]; this and what follows is known when next() has returned false.
    [[nodiscard]] double dwell() const { return dwell_; }
    /// Line of the dwell; 0: none.
    [[nodiscard]] LineNumber dwell_line() const { return dwell_line_; }
    [[nodiscard]] const Vec3& section_end() const { return section_end_; }

    /// Part of the program's motions taken so far.
    [[nodiscard]] double done() const;
    /// Where the axes stand before the first section.
    [[nodiscard]] const Vec3& position() const { return at_; }

private:
    [[nodiscard]] bool read(PathElement& element);
    [[nodiscard]] bool divide(const PathElement& whole);
    void take_part(PathElement& element);
    [[nodiscard]] bool at_a_motion();
    [[nodiscard]] bool turns(const Motions& motions, std::size_t motion);
    [[nodiscard]] bool stops_between(const PathElement& before, const PathElement& after) const;
    void follow_events(std::int64_t motion);
    void take(const PathMode& mode);
    void take_dwell();

    MotionSource* source_;
    const Machine* machine_;
    Vec3 at_;                                          ///< end of the last element read
    std::int64_t next_motion_ = 0, taken_before_ = 0;  ///< in the piece at hand, and in those before
    EventCursor events_;                               ///< of the piece
    std::int64_t blocks_ = 0;
    Xyz rotary_;  ///< of the last motion [rad]
    Stops section_ends_;
    double tolerance_ = 0;            ///< in force; 0: exact path
    double merging_tolerance_ = 0;    ///< in force
    bool stops_ = false;              ///< at the end of every block
    std::vector<PathElement> parts_;  ///< of a curve with cusps, those that are still to come; the next one last
    bool waiting_ = false;            ///< an element is read that begins the next section
    PathElement waiting_element_, last_;
    bool begun_ = false;  ///< last_ is of this section
    bool closed_ = true;
    Vec3 section_end_;
    double dwell_ = 0, pending_dwell_ = 0;  ///< the second: met before the next element
    LineNumber dwell_line_ = 0, pending_dwell_line_ = 0;
};

}  // namespace clsurf
