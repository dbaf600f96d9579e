#pragma once
// BlockStream: the motions of a program as path elements, in sections between two exact stops. Each stage that shapes the
// path before PathStream reads its elements from an ElementSource and is itself one.

#include <vector>

#include "core/geometry.h"
#include "machine/machine.h"
#include "program/event_cursor.h"
#include "program/motion_source.h"
#include "simulation/path/path_element.h"

namespace clsurf {

/// The elements of a section in order; each begins where the previous one ends.
class ElementSource {
public:
    ElementSource() = default;
    ElementSource(const ElementSource&) = delete;
    ElementSource& operator=(const ElementSource&) = delete;
    virtual ~ElementSource() = default;
    /// False: the section has no more elements. Throws InputError.
    [[nodiscard]] virtual bool next(PathElement& element) = 0;
};

/// Where sections end.
enum class Stops : std::uint8_t {
    at_corners,  ///< also at corners of an exact path and at reversals
    programmed,  ///< at dwells only: the planner decides how blocks end
};

class BlockStream final : public ElementSource {
public:
    /// Both references must outlive the object; the source is at its start. `start`: position of the axes; coordinates that
    /// the program has not set keep their values [mm].
    BlockStream(MotionSource& source, const Machine& machine, const Vec3& start, Stops stops = Stops::at_corners);

    /// Goes to the next section. False: the program has ended.
    /// Throws InputError (feed 0, rotary axes).
    [[nodiscard]] bool begin_section();
    [[nodiscard]] bool next(PathElement& element) override;

    /// Dwell time after the section [s]. This and the following functions are valid after next() has returned false.
    [[nodiscard]] double dwell() const { return dwell_; }
    /// Line of the dwell; 0: none.
    [[nodiscard]] LineNumber dwell_line() const { return dwell_line_; }
    [[nodiscard]] const Vec3& section_end() const { return section_end_; }

    /// Share of the program's motions taken so far.
    [[nodiscard]] double done() const;
    /// Position of the axes before the first section.
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
    std::int64_t next_motion_ = 0, taken_before_ = 0;  ///< in the current piece, and in the previous ones
    EventCursor events_;                               ///< of the piece
    std::int64_t blocks_ = 0;
    Xyz rotary_;  ///< of the last motion [rad]
    Stops section_ends_;
    double tolerance_ = 0;            ///< in force; 0: exact path
    double merging_tolerance_ = 0;    ///< in force
    bool stops_ = false;              ///< at the end of every block
    std::vector<PathElement> parts_;  ///< remaining parts of a curve with cusps; the next one is last
    bool waiting_ = false;            ///< the first element of the next section has been read
    PathElement waiting_element_, last_;
    bool begun_ = false;  ///< last_ belongs to this section
    bool closed_ = true;
    Vec3 section_end_;
    double dwell_ = 0, pending_dwell_ = 0;  ///< pending: read before the next element
    LineNumber dwell_line_ = 0, pending_dwell_line_ = 0;
};

}  // namespace clsurf
