#include "viz/vtk_module/mesh_actors.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCullerCollection.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkOpenGLVertexBufferObject.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkTexture.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>

namespace clsurf::viz::vtk_module {
namespace {

/// 32-bit vertex numbers as VTK cells of `size` vertices, without a copy. The column must outlive them.
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

/// The share by which a lighter tone is moved from the colour to the lightest one of the ramp.
constexpr double paleness = 0.6;
constexpr double hatch_period = 8;  ///< [px] distance between hatching lines, horizontally and vertically
constexpr int hatch_texels = 8;     ///< texels in a period, one of which is the line

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

/// Two rows: the ramp, and the ramp in a lighter tone.
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

/// Texture coordinates: along the ramp, and from the ramp to the lighter tone.
vtkSmartPointer<vtkFloatArray> places_on_ramp(const MeshPanel& panel, vtkIdType vertices) {
    auto places = texture_places(vertices);
    float* out = places->GetPointer(0);
    for (std::size_t v = 0; v < static_cast<std::size_t>(vertices); ++v) {
        *out++ = panel.along[v];
        *out++ = 0.25F + (panel.pale.empty() ? 0 : 0.5F * panel.pale[v]);  // centres of the texels
    }
    return places;
}

/// Texture coordinates across lines that rise to the left in the picture.
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
    // Otherwise VTK shifts and scales the vertices by the drawn data, and parts of a mesh are rounded differently.
    mapper->SetVBOShiftScaleMethod(vtkOpenGLVertexBufferObject::DISABLE_SHIFT_SCALE);
    mapper->SetInputData(data);
    mapper->SetColorModeToDirectScalars();
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    if (texture != nullptr) actor->SetTexture(texture);
    // The colours include the shading already, so that legend and surface follow one rule.
    actor->GetProperty()->LightingOff();
    actor->GetProperty()->SetLineWidth(static_cast<float>(panel.line_width * supersample));
    actor->GetProperty()->SetPointSize(static_cast<float>(panel.point_size * supersample));
    actor->ForceOpaqueOn();
    renderer->AddActor(actor);
}

}  // namespace

bool add_mesh(vtkRenderer* renderer, const MeshPanel& panel, int supersample, std::optional<CellKind> only) {
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

void place(vtkRenderer* renderer, const MeshPanel& panel, double width, double height) {
    renderer->SetViewport(panel.rect.x / width, panel.rect.y / height, (panel.rect.x + panel.rect.width) / width,
                          (panel.rect.y + panel.rect.height) / height);
    const Camera& c = panel.camera;
    const Vec3 focus = c.centre - panel.geometry.origin;
    // A shift of the panel in its plane does not change depths, because the projection is parallel.
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
    // Everything is visible (detail.h): cullers would only test it again.
    renderer->GetCullers()->RemoveAllItems();
}

}  // namespace clsurf::viz::vtk_module
