#pragma once
// DefectMap: what `render --defects` marks: the sections of passes at fault, and their names in a column beside the part.

#include <string>
#include <vector>

#include "core/geometry.h"
#include "core/point.h"
#include "viz/colour_map.h"

namespace clsurf::viz {

/// How the sections of a kind of defect are drawn, besides their colour.
enum class StrokeStyle : std::uint8_t { solid, dashed, double_line, dotted };

/// What a defect differs in, for the key below the names.
struct DefectKind {
    std::string name;  ///< "speed"
    Rgb rgb{0, 0, 0};
    StrokeStyle style = StrokeStyle::solid;
};

struct DefectMark {
    std::vector<PointRange> sections;  ///< of the passes at fault
    std::size_t kind = 0;              ///< index into DefectMap::kinds
    double strength = 1;               ///< 0 light … 1 dark
    bool region = false;               ///< thin lines, a hatched region: many passes together
    std::string number;                ///< "4"
    std::string label;                 ///< "−87 % speed"
    std::string lines;                 ///< "lines 3065–3228"
    std::string place = {};            ///< "X 1.5  Y −4.7  Z 4.9"; said where there is room
    std::string cause = {};            ///< likewise
};

struct DefectMap {
    std::vector<DefectKind> kinds;
    std::vector<DefectMark> marks;  ///< the strongest first
};

/// Most defects that are named beside the part.
inline constexpr std::size_t most_named_defects = 12;

/// For each anchor the slot of its label, so that no two lines from anchors to slots cross. `anchors` [px], `slots`: heights
/// [px] at `slot_x`, as many as anchors, all anchors on one side of slot_x. O(n³) steps at most for n anchors in practice.
[[nodiscard]] std::vector<std::size_t> assign_slots(const std::vector<Vec2>& anchors, const std::vector<double>& slots,
                                                    double slot_x);

/// Where a column of `height` [px] begins so that it is beside its anchors, in a room from `lowest` to `highest` [px]. Domain:
/// the column fits.
[[nodiscard]] double top_of_names(const std::vector<Vec2>& anchors, double height, double lowest, double highest);

}  // namespace clsurf::viz
