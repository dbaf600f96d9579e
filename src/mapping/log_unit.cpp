#include "mapping/log_unit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "toolpath/toolpath_summary.h"

namespace clsurf {
namespace {

constexpr double least_extent = 0.1;    ///< [mm] least extent of the program on an informative axis
constexpr double extents_differ = 0.1;  ///< share: rapids and approaches of the log are not part of any motion at feed

struct LogScale {
    const char* name;
    double mm;
};
constexpr std::array units{LogScale{"inch", 25.4}, LogScale{"m", 1000}, LogScale{"µm", 0.001}};

}  // namespace

std::optional<LogUnit> other_unit(const Trajectory& path, const Program& program) {
    const Box3 cut = summarise(program.motions).bounds;
    const Box3 box = box_of(path);
    if (cut.isEmpty() || box.isEmpty()) return std::nullopt;
    const Vec3 of_program = cut.sizes(), of_log = box.sizes();
    std::array<int, 3> axes{0, 1, 2};
    std::sort(axes.begin(), axes.end(), [&](int a, int b) { return of_program[a] > of_program[b]; });
    for (const LogScale& unit : units) {
        const auto fits = [&](int axis) {
            return of_program[axis] > least_extent &&
                   std::abs(unit.mm * of_log[axis] / of_program[axis] - 1) < extents_differ;
        };
        if (!fits(axes[0]) || !fits(axes[1])) continue;
        constexpr char names[] = {'X', 'Y', 'Z'};
        return LogUnit{unit.name,
                       fmt::format("in {} and {} its positions extend over {:.4g} and {:.4g} mm, the program over "
                                   "{:.4g} and {:.4g} mm, as if they were in {}",
                                   names[axes[0]], names[axes[1]], of_log[axes[0]], of_log[axes[1]],
                                   of_program[axes[0]], of_program[axes[1]], unit.name)};
    }
    return std::nullopt;
}

}  // namespace clsurf
