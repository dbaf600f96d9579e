#include "program/tool_table.h"

namespace clsurf {

ToolTable stand_alone_tools() {
    ToolTable table;
    table.unit_mm = mm_per_inch;
    const auto add = [&](int number, double length, double diameter) {
        Tool& tool = table.tools[number];
        tool.number = number;
        tool.assumed = true;
        tool.offset.z() = length * mm_per_inch;
        tool.diameter = diameter * mm_per_inch;
    };
    add(1, 0.511, 0.125);
    add(2, 0.1, 0.0625);
    add(3, 1.273, 0.201);
    return table;
}

}  // namespace clsurf
