#pragma once
// MeshPainter: draws the samples of a mesh that is in memory in parts.

#include <memory>
#include <string>

#include "viz/mesh_panel.h"
#include "viz/mesh_samples.h"

namespace clsurf::viz {

/// Draws the mesh of a panel in parts, one in memory at a time. Together they give the same samples as the whole mesh.
class MeshPainter {
public:
    MeshPainter() = default;
    MeshPainter(const MeshPainter&) = delete;
    MeshPainter& operator=(const MeshPainter&) = delete;
    virtual ~MeshPainter() = default;

    /// Adds the next part to samples with the size of empty(). Throws SystemError.
    virtual void draw(const MeshPanel& part, MeshSamples& samples) = 0;
    [[nodiscard]] virtual MeshSamples empty() const = 0;
};

/// For the panels of a sheet of that size [px]. Throws SystemError.
[[nodiscard]] std::unique_ptr<MeshPainter> make_mesh_painter(int width, int height, const std::string& gl,
                                                             int supersample);

}  // namespace clsurf::viz
