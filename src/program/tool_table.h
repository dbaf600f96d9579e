#pragma once
// ToolTable: lengths and diameters of tools, as a controller stores them separately from its programs.

#include <map>
#include <string>

#include "core/geometry.h"
#include "core/units.h"

namespace clsurf {

struct Tool {
    int number = 0;                          ///< 0: none
    Vec3 offset = Vec3::Zero();              ///< [mm], subtracted by G43
    double diameter = 0;                     ///< [mm]
    double front_angle = 0, back_angle = 0;  ///< of a lathe tool [deg]
    int orientation = 0;                     ///< of a lathe tool, 0 … 9
    bool assumed = false;                    ///< from a default table: the machine's own differs
    std::string remark{};                    ///< the text after ';'
};

struct ToolTable {
    std::map<int, Tool> tools;  ///< by number
    double unit_mm = 1;         ///< unit of the controller's #5401 … and #5161 … [mm]

    /// nullptr if there is no such tool.
    [[nodiscard]] const Tool* find(int number) const {
        const auto found = tools.find(number);
        return found == tools.end() ? nullptr : &found->second;
    }
};

/// The table of LinuxCNC's stand-alone interpreter `rs274` if it is given none: three tools, inches.
[[nodiscard]] ToolTable stand_alone_tools();

}  // namespace clsurf
