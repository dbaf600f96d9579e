// Exported files are read back with VTK's own readers.
#include "viz/export_vtk.h"

#include "viz/vtkhdf.h"

#include <vtkHDFReader.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkTriangle.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>

#include <gtest/gtest.h>

#include "support/made_path.h"
#include "support/temporary_folder.h"

namespace clsurf::viz::export_vtk_test {
namespace {

/// Stitched passes of a zigzag: three by default.
struct Made {
    ClSurface surface;
    Column<float> values;
    explicit Made(Positions positions = test::zigzag(3, 10, 0.4, 0.1)) {
        surface.positions = std::move(positions);
        surface.positions.origin = Vec3(100, 0, 0);
        surface.step_over = 0.4;
        const ArcLength arc_length(surface.positions);
        surface.passes = find_passes(surface.positions, arc_length, test::one_run(surface.positions), 0.4);
        surface.neighbours = find_neighbours(surface.positions, surface.passes, arc_length, 0.4);
        for (PointIndex i = 0; i < surface.positions.size(); ++i) values.push_back(static_cast<float>(i));
    }
};

vtkSmartPointer<vtkPolyData> read_vtp(const std::string& path) {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    return reader->GetOutput();
}

TEST(ExportVtk, VtpHoldsPointsPassesTrianglesAndColumns) {
    const Made made;
    const test::TemporaryFolder folder;
    const std::string path = folder / "a.vtp";
    write_vtp(path, made.surface, {{"speed", &made.values}});
    const vtkSmartPointer<vtkPolyData> read = read_vtp(path);
    EXPECT_EQ(read->GetNumberOfPoints(), made.surface.positions.size());
    EXPECT_EQ(read->GetNumberOfLines(), 3);
    EXPECT_GT(read->GetNumberOfPolys(), 300);
    EXPECT_EQ(read->GetPoint(0)[0], 100.0);
    EXPECT_EQ(read->GetPointData()->GetArray("speed")->GetTuple1(17), 17.0);
}

TEST(ExportVtk, AMissingPassStaysOpen) {
    // Two zigzags of 10 × 2 mm, which together lack a seventh pass.
    Positions positions = test::zigzag(6, 10, 0.4, 0.02);
    const Positions other = test::zigzag(6, 10, 0.4, 0.02);
    for (PointIndex i = 0; i < other.size(); ++i) test::add(positions, other[i].x(), other[i].y() + 2.8, 0);
    const Made made(std::move(positions));
    const test::TemporaryFolder folder;
    const std::string path = folder / "a.vtp";
    write_vtp(path, made.surface, {{"speed", &made.values}});
    const vtkSmartPointer<vtkPolyData> read = read_vtp(path);
    double area = 0;
    for (vtkIdType k = 0; k < read->GetNumberOfCells(); ++k) {
        vtkCell* cell = read->GetCell(k);
        if (auto* triangle = vtkTriangle::SafeDownCast(cell)) area += triangle->ComputeArea();
    }
    EXPECT_NEAR(area, 40, 0.2);
}

TEST(ExportVtk, VtkHdfHoldsTheSame) {
    const Made made;
    const test::TemporaryFolder folder;
    const std::string path = folder / "a.vtkhdf";
    write_vtkhdf(path, made.surface, {{"speed", &made.values}});
    vtkNew<vtkHDFReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    auto* read = vtkUnstructuredGrid::SafeDownCast(reader->GetOutputDataObject(0));
    ASSERT_NE(read, nullptr);
    EXPECT_EQ(read->GetNumberOfPoints(), made.surface.positions.size());
    EXPECT_GT(read->GetNumberOfCells(), 303);
    EXPECT_EQ(read->GetCellType(0), 4);  // a polyline
    EXPECT_EQ(read->GetPointData()->GetArray("speed")->GetTuple1(17), 17.0);
}

/// Numbers that 32-bit floats would round to 16,777,216 and 20,000,000.
struct LargeNumbers {
    Column<std::uint32_t> lines;
    Column<double> times;
    explicit LargeNumbers(PointIndex points)
        : lines(static_cast<std::size_t>(points), 16777217U), times(static_cast<std::size_t>(points), 20000000.001) {}
    [[nodiscard]] std::vector<PointData> data() const { return {{"line", &lines}, {"time", &times}}; }
};

void expect_large_numbers(vtkPointData* data) {
    ASSERT_NE(data->GetArray("line"), nullptr);
    EXPECT_EQ(data->GetArray("line")->GetDataTypeSize(), 4);
    EXPECT_EQ(data->GetArray("line")->GetDataType(), VTK_UNSIGNED_INT);
    EXPECT_EQ(data->GetArray("line")->GetTuple1(5), 16777217.0);
    EXPECT_EQ(data->GetArray("time")->GetDataType(), VTK_DOUBLE);
    EXPECT_EQ(data->GetArray("time")->GetTuple1(5), 20000000.001);
}

TEST(ExportVtk, NumbersOfLinesAndTimesAreNotRounded) {
    const Made made;
    const LargeNumbers large(made.surface.positions.size());
    const test::TemporaryFolder folder;
    const std::string path = folder / "a.vtp";
    write_vtp(path, made.surface, large.data());
    expect_large_numbers(read_vtp(path)->GetPointData());
    const std::string hdf = folder / "a.vtkhdf";
    write_vtkhdf(hdf, made.surface, large.data());
    vtkNew<vtkHDFReader> reader;
    reader->SetFileName(hdf.c_str());
    reader->Update();
    auto* read = vtkUnstructuredGrid::SafeDownCast(reader->GetOutputDataObject(0));
    ASSERT_NE(read, nullptr);
    expect_large_numbers(read->GetPointData());
}

}  // namespace
}  // namespace clsurf::viz::export_vtk_test
