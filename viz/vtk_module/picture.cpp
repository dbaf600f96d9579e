#include "viz/vtk_module/picture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCoordinate.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>
#include <vtkUnsignedCharArray.h>

#include "viz/vtk_module/gl_window.h"
#include "viz/vtk_module/mesh_actors.h"

namespace clsurf::viz::vtk_module {
namespace {

constexpr std::array levels{Level::area, Level::casing, Level::mark, Level::inlay,   Level::edge,
                            Level::line, Level::halo,   Level::dot,  Level::dot_fill};
constexpr int flat_layers = 2 + static_cast<int>(levels.size());  ///< quads, lines by level, texts
constexpr int dpi = 72;                                           // one text point is one pixel

/// Polygons in pixels of the supersampled picture, one colour each.
void add_flat(vtkRenderer* renderer, vtkPoints* points, vtkCellArray* polygons, vtkUnsignedCharArray* colours) {
    if (polygons->GetNumberOfCells() == 0) return;
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->SetPolys(polygons);
    data->GetCellData()->SetScalars(colours);
    vtkNew<vtkPolyDataMapper2D> mapper;
    mapper->SetInputData(data);
    mapper->SetColorModeToDirectScalars();
    mapper->SetScalarModeToUseCellData();
    vtkNew<vtkActor2D> actor;
    actor->SetMapper(mapper);
    renderer->AddActor2D(actor);
}

void add_quads(vtkRenderer* renderer, const std::vector<FlatQuad>& quads, int supersample) {
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> polygons;
    vtkNew<vtkUnsignedCharArray> colours;
    colours->SetNumberOfComponents(3);
    for (const FlatQuad& quad : quads) {
        const Rect& r = quad.rect;
        vtkIdType ids[4];
        const double corners[4][2] = {
            {r.x, r.y}, {r.x + r.width, r.y}, {r.x + r.width, r.y + r.height}, {r.x, r.y + r.height}};
        for (int k = 0; k < 4; ++k)
            ids[k] = points->InsertNextPoint(corners[k][0] * supersample, corners[k][1] * supersample, 0);
        polygons->InsertNextCell(4, ids);
        colours->InsertNextTypedTuple(quad.rgb.data());
    }
    add_flat(renderer, points, polygons, colours);
}

/// The part of a convex polygon in a rectangle [px, times `supersample`], clipped by one edge at a time (Sutherland and
/// Hodgman 1974). Empty: nothing.
std::vector<Vec2> clipped(std::vector<Vec2> corners, const Rect& rect, int supersample) {
    const Vec2 low = Vec2(rect.x, rect.y) * supersample;
    const Vec2 high = Vec2(rect.x + rect.width, rect.y + rect.height) * supersample;
    for (int edge = 0; edge < 4; ++edge) {
        const int axis = edge / 2;
        const auto inside = [&](const Vec2& p) { return edge % 2 == 0 ? p[axis] - low[axis] : high[axis] - p[axis]; };
        std::vector<Vec2> kept;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const Vec2& from = corners[i];
            const Vec2& to = corners[(i + 1) % corners.size()];
            const double here = inside(from), there = inside(to);
            if (here >= 0) kept.push_back(from);
            if ((here >= 0) != (there >= 0)) kept.emplace_back(from + here / (here - there) * (to - from));
        }
        corners = std::move(kept);
    }
    return corners;
}

/// A step of a line as a quad, because llvmpipe's wide lines have no joints. A step of a band is two triangles, since its
/// edges may cross.
std::vector<std::vector<Vec2>> polygons_of_step(const FlatLine& line, std::size_t i, int supersample) {
    const Vec2 a = line.points[i - 1] * supersample;
    const Vec2 b = line.points[i] * supersample;
    if (!line.opposite.empty()) {
        const Vec2 c = line.opposite[i] * supersample;
        return {{a, line.opposite[i - 1] * supersample, c}, {a, c, b}};
    }
    const double length = (b - a).norm();
    if (!(length > 0)) return {};
    const Vec2 along = 0.5 * line.width * supersample / length * (b - a);
    const Vec2 side(-along.y(), along.x());
    return {{a - along * 0.5 + side, a - along * 0.5 - side, b + along * 0.5 - side, b + along * 0.5 + side}};
}

void add_lines(vtkRenderer* renderer, const std::vector<FlatLine>& lines, Level level, int supersample) {
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> polygons;
    vtkNew<vtkUnsignedCharArray> colours;
    colours->SetNumberOfComponents(3);
    for (const FlatLine& line : lines) {
        if (line.level != level) continue;
        for (std::size_t i = 1; i < line.points.size(); ++i) {
            for (std::vector<Vec2>& corners : polygons_of_step(line, i, supersample)) {
                if (line.clip) corners = clipped(std::move(corners), *line.clip, supersample);
                if (corners.empty()) continue;
                polygons->InsertNextCell(static_cast<int>(corners.size()));
                for (const Vec2& p : corners) polygons->InsertCellPoint(points->InsertNextPoint(p.x(), p.y(), 0));
                colours->InsertNextTypedTuple(line.rgb.data());
            }
        }
    }
    add_flat(renderer, points, polygons, colours);
}

void set_up(vtkTextProperty* property, const FlatText& text, int supersample) {
    property->SetFontFamilyToArial();
    property->SetFontSize(static_cast<int>(std::lround(text.size * supersample)));
    property->SetBold(text.bold ? 1 : 0);
    property->SetColor(text.rgb[0] / 255.0, text.rgb[1] / 255.0, text.rgb[2] / 255.0);
    property->SetVerticalJustificationToCentered();
    if (text.align == Align::left) property->SetJustificationToLeft();
    if (text.align == Align::centre) property->SetJustificationToCentered();
    if (text.align == Align::right) property->SetJustificationToRight();
}

void add_texts(vtkRenderer* renderer, const std::vector<FlatText>& texts, int supersample) {
    for (const FlatText& text : texts) {
        if (text.text.empty()) continue;
        vtkNew<vtkTextActor> actor;
        actor->SetInput(text.text.c_str());
        set_up(actor->GetTextProperty(), text, supersample);
        actor->SetTextScaleModeToNone();
        actor->GetPositionCoordinate()->SetCoordinateSystemToDisplay();
        actor->SetPosition(std::round(text.x * supersample), std::round(text.y * supersample));
        renderer->AddActor2D(actor);
    }
}

}  // namespace

