#pragma once
// Cutter compensation, G41 and G42: from the programmed path to the path of the tool's centre, in the working plane. The
// end of a motion is only known with the next motion: an inside corner moves it back. Rules: LinuxCNC, "Cutter
// compensation"; RS274/NGC (NIST IR 6556), appendix B.

#include <cstddef>
#include <string>
#include <vector>

#include "core/geometry.h"

namespace clsurf {

/// A motion of the tool's centre in the plane. An arc has the centre `centre`.
struct CompensatedMove {
    Vec2 end;  ///< [mm]
    Vec2 centre = Vec2::Zero();
    bool is_arc = false;
    bool counter_clockwise = false;
};

/// The compensated form of a programmed motion.
struct CompensatedStep {
    bool moves_corner =
        false;  ///< all motions of the previous step (and those of zero length after it) end at `corner`
    Vec2 corner = Vec2::Zero();          ///< [mm]
    std::vector<CompensatedMove> moves;  ///< around an outside corner first, then the motion itself
    std::string error;                   ///< not empty: the reason why the tool cannot move there
};

class CutterCompensation {
public:
    /// Begins compensation; `left`: the tool is to the left of the path. A negative radius changes the side, a zero
    /// radius has no effect. [mm]
    void start(bool left, double radius);
    void stop();
    /// Begins next to a point instead of with an entry move; returns the tool's centre there.
    Vec2 enter_at_offset(const Vec2& from, const Vec2& direction);

    [[nodiscard]] bool on() const { return on_; }  ///< G41 or G42, with any radius
    [[nodiscard]] bool left() const { return left_; }
    [[nodiscard]] bool active() const { return on_ && radius_ > 0; }
    [[nodiscard]] bool entered() const { return active() && !first_; }  ///< the entry move has been made
    /// The tool's centre and the programmed point [mm]. Only after the entry move.
    [[nodiscard]] const Vec2& centre() const { return centre_; }

    /// A straight motion between programmed points.
    [[nodiscard]] CompensatedStep line(const Vec2& from, const Vec2& to);
    /// A circular motion about `centre`.
    [[nodiscard]] CompensatedStep arc(const Vec2& from, const Vec2& to, const Vec2& centre, bool counter_clockwise);
    /// Ends: an error if the end of the last motion cannot be reached; empty: none.
    [[nodiscard]] std::string finish();

private:
    /// The motion whose end is still open.
    struct Open {
        bool valid = false;
        bool is_arc = false;
        Vec2 begin = Vec2::Zero();         ///< of the tool's centre
        Vec2 offset_begin = Vec2::Zero();  ///< the tool's centre next to the programmed beginning
        Vec2 direction = Vec2::Zero();     ///< of the programmed line
        Vec2 centre = Vec2::Zero();
        double radius = 0;  ///< of the tool centre's arc
        double sweep = 0;   ///< of the programmed arc [rad], positive
        bool counter_clockwise = false;
    };
    [[nodiscard]] double side() const { return left_ ? 1.0 : -1.0; }
    [[nodiscard]] bool inside(bool counter_clockwise) const { return counter_clockwise == left_; }
    [[nodiscard]] CompensatedStep entry_line(const Vec2& from, const Vec2& to);
    [[nodiscard]] CompensatedStep entry_arc(const Vec2& from, const Vec2& to, const Vec2& centre,
                                            bool counter_clockwise);
    /// Joins the open motion to one that starts at `corner` in direction `tangent`.
    void join(CompensatedStep& step, const Vec2& corner, const Vec2& tangent, Open& next);
    [[nodiscard]] bool inside_corner(double angle, const Open& next) const;
    [[nodiscard]] bool meet(const Vec2& corner, const Open& next, CompensatedStep& step) const;
    [[nodiscard]] std::string check_reach(const Vec2& end) const;

    bool on_ = false, left_ = false, first_ = true;
    double radius_ = 0;
    Vec2 centre_ = Vec2::Zero();
    Open open_;
};

}  // namespace clsurf
