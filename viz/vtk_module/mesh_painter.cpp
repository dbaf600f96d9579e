#include "viz/vtk_module/mesh_painter.h"

#include <algorithm>

#include <vtkNew.h>

#include "viz/vtk_module/gl_window.h"
#include "viz/vtk_module/mesh_actors.h"

namespace clsurf::viz::vtk_module {

namespace {

/// Draws one kind of cells of one part at a time.
class WindowPainter final : public MeshPainter {
public:
    WindowPainter(int width, int height, const std::string& gl, int supersample)
        : window_(gl, width * supersample, height * supersample),
          width_(width),
          height_(height),
          supersample_(supersample) {
        window_.window()->AddRenderer(renderer_);
    }

    [[nodiscard]] MeshSamples empty() const override { return {width_ * supersample_, height_ * supersample_}; }

    void draw(const MeshPanel& part, MeshSamples& samples) override {
        for (std::size_t kind = 0; kind < cell_kinds; ++kind) draw(part, static_cast<CellKind>(kind), samples);
    }

private:
    void draw(const MeshPanel& part, CellKind kind, MeshSamples& samples) {
        place(renderer_, part, width_, height_);
        const SampleRect rect = rect_of(part);
        if (rect.count() == 0 || !add_mesh(renderer_, part, supersample_, kind)) return;
        const Column<std::uint8_t> rgb = window_.render(rect);
        samples.add(kind, {rect, rgb, window_.depths(rect)});
        renderer_->RemoveAllViewProps();
    }

    /// The samples that a part may cover: the extent of its vertices, plus the widths of lines and points, on the panel.
    [[nodiscard]] SampleRect rect_of(const MeshPanel& part) {
        Eigen::AlignedBox2d box;
        const Geometry& g = part.geometry;
        for (std::size_t k = 0; k + 2 < g.xyz.size(); k += 3)
            box.extend(part.camera.pixel(g.origin + Vec3(g.xyz[k], g.xyz[k + 1], g.xyz[k + 2])));
        const Vec2 room = Vec2::Constant(std::max(part.line_width, part.point_size) + 1);
        const Vec2 corner(part.rect.x, part.rect.y);
        const Eigen::AlignedBox2d covered((corner + box.min() - room) * supersample_,
                                          (corner + box.max() + room) * supersample_);
        int width = 0, height = 0, x = 0, y = 0;
        renderer_->GetTiledSizeAndOrigin(&width, &height, &x, &y);
        const Eigen::AlignedBox2d panel(Vec2(x, y), Vec2(x + width, y + height));
        const Eigen::AlignedBox2d shown = panel.intersection(covered);
        if (box.isEmpty() || shown.isEmpty()) return {};
        const Vec2 low = shown.min().array().floor(), size = shown.max().array().ceil().matrix() - low;
        return {static_cast<int>(low.x()), static_cast<int>(low.y()), static_cast<int>(size.x()),
                static_cast<int>(size.y())};
    }

    GlWindow window_;
    int width_, height_, supersample_;
    vtkNew<vtkRenderer> renderer_;
};

}  // namespace

std::unique_ptr<MeshPainter> make_mesh_painter(int width, int height, const std::string& gl, int supersample) {
    return std::make_unique<WindowPainter>(width, height, gl, supersample);
}

}  // namespace clsurf::viz::vtk_module