double text_width(const FlatText& text) {
    vtkNew<vtkTextProperty> property;
    // Measured at the drawn size: texts are drawn larger and shrunk, and letter widths do not scale exactly.
    constexpr int larger = 2;
    set_up(property, text, larger);
    int box[4] = {0, 0, 0, 0};
    vtkTextRenderer::GetInstance()->GetBoundingBox(property, text.text, box, dpi);
    return static_cast<double>(box[1] - box[0]) / larger + 1;
}

namespace {

using Renderers = std::array<vtkNew<vtkRenderer>, flat_layers>;

/// The window of a picture with its background.
class Canvas {
public:
    Canvas(const Sheet& sheet, const std::string& gl, int supersample)
        : window_(gl, sheet.width * supersample, sheet.height * supersample), supersample_(supersample) {
        window_.window()->SetDPI(dpi);
        window_.window()->SetNumberOfLayers(2 + flat_layers);
        paper_->SetBackground(sheet.background[0] / 255.0, sheet.background[1] / 255.0, sheet.background[2] / 255.0);
        paper_->InteractiveOff();
        window_.window()->AddRenderer(paper_);
    }

    /// The mesh of a panel, which must outlive it, on a separate renderer.
    void add_panel(const Sheet& sheet, const MeshPanel& panel) {
        panels_.push_back(vtkSmartPointer<vtkRenderer>::New());
        vtkRenderer* const renderer = panels_.back();
        renderer->SetLayer(1);
        window_.window()->AddRenderer(renderer);
        add_mesh(renderer, panel, supersample_);
        place(renderer, panel, sheet.width, sheet.height);
    }

    /// Pixels in full size, in rows from the bottom, in place of background and meshes.
    void put(const Column<std::uint8_t>& rgb) {
        window_.put(rgb);
        paper_->DrawOff();
    }

    /// The picture with the flat items of a sheet. They have no depth: each kind is a separate layer.
    [[nodiscard]] Image picture_with(const Sheet& sheet) {
        for (int k = 0; k < flat_layers; ++k) {
            vtkRenderer* const layer = flat_[static_cast<std::size_t>(k)];
            layer->SetLayer(2 + k);
            layer->DrawOn();
            window_.window()->AddRenderer(layer);
        }
        add_quads(flat_[0], sheet.quads, supersample_);
        for (std::size_t k = 0; k < levels.size(); ++k) add_lines(flat_[1 + k], sheet.lines, levels[k], supersample_);
        add_texts(flat_.back(), sheet.texts, supersample_);
        return window_.render(supersample_);
    }

    /// Everything but flat items, in full size, as the image below a drawing.
    [[nodiscard]] Drawing::Ground ground(const Sheet& sheet) {
        for (const auto& renderer : flat_) renderer->DrawOff();
        Image image = window_.render(1);
        return {image.width,
                image.height,
                std::move(image.rgb),
                {0, 0, static_cast<double>(sheet.width), static_cast<double>(sheet.height)}};
    }

private:
    GlWindow window_;
    int supersample_;
    vtkNew<vtkRenderer> paper_;
    std::vector<vtkSmartPointer<vtkRenderer>> panels_;
    Renderers flat_;
};

}  // namespace

Image draw(const Sheet& sheet, const MeshSamples* meshes, const std::string& gl, int supersample,
           Drawing::Ground* ground) {
    Canvas canvas(sheet, gl, supersample);
    if (meshes != nullptr) {
        canvas.put(meshes->over(sheet.background));
        if (ground != nullptr) *ground = canvas.ground(sheet);
        return canvas.picture_with(sheet);
    }
    for (const MeshPanel& panel : sheet.panels) canvas.add_panel(sheet, panel);
    Image image = canvas.picture_with(sheet);
    if (ground != nullptr) *ground = canvas.ground(sheet);
    return image;
}

}  // namespace clsurf::viz::vtk_module
