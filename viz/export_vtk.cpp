#include "viz/export_vtk.h"

#include <algorithm>
#include <utility>

#include <vtkCellArray.h>
#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkErrorCode.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTypeInt64Array.h>
#include <vtkTypeUInt32Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataWriter.h>

#include "core/error.h"
#include "viz/bands.h"

namespace clsurf::viz {
namespace {

Column<double> points_of(const ClSurface& surface) {
    const PointIndex count = surface.positions.size();
    Column<double> xyz(static_cast<std::size_t>(count) * 3);
    for (PointIndex i = 0; i < count; ++i) {
        const Vec3 p = surface.positions.absolute(i);
        for (int k = 0; k < 3; ++k) xyz[static_cast<std::size_t>(3 * i + k)] = p[k];
    }
    return xyz;
}

vtkNew<vtkCellArray> cell_array(Column<std::int64_t>& offsets, Column<std::int64_t>& points) {
    vtkNew<vtkTypeInt64Array> o;
    o->SetArray(reinterpret_cast<vtkTypeInt64*>(offsets.data()), static_cast<vtkIdType>(offsets.size()), 1);
    vtkNew<vtkTypeInt64Array> c;
    c->SetArray(reinterpret_cast<vtkTypeInt64*>(points.data()), static_cast<vtkIdType>(points.size()), 1);
    vtkNew<vtkCellArray> cells;
    cells->SetData(o, c);
    return cells;
}

/// The type of a column of T.
template <typename T>
struct Stored;
template <>
struct Stored<float> {
    using Array = vtkFloatArray;
};
template <>
struct Stored<double> {
    using Array = vtkDoubleArray;
};
template <>
struct Stored<std::uint32_t> {
    using Array = vtkTypeUInt32Array;
};

/// `act(column)` with the column in its own type.
template <typename Act>
void with_column(const PointData& data, Act&& act) {
    std::visit([&](const auto* column) { act(*column); }, data.values);
}

template <typename T>
void add_array(vtkPointData& to, const std::string& name, const Column<T>& column) {
    vtkNew<typename Stored<T>::Array> values;
    values->SetName(name.c_str());
    values->SetArray(const_cast<T*>(column.data()), static_cast<vtkIdType>(column.size()), 1);
    to.AddArray(values);
}

/// `lines` borrow from `piece`, which is not const therefore.
vtkNew<vtkPolyData> poly_data(VtkPiece& piece, const std::vector<PointData>& data) {
    vtkNew<vtkDoubleArray> coordinates;
    coordinates->SetNumberOfComponents(3);
    coordinates->SetArray(piece.xyz.data(), static_cast<vtkIdType>(piece.xyz.size()), 1);
    vtkNew<vtkPoints> points;
    points->SetData(coordinates);
    vtkNew<vtkPolyData> poly;
    poly->SetPoints(points);
    poly->SetLines(cell_array(piece.line_offsets, piece.line_points));
    for (const PointData& column : data)
        with_column(column, [&](const auto& values) { add_array(*poly->GetPointData(), column.name, values); });
    return poly;
}

/// Blanks between the head of a file and its data. VTK 9.1 and ParaView 5.11 read blocks of 4096 bytes until the parser has
/// told them of the element AppendedData. Expat 2.6, and 2.5.0-1+deb12u2 of Debian 12, tell of it when another block has
/// come, which may have nothing but blanks then: the document has ended for the parser.
class RoomBeforeData final : public vtkXMLPolyDataWriter {
public:
    static RoomBeforeData* New() {
        auto* made = new RoomBeforeData;
        made->InitializeObjectBase();
        return made;
    }
    vtkTypeMacro(RoomBeforeData, vtkXMLPolyDataWriter)

