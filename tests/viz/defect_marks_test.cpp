#include "viz/defect_marks.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/stitched_path.h"
#include "viz/scene.h"

namespace clsurf::viz::defect_marks_test {
namespace {

const Rgb white{255, 255, 255};

/// 21 passes of 10 mm along X, from above.
class Part {
public:
    Part() : surface_(test::surface_of(test::zigzag(21, 10, 0.5, 0.1), 0.5)) {
        field_.values = Column<float>(static_cast<std::size_t>(surface_.positions.size()), 1.0F);
    }
    [[nodiscard]] Sheet sheet(const DefectMap& defects) const {
        Look look;
        look.view = parse_view("top");
        look.names = true;
        MapPanel panel;
        panel.surface = &surface_;
        panel.field = &field_;
        panel.defects = &defects;
        return map_sheet({panel}, placed_map({panel}, look), {}, {}, look);
    }

private:
    ClSurface surface_;
    Field field_;
};

DefectMark mark_of(const std::string& number, std::vector<PointRange> sections) {
    DefectMark mark;
    mark.sections = std::move(sections);
    mark.number = number;
    mark.label = "−40 % speed";
    mark.lines = "line " + number;
    return mark;
}

DefectMap map_of(std::vector<DefectMark> marks) {
    DefectMap map;
    map.kinds = {{"speed", {200, 70, 0}, StrokeStyle::solid}};
    map.marks = std::move(marks);
    return map;
}

TEST(DefectMarks, TheCasingOfALeaderIsBelowTheMarks) {
    const Sheet sheet = Part().sheet(map_of({mark_of("1", {{1020, 1060}})}));
    bool cased = false;
    for (const FlatLine& line : sheet.lines) {
        if (line.rgb != white || line.level >= Level::halo) continue;
        cased = true;
        EXPECT_LT(line.level, Level::mark) << "it would erase a mark that the leader runs along";
    }
    EXPECT_TRUE(cased);
}

}  // namespace
}  // namespace clsurf::viz::defect_marks_test
