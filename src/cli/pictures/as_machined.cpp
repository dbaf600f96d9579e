#include "cli/pictures/as_machined.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/error.h"
#include "core/parallel.h"
#include "machined/form.h"

namespace clsurf::cli {
namespace {

constexpr double most_cells = 1e8;  ///< largest number of cells of a picture; larger areas have larger cells
constexpr double least_tilt =
    0.2;  ///< sine of the view's elevation below which the picture does not determine the plan

/// The area in plan that the picture can show, for heights from low to high.
Box2 shown_plan(const viz::Camera& camera, double low, double high) {
    const viz::Projection projection = camera.projection();
    const Eigen::Matrix2d plan = projection.leftCols<2>();
    Box2 box;
    for (const double z : {low, high}) {
        for (const double x : {0.0, 1.0}) {
            for (const double y : {0.0, 1.0}) {
                const Vec2 pixel(x * camera.width, y * camera.height);
                box.extend(Vec2(plan.inverse() * (pixel - projection.col(2) * z - projection.col(3))));
            }
        }
    }
    return box;
}

/// Lowest and highest tip of cutting points.
std::pair<double, double> heights_of(const ClSurface& surface) {
    float low = std::numeric_limits<float>::infinity();
    float high = -low;
    for (const Pass& pass : surface.passes) {
        if (pass.kind != PassKind::cut) continue;
        for (PointIndex i = pass.first; i <= pass.last; ++i) {
            const float z = surface.positions.z[static_cast<std::size_t>(i)];
            low = z < low ? z : low;
            high = z > high ? z : high;
        }
    }
    return {low + surface.positions.origin.z(), high + surface.positions.origin.z()};
}

/// Sets heights beyond the outermost contact points to NaN: they are of the tool's flank, not of the part. Heights among
/// the contact points stay, even if the form is not known there.
void leave_out_flanks(const Form& form, const MapFrame& frame, std::int64_t first_row, std::span<float> heights,
                      std::span<const float> deviation) {
    constexpr std::int64_t grain = 4096;
    parallel_for(static_cast<std::int64_t>(heights.size()), grain, [&](std::int64_t first, std::int64_t last) {
        for (std::int64_t k = first; k < last; ++k) {
            float& height = heights[static_cast<std::size_t>(k)];
            const float over = deviation[static_cast<std::size_t>(k)];
            if (!(height == height) || over == over) continue;
            const std::int64_t row = k / frame.columns;
            const Vec2 place =
                frame.at(static_cast<double>(k - row * frame.columns), static_cast<double>(first_row + row));
            if (!form.is_among_contacts(place)) height = std::numeric_limits<float>::quiet_NaN();
        }
    });
}

/// Means of blocks of cells, filled row by row.
class Means {
public:
    Means(viz::HeightMap& height_map, Column<float>& values, std::int64_t per_vertex, std::int64_t columns)
        : height_map_(height_map),
          values_(values),
          per_vertex_(per_vertex),
          columns_(columns),
          z_(size()),
          d_(size()),
          n_(size()) {}

    void add(std::int64_t row, std::span<const float> z, std::span<const float> deviation) {
        for (std::int64_t c = 0; c < columns_; ++c) {
            const auto k = static_cast<std::size_t>(c);
            if (!(z[k] == z[k])) continue;
            const auto at = static_cast<std::size_t>(c / per_vertex_);
            if (at >= z_.size()) break;
            z_[at] += z[k];
            d_[at] += deviation[k];  // NaN: the form is not known there, and the vertex has no value
            n_[at] += 1;
        }
        if (row % per_vertex_ == per_vertex_ - 1) put(row / per_vertex_);
    }

private:
    [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(height_map_.columns); }
    void put(std::int64_t row) {
        if (row >= height_map_.rows) return;
        for (std::size_t k = 0; k < size(); ++k) {
            const std::size_t at = static_cast<std::size_t>(row) * size() + k;
            height_map_.z[at] = static_cast<float>(z_[k] / n_[k]);  // 0/0: NaN, no vertex
            values_[at] = static_cast<float>(d_[k] / n_[k]);
            z_[k] = d_[k] = n_[k] = 0;
        }
    }

    viz::HeightMap& height_map_;
    Column<float>& values_;
    std::int64_t per_vertex_, columns_;
    std::vector<double> z_, d_, n_;
};

}  // namespace

AsMachinedMap make_as_machined_map(const AsMachinedPart& part, const Box3& box, const viz::Camera& camera) {
    const AsMachinedSurface& as_machined = part.surface();
    Box2 region = as_machined.bounds();
    if (!box.isEmpty()) region = region.intersection(Box2(box.min().head<2>(), box.max().head<2>()));
    if (std::abs(camera.towards.z()) > least_tilt) {
        const auto [low, high] = heights_of(as_machined.surface());
        region = region.intersection(shown_plan(camera, low, high + as_machined.tool().radius));
    }
    AsMachinedMap map;
    viz::HeightMap& height_map = map.height_map;
    if (region.isEmpty()) throw UsageError("nothing of the as-machined surface lies in the part that is shown");
    const double cell = std::max(as_machined.usual_cell(), std::sqrt(region.volume() / most_cells));
    const auto per_vertex = std::max<std::int64_t>(1, std::lround(camera.mm_per_pixel / cell));
    // Finer than the usual cells if the picture is, so that cusps stay sharp.
    const double fine = per_vertex == 1 ? std::clamp(camera.mm_per_pixel, cell / 10, cell)
                                        : camera.mm_per_pixel / static_cast<double>(per_vertex);
    const MapFrame frame = frame_of(region, fine);
    height_map.columns = frame.columns / per_vertex;
    height_map.rows = frame.rows / per_vertex;
    height_map.pitch = fine * static_cast<double>(per_vertex);
    const Vec2 middle = frame.corner + Vec2::Constant(0.5 * fine * static_cast<double>(per_vertex - 1));
    height_map.origin = Vec3(middle.x(), middle.y(), as_machined.level());
    height_map.z = Column<float>(static_cast<std::size_t>(height_map.columns * height_map.rows),
                                 std::numeric_limits<float>::quiet_NaN());
    map.field.info = {"formed", "As-machined surface over its form", unit::um, FieldScale::diverging,
                      fmt::format("{}, {}", to_text(as_machined.tool()), as_machined.note())};
    map.field.values = height_map.z;
    Means means(height_map, map.field.values, per_vertex, frame.columns);
    const Form form(as_machined, region);
    std::vector<float> heights;
    as_machined.map(frame, [&](std::int64_t first_row, std::span<float> z) {
        heights.assign(z.begin(), z.end());
        form.subtract(frame, first_row, as_machined.level(), z);
        leave_out_flanks(form, frame, first_row, heights, z);
        const auto wide = static_cast<std::size_t>(frame.columns);
        for (std::size_t r = 0; r < z.size() / wide; ++r) {
            means.add(first_row + static_cast<std::int64_t>(r), std::span(heights).subspan(r * wide, wide),
                      z.subspan(r * wide, wide));
        }
    });
    return map;
}

}  // namespace clsurf::cli
