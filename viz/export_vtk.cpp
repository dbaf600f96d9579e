#include "viz/export_vtk.h"

#include <algorithm>
#include <utility>

#include <hdf5.h>
#include <vtkCellArray.h>
#include <vtkCellType.h>
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

struct CellColumns {
    Column<std::int64_t> line_offsets, line_points;  ///< polylines of the passes
    Column<std::int64_t> triangles;                  ///< 3 points each
};

/// Every point of every pass, and the bands between adjacent passes as they are drawn, over all points.
CellColumns cells_of(const ClSurface& surface) {
    CellColumns cells;
    cells.line_offsets.push_back(0);
    for (const Pass& pass : surface.passes) {
        if (pass.kind != PassKind::cut) continue;
        for (PointIndex i = pass.first; i <= pass.last; ++i) cells.line_points.push_back(i);
        cells.line_offsets.push_back(static_cast<std::int64_t>(cells.line_points.size()));
    }
    cells.triangles = triangles_of(surface);
    return cells;
}

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

/// The type of a column of T in memory and in files.
template <typename T>
struct Stored;
template <>
struct Stored<float> {
    using Array = vtkFloatArray;
    static hid_t hdf() { return H5T_NATIVE_FLOAT; }
};
template <>
struct Stored<double> {
    using Array = vtkDoubleArray;
    static hid_t hdf() { return H5T_NATIVE_DOUBLE; }
};
template <>
struct Stored<std::uint32_t> {
    using Array = vtkTypeUInt32Array;
    static hid_t hdf() { return H5T_NATIVE_UINT32; }
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

/// An HDF5 object that closes itself.
class H5 {
public:
    H5(hid_t id, herr_t (*close)(hid_t), const char* what) : id_(id), close_(close) {
        if (id < 0) throw SystemError(std::string("HDF5 cannot write: ") + what);
    }
    H5(const H5&) = delete;
    H5& operator=(const H5&) = delete;
    ~H5() { close_(id_); }
    [[nodiscard]] hid_t id() const { return id_; }

private:
    hid_t id_;
    herr_t (*close_)(hid_t);
};

void put(hid_t group, const char* name, hid_t type, std::vector<hsize_t> size, const void* values) {
    const H5 space(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), H5Sclose, name);
    // Without the time of day: the same export is the same file.
    const H5 how(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, name);
    if (H5Pset_obj_track_times(how.id(), false) < 0) throw SystemError(std::string("HDF5 cannot write ") + name);
    const H5 set(H5Dcreate2(group, name, type, space.id(), H5P_DEFAULT, how.id(), H5P_DEFAULT), H5Dclose, name);
    if (H5Dwrite(set.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
        throw SystemError(std::string("HDF5 cannot write ") + name);
}

void put_header(hid_t group) {
    const hsize_t two = 2;
    const H5 space(H5Screate_simple(1, &two, nullptr), H5Sclose, "Version");
    const H5 version(H5Acreate2(group, "Version", H5T_NATIVE_INT64, space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                     "Version");
    const std::int64_t number[2] = {1, 0};
    const H5 scalar(H5Screate(H5S_SCALAR), H5Sclose, "Type");
    const H5 text(H5Tcopy(H5T_C_S1), H5Tclose, "Type");
    const char type[] = "UnstructuredGrid";
    H5Tset_size(text.id(), sizeof type - 1);
    const H5 kind(H5Acreate2(group, "Type", text.id(), scalar.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose, "Type");
    if (H5Awrite(version.id(), H5T_NATIVE_INT64, number) < 0 || H5Awrite(kind.id(), text.id(), type) < 0)
        throw SystemError("HDF5 cannot write attributes");
}

}  // namespace

namespace {

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
        throw SystemError(path + ": cannot write: " + vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode()));
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

VtkPiece piece_of(const SurfacePart& part, const PointRange& own) {
    VtkPiece piece;
    const auto is_own = [&](PointIndex point) { return point >= own.first && point <= own.last; };
    const auto global = [&](std::int64_t k) { return part.points[static_cast<std::size_t>(k)]; };
    Column<std::int64_t> place(part.points.size(), std::int64_t{-1});  // of a point of the part in the piece
    const auto add = [&](std::int64_t k) {
        std::int64_t& at = place[static_cast<std::size_t>(k)];
        if (at >= 0) return;
        at = static_cast<std::int64_t>(piece.points.size());
        piece.points.push_back(global(k));
        const Vec3 p = part.surface.positions.absolute(k);
        for (int axis = 0; axis < 3; ++axis) piece.xyz.push_back(p[axis]);
    };
    for (std::int64_t k = 0; k < static_cast<std::int64_t>(part.points.size()); ++k) {
        if (is_own(global(k))) add(k);
    }
    piece.own_points = static_cast<PointIndex>(piece.points.size());
    piece.line_offsets.push_back(0);
    for (const Pass& pass : part.surface.passes) {
        if (pass.kind != PassKind::cut || !is_own(global(pass.first))) continue;
        for (PointIndex k = pass.first; k <= pass.last; ++k)
            piece.line_points.push_back(place[static_cast<std::size_t>(k)]);
        piece.line_offsets.push_back(static_cast<std::int64_t>(piece.line_points.size()));
    }
    // A triangle belongs to the piece of its first point.
    const Column<std::int64_t> triangles = triangles_of(part.surface);
    for (std::size_t t = 0; t < triangles.size(); t += 3) {
        const std::int64_t first = std::min({triangles[t], triangles[t + 1], triangles[t + 2]});
        if (!is_own(global(first))) continue;
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
    CellColumns cells = cells_of(surface);
    VtkPiece whole;
    whole.xyz = points_of(surface);
    whole.line_offsets = std::move(cells.line_offsets);
    whole.line_points = std::move(cells.line_points);
    whole.triangles = std::move(cells.triangles);
    write_piece(path, whole, data, false);
}

void write_vtkhdf(const std::string& path, const ClSurface& surface, const std::vector<PointData>& data) {
    const Column<double> xyz = points_of(surface);
    const CellColumns cells = cells_of(surface);
    Column<std::int64_t> connectivity = cells.line_points;
    Column<std::int64_t> offsets = cells.line_offsets;
    Column<std::uint8_t> types(cells.line_offsets.size() - 1, VTK_POLY_LINE);
    for (std::size_t t = 0; t < cells.triangles.size(); ++t) {
        connectivity.push_back(cells.triangles[t]);
        if (t % 3 != 2) continue;
        offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
        types.push_back(VTK_TRIANGLE);
    }
    // What fails is said once, by us; and the default driver asks for the real path of links, which the
    // nameless file of an io::AtomicFile does not have.
    H5dont_atexit();  // what could not be closed on a full disk would be closed once more, and crash
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    const H5 access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "access");
    H5Pset_fapl_stdio(access.id());
    const H5 file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), H5Fclose, path.c_str());
    const H5 root(H5Gcreate2(file.id(), "VTKHDF", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, "VTKHDF");
    put_header(root.id());
    const auto count = [](std::size_t n) { return static_cast<std::int64_t>(n); };
    const std::int64_t point_count = surface.positions.size();
    const std::int64_t cell_count = count(types.size());
    const std::int64_t id_count = count(connectivity.size());
    put(root.id(), "NumberOfPoints", H5T_NATIVE_INT64, {1}, &point_count);
    put(root.id(), "NumberOfCells", H5T_NATIVE_INT64, {1}, &cell_count);
    put(root.id(), "NumberOfConnectivityIds", H5T_NATIVE_INT64, {1}, &id_count);
    put(root.id(), "Points", H5T_NATIVE_DOUBLE, {static_cast<hsize_t>(point_count), 3}, xyz.data());
    put(root.id(), "Connectivity", H5T_NATIVE_INT64, {connectivity.size()}, connectivity.data());
    put(root.id(), "Offsets", H5T_NATIVE_INT64, {offsets.size()}, offsets.data());
    put(root.id(), "Types", H5T_NATIVE_UINT8, {types.size()}, types.data());
    const H5 point_data(H5Gcreate2(root.id(), "PointData", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
                        "PointData");
    for (const PointData& column : data) {
        with_column(column, [&]<typename T>(const Column<T>& values) {
            put(point_data.id(), column.name.c_str(), Stored<T>::hdf(), {values.size()}, values.data());
        });
    }
    // Closing writes too, and nobody hears of what it could not.
    if (H5Fflush(file.id(), H5F_SCOPE_LOCAL) < 0) throw SystemError("HDF5 cannot write: the disk is full?");
}

}  // namespace clsurf::viz
