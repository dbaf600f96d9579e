#pragma once
// The CL surface with its columns for ParaView and VTK: .vtp (XML PolyData) and .vtkhdf
// (UnstructuredGrid, VTKHDF 1.0). Passes are polylines, gaps between them triangles.

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "core/column.h"
#include "surface/cl_surface.h"

namespace clsurf::viz {

/// A column of point data, written in its own type: numbers of lines and points need more than the 24 bits of a float.
/// Not copied.
struct PointData {
    std::string name;
    std::variant<const Column<float>*, const Column<double>*, const Column<std::uint32_t>*> values;
};

/// Writes into the file at `path` (an io::AtomicFile's temporary one). Throws SystemError.
void write_vtp(const std::string& path, const ClSurface& surface, const std::vector<PointData>& data);
void write_vtkhdf(const std::string& path, const ClSurface& surface, const std::vector<PointData>& data);

}  // namespace clsurf::viz
