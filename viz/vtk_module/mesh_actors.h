#pragma once
// Mesh actors: VTK actors for the mesh of a panel.

#include <optional>

#include <vtkRenderer.h>

#include "viz/mesh_panel.h"
#include "viz/mesh_samples.h"

namespace clsurf::viz::vtk_module {

/// Adds the cells of a panel, of one kind or all. The panel must outlive them. Returns whether there are any.
bool add_mesh(vtkRenderer* renderer, const MeshPanel& panel, int supersample, std::optional<CellKind> only = {});

/// Shows a panel in its rectangle of a picture of that size [px].
void place(vtkRenderer* renderer, const MeshPanel& panel, double width, double height);

}  // namespace clsurf::viz::vtk_module
