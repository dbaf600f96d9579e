#pragma once
// Defect: a place where a pass differs from its neighbours enough to leave a mark. Also the report of all defects of a part.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/block_fill.h"
#include "core/cutter_place.h"
#include "predictor/judgement.h"
#include "predictor/mismatch.h"
#include "predictor/severity.h"

namespace clsurf {

enum class Cause : std::uint8_t {
    feed_drop,       ///< slower (or faster) than its neighbours over a section
    oscillation,     ///< the speed oscillates about the neighbours' speed
    lag_step,        ///< the axes deviate from the commanded path differently from adjacent passes
    point_spacing,   ///< the program's own points differ from those of adjacent passes
    corner,          ///< the programmed path turns there
    reversal,        ///< an axis reverses there
    pass_end,        ///< the pass begins or ends there
    path_tolerance,  ///< the controller deviates from the programmed path differently from adjacent passes
};
inline constexpr int cause_count = static_cast<int>(Cause::path_tolerance) + 1;
[[nodiscard]] std::string_view name_of(Cause cause);         ///< "feed_drop"
[[nodiscard]] std::string_view description_of(Cause cause);  ///< "slower than its neighbours"

/// A section of one pass.
struct DefectSection {
    std::int64_t pass = 0;  ///< number of the cut pass, from 1
    PointRange points;
    LineNumber first_line = 0, last_line = 0;  ///< of these points, in the main program; 0: no line
    /// Set if a subprogram in its own file runs there: the file and its lines. first_line and last_line then call it.
    std::string file = {};
    LineNumber file_first_line = 0, file_last_line = 0;
};

/// How far the measured position of an axis trails the commanded one.
struct AxisDelay {
    char axis = 'x';
    double delay = 0;  ///< [s] following error over speed
};

struct Defect {
    int severity = 1;  ///< 1 to 4 (severity.h)
    Cause cause = Cause::feed_drop;
    Quantity quantity = Quantity::speed;  ///< quantity in which the defect is strongest
    float score = 0;                      ///< peak over threshold
    bool systematic = false;              ///< lag that alternates with the direction of travel (systematic_lag.h)
    double share = 0;                     ///< of a systematic defect: share of the path of all cut passes, 0 … 1
    std::vector<AxisDelay> delays;  ///< of a systematic defect: the axes that differ, slowest first; empty: not known
    CutterPlace place;              ///< place where it is strongest; the contact point if the tool is known
    PointIndex point = 0;           ///< point at that place
    Box3 bounds;                    ///< [mm] of tips
    Box3 contact_bounds;            ///< [mm] of contact points; empty: not known
    double area = 0;                ///< [mm²]
    double length = 0;              ///< [mm] along the feed, of the longest run
    double depth = 0;               ///< [mm] ≥ 0, predicted step against the neighbours along the normal
    bool pit = false;               ///< below its neighbours; else a bulge, which the neighbours cut down again
    double speed = 0;               ///< [mm/s] where it is strongest
    double adjacent_speed = 0;      ///< [mm/s] of the adjacent passes at the same place
    double speed_jump = 0;          ///< [mm/s] signed, against the neighbours
    double speed_mismatch = 0;      ///< the same relative to the neighbours' speed, ≥ −1
    double acceleration_jump = 0;   ///< [mm/s²] ≥ 0
    std::vector<DefectSection> sections;    ///< sections on the causing passes, in the order of their points
    std::vector<DefectSection> neighbours;  ///< sections on the adjacent clean passes
};

/// The section where a defect is strongest. Of a defect with many sections only the longest are stored; if none of these
/// contains that place, the first one is returned. nullptr: there is no section.
[[nodiscard]] const DefectSection* strongest_section(const Defect& defect);
/// All sections in the order for readers: the strongest first, then the others in the order of their points.
[[nodiscard]] std::vector<DefectSection> strongest_first(const Defect& defect);

/// How a mark differs from the adjacent passes: a pit is deep, a bulge is high.
[[nodiscard]] constexpr std::string_view deep_or_high(bool pit) { return pit ? "deep" : "high"; }

/// Findings in the shards of a log, before defects are built.
struct FoundInShards {
    ComparedPoints points;           ///< count_compared() of all points
    std::vector<PointIndex> starts;  ///< find_starts() of all points, in order
    std::vector<double> scallops;    ///< [mm] scallop_heights() of all points (machined/as_machined_report.h)
    ForgetBlocks forget;             ///< forgets positions and signals that are derived when they are read
};

struct QualityRules {
    ThresholdRule thresholds;
    std::optional<Thresholds> fixed;  ///< thresholds of another run, used instead of the run's own
    SeverityRule severity;
    std::optional<FoundInShards> found;  ///< findings in the whole log; nullopt: they are computed
};

struct QualityReport {
    std::vector<Defect> defects;   ///< in falling order of score
    std::vector<Defect> expected;  ///< differences at the outermost passes, which every border of a part has
    Thresholds thresholds;
    PointIndex points = 0;          ///< number of points of cut passes
    PointIndex away_from_ends = 0;  ///< number of them away from the ends of their passes
    PointIndex compared = 0;        ///< number of these with a neighbour on both sides
    PointIndex not_finishing = 0;   ///< cutting points of pockets, drilling, single contours: not compared
    std::int64_t passes = 0;        ///< cut passes
    double step_over = 0;           ///< [mm]
    bool has_lag = false;           ///< measured positions were given
    Judgement judgement;            ///< whether the data allow a verdict
    std::string note;               ///< the windows

    [[nodiscard]] double coverage() const {
        return points > 0 ? static_cast<double>(compared) / static_cast<double>(points) : 0;
    }  ///< 0 … 1
    /// Share of the cutting points that belong to no finishing pass, 0 … 1.
    [[nodiscard]] double not_finishing_share() const {
        return not_finishing > 0 ? static_cast<double>(not_finishing) / static_cast<double>(points + not_finishing) : 0;
    }
    [[nodiscard]] int worst_severity() const;  ///< 0: no defects
    /// The sections of all defects on the passes that cause them, defect by defect.
    [[nodiscard]] std::vector<PointRange> sections() const;
};

}  // namespace clsurf
