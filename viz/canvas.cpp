#include "viz/canvas.h"

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

#include "core/error.h"
#include "viz/drawing.h"
#include "viz/gl_window.h"
#include "viz/mesh_actors.h"

namespace clsurf::viz {
namespace {

constexpr std::array levels{Level::area, Level::casing, Level::mark, Level::inlay,   Level::edge,
                            Level::line, Level::halo,   Level::dot,  Level::dot_fill};
constexpr int flat_layers = 2 + static_cast<int>(levels.size());  ///< quads, lines by level, texts
constexpr int dpi = 72;                                           // one point of text is one pixel

/// Polygons in pixels of the supersampled picture, a colour each.
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

/// What of a convex polygon lies in a rectangle [px, times `supersample`]: cut by one edge after the other (Sutherland and
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

/// A step of a line as a quad: llvmpipe's wide lines have no joints. Of a band two triangles, since its edges may cross.
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
    // Texts are drawn larger and shrunk, and letters are not as wide as they would be at this size.
    constexpr int larger = 2;
    set_up(property, text, larger);
    int box[4] = {0, 0, 0, 0};
    vtkTextRenderer::GetInstance()->GetBoundingBox(property, text.text, box, dpi);
    return static_cast<double>(box[1] - box[0]) / larger + 1;
}

Rect text_rect(const FlatText& text) {
    const double width = text_width(text);
    return {text.x - share_at_left(text.align) * width, text.y - 0.5 * text.size, width, text.size};
}

FlatLine halo_of(const FlatText& text, const Rgb& background) {
    const Rect rect = text_rect(text);
    return {{{rect.x, text.y}, {rect.x + rect.width, text.y}}, 1.1 * text.size, background, Level::halo};
}

FlatText fitted(FlatText text, double width) {
    if (text_width(text) <= width) return text;
    const std::string whole = text.text;
    for (std::size_t keep = whole.size(); keep > 4; --keep) {
        std::size_t head = keep / 2;
        std::size_t tail = whole.size() - (keep - head);
        // Not inside a UTF-8 sequence, nor inside a number, which would then be another one.
        const auto inside = [&whole](std::size_t at) {
            const auto in_number = [&whole](std::size_t k) {
                return (whole[k] >= '0' && whole[k] <= '9') || whole[k] == '.';
            };
            return at > 0 && at < whole.size() &&
                   ((static_cast<unsigned char>(whole[at]) & 0xC0) == 0x80 || (in_number(at - 1) && in_number(at)));
        };
        while (inside(head)) --head;
        while (inside(tail)) ++tail;
        text.text = whole.substr(0, head) + "…" + whole.substr(tail);
        if (text_width(text) <= width) return text;
    }
    text.text.clear();
    return text;
}

namespace {

/// Where a text stands in the picture, with some room for its smoothed edges.
PixelBox box_of(const FlatText& text, int height) {
    const Rect rect = text_rect(text);
    constexpr double room = 2;  // [px]
    const double top = height - text.y - 0.75 * text.size - room;
    return {static_cast<int>(std::floor(rect.x - room)), static_cast<int>(std::floor(top)),
            static_cast<int>(std::ceil(rect.width + 2 * room)) + 1,
            static_cast<int>(std::ceil(1.5 * text.size + 2 * room)) + 1};
}

/// The flat things of a sheet, and nothing yet below them.
Drawing drawing_of(const Sheet& sheet) {
    Drawing drawing;
    drawing.width = sheet.width;
    drawing.height = sheet.height;
    drawing.background = sheet.background;
    drawing.quads = sheet.quads;
    drawing.lines = sheet.lines;
    std::stable_sort(drawing.lines.begin(), drawing.lines.end(),
                     [](const FlatLine& a, const FlatLine& b) { return a.level < b.level; });
    for (const FlatText& text : sheet.texts) {
        if (text.text.empty()) continue;
        drawing.texts.push_back(text);
        drawing.text_widths.push_back(text_width(text));
    }
    return drawing;
}

using Renderers = std::array<vtkNew<vtkRenderer>, flat_layers>;

/// The window of a picture with its paper.
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

    /// The mesh of a panel, which must outlive it, on a renderer of its own.
    void add_panel(const Sheet& sheet, const MeshPanel& panel) {
        panels_.push_back(vtkSmartPointer<vtkRenderer>::New());
        vtkRenderer* const renderer = panels_.back();
        renderer->SetLayer(1);
        window_.window()->AddRenderer(renderer);
        add_mesh(renderer, panel, supersample_);
        place(renderer, panel, sheet.width, sheet.height);
    }

    /// Pixels in full size, in rows from the bottom, in place of paper and meshes.
    void put(const Column<std::uint8_t>& rgb) {
        window_.put(rgb);
        paper_->DrawOff();
    }

    /// The picture with the flat things of a sheet. They have no depth among each other: each kind is a layer of its own.
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
        Image image = window_.render(supersample_);
        for (const FlatText& text : sheet.texts) image.texts.push_back(box_of(text, sheet.height));
        return image;
    }

    /// What was drawn besides flat things, in full size, below a drawing of them.
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

Image draw(const Sheet& sheet, const std::string& gl, int supersample) {
    Canvas canvas(sheet, gl, supersample);
    for (const MeshPanel& panel : sheet.panels) canvas.add_panel(sheet, panel);
    Image image = canvas.picture_with(sheet);
    if (sheet.keep_drawing) {
        auto drawing = std::make_shared<Drawing>(drawing_of(sheet));
        if (!sheet.panels.empty()) drawing->grounds.push_back(canvas.ground(sheet));
        image.drawing = std::move(drawing);
    }
    return image;
}

Image draw(const Sheet& flat, const MeshSamples& meshes, const std::string& gl, int supersample) {
    Canvas canvas(flat, gl, supersample);
    canvas.put(meshes.over(flat.background));
    std::shared_ptr<Drawing> drawing;
    if (flat.keep_drawing) {
        drawing = std::make_shared<Drawing>(drawing_of(flat));
        drawing->grounds.push_back(canvas.ground(flat));
    }
    Image image = canvas.picture_with(flat);
    image.drawing = std::move(drawing);
    return image;
}

}  // namespace clsurf::viz
