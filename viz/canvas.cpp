#include "viz/canvas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <vtkActor.h>
#include <vtkActor2D.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCoordinate.h>
#include <vtkCullerCollection.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkOpenGLVertexBufferObject.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty.h>
#include <vtkProperty2D.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>
#include <vtkTexture.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>

#include "core/error.h"
#include "viz/drawing.h"
#include "viz/gl_window.h"

namespace clsurf::viz {
namespace {

constexpr std::array levels{Level::area, Level::casing, Level::mark, Level::inlay,   Level::edge,
                            Level::line, Level::halo,   Level::dot,  Level::dot_fill};
constexpr int flat_layers = 2 + static_cast<int>(levels.size());  ///< quads, lines by level, texts
constexpr int dpi = 72;                                           // one point of text is one pixel

/// Our 32-bit vertex numbers as VTK cells of `size` vertices, without a copy. The column must outlive it.
vtkNew<vtkCellArray> cells(const Column<std::uint32_t>& vertices, int size) {
    vtkNew<vtkCellArray> array;
    const auto count = static_cast<vtkIdType>(vertices.size()) / size;
    vtkNew<vtkTypeInt32Array> offsets;
    offsets->SetNumberOfValues(count + 1);
    for (vtkIdType i = 0; i <= count; ++i) offsets->SetValue(i, static_cast<vtkTypeInt32>(i * size));
    vtkNew<vtkTypeInt32Array> connectivity;
    auto* data = reinterpret_cast<vtkTypeInt32*>(const_cast<std::uint32_t*>(vertices.data()));
    connectivity->SetArray(data, count * size, 1);
    array->SetData(offsets, connectivity);
    return array;
}

/// How far a lighter tone is from the colour to the lightest one of the ramp.
constexpr double paleness = 0.6;
constexpr double hatch_period = 8;  ///< [px] from one line of a hatching to the next, across and up
constexpr int hatch_texels = 8;     ///< of which one is the line

/// Rows of colours as a texture. VTK multiplies it with the vertex colours.
vtkSmartPointer<vtkTexture> texture_of(const std::vector<std::vector<Rgb>>& rows, bool stepped, bool repeated) {
    vtkNew<vtkImageData> image;
    image->SetDimensions(static_cast<int>(rows.front().size()), static_cast<int>(rows.size()), 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    auto* out = static_cast<unsigned char*>(image->GetScalarPointer());
    for (const std::vector<Rgb>& row : rows) {
        for (const Rgb& rgb : row) out = std::copy(rgb.begin(), rgb.end(), out);
    }
    auto texture = vtkSmartPointer<vtkTexture>::New();
    texture->SetInputData(image);
    texture->SetColorModeToDirectScalars();
    texture->SetWrap(repeated ? vtkTexture::Repeat : vtkTexture::ClampToEdge);
    texture->MipmapOff();
    texture->SetInterpolate(stepped ? 0 : 1);
    return texture;
}

/// A ramp, and above it the same in a lighter tone.
vtkSmartPointer<vtkTexture> texture_of_ramp(const MeshPanel& panel) {
    const auto lightness = [](const Rgb& c) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; };
    const Rgb lightest = *std::max_element(panel.ramp.begin(), panel.ramp.end(),
                                           [&](const Rgb& a, const Rgb& b) { return lightness(a) < lightness(b); });
    std::vector<Rgb> pale = panel.ramp;
    for (Rgb& rgb : pale) {
        for (std::size_t k = 0; k < 3; ++k)
            rgb[k] = static_cast<std::uint8_t>(std::lround(rgb[k] + paleness * (lightest[k] - rgb[k])));
    }
    return texture_of({panel.ramp, pale}, panel.stepped, false);
}

vtkSmartPointer<vtkTexture> texture_of_hatch(const MeshPanel& panel) {
    std::vector<Rgb> texels(hatch_texels, panel.bare_ground);
    texels.front() = panel.bare_colour;
    return texture_of({texels}, false, true);
}

vtkSmartPointer<vtkFloatArray> texture_places(vtkIdType vertices) {
    auto places = vtkSmartPointer<vtkFloatArray>::New();
    places->SetNumberOfComponents(2);
    places->SetNumberOfTuples(vertices);
    return places;
}

/// Along the ramp, and up from it to the lighter tone.
vtkSmartPointer<vtkFloatArray> places_on_ramp(const MeshPanel& panel, vtkIdType vertices) {
    auto places = texture_places(vertices);
    float* out = places->GetPointer(0);
    for (std::size_t v = 0; v < static_cast<std::size_t>(vertices); ++v) {
        *out++ = panel.along[v];
        *out++ = 0.25F + (panel.pale.empty() ? 0 : 0.5F * panel.pale[v]);  // texels' centres
    }
    return places;
}

/// Across lines that rise to the left in the picture.
vtkSmartPointer<vtkFloatArray> places_on_hatch(const MeshPanel& panel, vtkIdType vertices) {
    auto places = texture_places(vertices);
    float* out = places->GetPointer(0);
    const float* xyz = panel.geometry.xyz.data();
    for (vtkIdType v = 0; v < vertices; ++v, xyz += 3) {
        const Vec2 at = panel.camera.pixel(panel.geometry.origin + Vec3(xyz[0], xyz[1], xyz[2]));
        *out++ = static_cast<float>((at.x() + at.y()) / hatch_period);
        *out++ = 0.5F;
    }
    return places;
}

struct Cells {
    const Column<std::uint32_t>& triangles;
    const Column<std::uint32_t>& segments;
    const Column<std::uint32_t>& points;
    [[nodiscard]] bool empty() const { return triangles.empty() && segments.empty() && points.empty(); }
};

void add_cells(vtkRenderer* renderer, const MeshPanel& panel, const Cells& of, vtkPoints* points,
               vtkPointData* attributes, vtkTexture* texture, int supersample) {
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->GetPointData()->ShallowCopy(attributes);
    if (!of.triangles.empty()) data->SetPolys(cells(of.triangles, 3));
    if (!of.segments.empty()) data->SetLines(cells(of.segments, 2));
    if (!of.points.empty()) data->SetVerts(cells(of.points, 1));
    vtkNew<vtkOpenGLPolyDataMapper> mapper;
    // Else VTK moves and scales the vertices by what is drawn with them, and a part of a mesh is rounded differently.
    mapper->SetVBOShiftScaleMethod(vtkOpenGLVertexBufferObject::DISABLE_SHIFT_SCALE);
    mapper->SetInputData(data);
    mapper->SetColorModeToDirectScalars();
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    if (texture != nullptr) actor->SetTexture(texture);
    // Shading is in the colours already, so that one rule makes legend and surface.
    actor->GetProperty()->LightingOff();
    actor->GetProperty()->SetLineWidth(static_cast<float>(panel.line_width * supersample));
    actor->GetProperty()->SetPointSize(static_cast<float>(panel.point_size * supersample));
    actor->ForceOpaqueOn();
    renderer->AddActor(actor);
}

/// Adds the cells of a panel, of one kind or of all. Returns whether there are any.
bool add_mesh(vtkRenderer* renderer, const MeshPanel& panel, int supersample, std::optional<CellKind> only = {}) {
    const Geometry& g = panel.geometry;
    const auto vertices = static_cast<vtkIdType>(g.xyz.size() / 3);
    if (vertices == 0) return false;
    const Column<std::uint32_t> none;
    const auto kind = [&](const Column<std::uint32_t>& cells, CellKind of) -> const Column<std::uint32_t>& {
        return !only || *only == of ? cells : none;
    };
    const Cells valued{kind(g.triangles, CellKind::triangles), kind(g.segments, CellKind::lines_and_points),
                       kind(g.points, CellKind::lines_and_points)};
    const Cells hatched{kind(panel.bare_triangles, CellKind::bare_triangles), none, none};
    const Cells bare{none, kind(panel.bare_segments, CellKind::bare_lines_and_points),
                     kind(panel.bare_points, CellKind::bare_lines_and_points)};
    if (valued.empty() && hatched.empty() && bare.empty()) return false;
    vtkNew<vtkFloatArray> xyz;
    xyz->SetNumberOfComponents(3);
    xyz->SetArray(const_cast<float*>(g.xyz.data()), vertices * 3, 1);
    vtkNew<vtkPoints> points;
    points->SetData(xyz);
    vtkNew<vtkUnsignedCharArray> colours;
    colours->SetNumberOfComponents(3);
    colours->SetArray(const_cast<unsigned char*>(g.rgb.data()), vertices * 3, 1);
    vtkNew<vtkPolyData> attributes;
    attributes->GetPointData()->SetScalars(colours);
    const auto add = [&](const Cells& cells, vtkFloatArray* places, vtkTexture* texture) {
        if (places != nullptr) attributes->GetPointData()->SetTCoords(places);
        add_cells(renderer, panel, cells, points, attributes->GetPointData(), texture, supersample);
    };
    // In the order of CellKind: VTK draws the points and lines of an actor before its triangles.
    if (!valued.empty() && panel.ramp.empty()) add(valued, nullptr, nullptr);
    if (!valued.empty() && !panel.ramp.empty()) add(valued, places_on_ramp(panel, vertices), texture_of_ramp(panel));
    if (!hatched.empty()) add(hatched, places_on_hatch(panel, vertices), texture_of_hatch(panel));
    if (!bare.empty()) add(bare, texture_places(vertices), texture_of({{panel.bare_colour}}, true, false));
    return true;
}

/// Shows a panel on its rectangle of a picture.
void place(vtkRenderer* renderer, const MeshPanel& panel, double width, double height) {
    renderer->SetViewport(panel.rect.x / width, panel.rect.y / height, (panel.rect.x + panel.rect.width) / width,
                          (panel.rect.y + panel.rect.height) / height);
    const Camera& c = panel.camera;
    const Vec3 focus = c.centre - panel.geometry.origin;
    // A panel's shift in its plane does not change depths, since the projection is parallel.
    const double room = 1.01 * c.depth + 1;
    const Vec3 eye = focus + 2 * room * c.towards;
    vtkNew<vtkCamera> camera;
    camera->SetParallelProjection(1);
    camera->SetFocalPoint(focus.data());
    camera->SetPosition(eye.data());
    camera->SetViewUp(c.up.data());
    camera->SetParallelScale(0.5 * c.height * c.mm_per_pixel);
    camera->SetClippingRange(room, 3 * room);
    renderer->SetActiveCamera(camera);
    // Everything is in view (detail.h): cullers would only measure it again.
    renderer->GetCullers()->RemoveAllItems();
}

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

/// A window for one kind of cells of one part at a time.
class MeshPainter::Window {
public:
    Window(int width, int height, const std::string& gl, int supersample)
        : window_(gl, width * supersample, height * supersample),
          width_(width),
          height_(height),
          supersample_(supersample) {
        window_.window()->AddRenderer(renderer_);
    }

    [[nodiscard]] MeshSamples empty() const { return {width_ * supersample_, height_ * supersample_}; }

    void draw(const MeshPanel& part, CellKind kind, MeshSamples& samples) {
        place(renderer_, part, width_, height_);
        const SampleRect rect = rect_of(part);
        if (rect.count() == 0 || !add_mesh(renderer_, part, supersample_, kind)) return;
        const Column<std::uint8_t> rgb = window_.render(rect);
        samples.add(kind, {rect, rgb, window_.depths(rect)});
        renderer_->RemoveAllViewProps();
    }

private:
    /// What a part may cover: its vertices, with lines and points as wide as they are, on the panel.
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

MeshPainter::MeshPainter(int width, int height, const std::string& gl, int supersample)
    : window_(std::make_unique<Window>(width, height, gl, supersample)) {}
MeshPainter::~MeshPainter() = default;

MeshSamples MeshPainter::empty() const { return window_->empty(); }

void MeshPainter::draw(const MeshPanel& part, MeshSamples& samples) {
    for (std::size_t kind = 0; kind < cell_kinds; ++kind) window_->draw(part, static_cast<CellKind>(kind), samples);
}

}  // namespace clsurf::viz
