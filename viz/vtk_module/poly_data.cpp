#include "viz/vtk_module/vtk_files.h"

#include <string>

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

namespace clsurf::viz::vtk_module {
namespace {

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

/// Calls act(column) with the column in its own type.
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

/// `lines` borrow from `piece`, which is therefore not const.
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

/// Adds blanks between the head of a file and its data. VTK 9.1 and ParaView 5.11 read blocks of 4096 bytes until the parser
/// reports the element AppendedData. Expat 2.6, and 2.5.0-1+deb12u2 of Debian 12, report it only after another block,
/// which may then contain nothing but blanks: for the parser the document has ended.
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
    // (gitlab.kitware.com/vtk/vtk/-/issues/19258; they read base64 after some blanks). Not inline: that writer crashes on a
    // full disk.
    writer->EncodeAppendedDataOn();
    // VTK reports a full disk only by its error code, and prints a page of text to standard error.
    const int warnings = vtkObject::GetGlobalWarningDisplay();
    vtkObject::GlobalWarningDisplayOff();
    const bool written = writer->Write() != 0 && writer->GetErrorCode() == vtkErrorCode::NoError;
    vtkObject::SetGlobalWarningDisplay(warnings);
    if (!written)
        throw SystemError(std::string("VTK cannot write: ") +
                          vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode()));
}

}  // namespace

void write_vtp(const std::string& path, VtkPiece& piece, const std::vector<PointData>& data, bool marks_ghosts) {
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

}  // namespace clsurf::viz::vtk_module