        protected : int WriteHeader() override {
        constexpr std::size_t blocks = 3, block = 4096;
        const int written = Superclass::WriteHeader();
        if (written == 0 || !Stream->good()) return written;
        Stream->seekp(-1, std::ios::cur);  // the _ before the data
        *Stream << std::string(blocks * block, ' ') << "\n   _";
        AppendedDataPosition = Stream->tellp();
        return Stream->good() ? written : 0;
    }
};

void write_poly(const std::string& path, vtkPolyData& poly) {
    vtkNew<RoomBeforeData> writer;
    writer->SetInputData(&poly);
    writer->SetFileName(path.c_str());
    writer->SetDataModeToAppended();
    // Not raw: VTK 9.1 and ParaView 5.11 cannot read that with expat 2.6, or 2.5.0-1+deb12u2 of Debian 12
    // (gitlab.kitware.com/vtk/vtk/-/issues/19258; they read base64 behind some room). Not inline: that writer crashes on a full disk.
    writer->EncodeAppendedDataOn();
    // A full disk is told by the error code alone, with a page of text on standard error.
    const int warnings = vtkObject::GetGlobalWarningDisplay();
    vtkObject::GlobalWarningDisplayOff();
    const bool written = writer->Write() != 0 && writer->GetErrorCode() == vtkErrorCode::NoError;
    vtkObject::SetGlobalWarningDisplay(warnings);
    if (!written)
        throw SystemError(std::string("VTK cannot write: ") +
                          vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode()));
}

void write_piece(const std::string& path, VtkPiece& piece, const std::vector<PointData>& data, bool marks_ghosts) {
    const vtkNew<vtkPolyData> poly = poly_data(piece, data);
    Column<std::int64_t> offsets(piece.triangles.size() / 3 + 1);
    for (std::size_t i = 0; i < offsets.size(); ++i) offsets[i] = static_cast<std::int64_t>(3 * i);
    if (!piece.triangles.empty()) poly->SetPolys(cell_array(offsets, piece.triangles));
    vtkNew<vtkUnsignedCharArray> ghosts;
    if (marks_ghosts) {
        ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
        const auto count = static_cast<vtkIdType>(piece.points.size());
        ghosts->SetNumberOfTuples(count);
        for (vtkIdType k = 0; k < count; ++k)
            ghosts->SetValue(k, k < piece.own_points ? 0 : vtkDataSetAttributes::DUPLICATEPOINT);
        poly->GetPointData()->AddArray(ghosts);
    }
    write_poly(path, *poly);
}

}  // namespace

VtkPiece whole_of(const ClSurface& surface) {
    VtkPiece whole;
    whole.xyz = points_of(surface);
    whole.line_offsets.push_back(0);
    for (const Pass& pass : surface.passes) {
        if (pass.kind != PassKind::cut) continue;
        for (PointIndex i = pass.first; i <= pass.last; ++i) whole.line_points.push_back(i);
        whole.line_offsets.push_back(static_cast<std::int64_t>(whole.line_points.size()));
    }
    whole.triangles = triangles_of(surface);
    return whole;
}

VtkPiece piece_of(const SurfacePart& part) {
    VtkPiece piece;
    const auto is_own = [&](PointIndex k) { return k >= part.own.first && k <= part.own.last; };
    Column<std::int64_t> place(part.points.size(), std::int64_t{-1});  // of a point of the part in the piece
    const auto add = [&](std::int64_t k) {
        std::int64_t& at = place[static_cast<std::size_t>(k)];
        if (at >= 0) return;
        at = static_cast<std::int64_t>(piece.points.size());
        piece.points.push_back(part.points[static_cast<std::size_t>(k)]);
        const Vec3 p = part.surface.positions.absolute(k);
        for (int axis = 0; axis < 3; ++axis) piece.xyz.push_back(p[axis]);
    };
    for (std::int64_t k = 0; k < static_cast<std::int64_t>(part.points.size()); ++k) {
        if (is_own(k)) add(k);
    }
    piece.own_points = static_cast<PointIndex>(piece.points.size());
    piece.line_offsets.push_back(0);
    for (const Pass& pass : part.surface.passes) {
        if (pass.kind != PassKind::cut || !is_own(pass.first)) continue;
        for (PointIndex k = pass.first; k <= pass.last; ++k)
            piece.line_points.push_back(place[static_cast<std::size_t>(k)]);
        piece.line_offsets.push_back(static_cast<std::int64_t>(piece.line_points.size()));
    }
    // A triangle belongs to the piece of its first point.
    const Column<std::int64_t> triangles = triangles_of(part.surface);
    for (std::size_t t = 0; t < triangles.size(); t += 3) {
        const std::int64_t first = std::min({triangles[t], triangles[t + 1], triangles[t + 2]});
        if (!is_own(first)) continue;
        for (std::size_t corner = t; corner < t + 3; ++corner) {
            add(triangles[corner]);
            piece.triangles.push_back(place[static_cast<std::size_t>(triangles[corner])]);
        }
    }
    return piece;
}

void write_vtp(const std::string& path, VtkPiece piece, const std::vector<PointData>& data) {
    write_piece(path, piece, data, true);
}

void write_vtp(const std::string& path, const ClSurface& surface, const std::vector<PointData>& data) {
    VtkPiece whole = whole_of(surface);
    write_piece(path, whole, data, false);
}

}  // namespace clsurf::viz
