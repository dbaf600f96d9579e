#pragma once
// MeshPainter: the samples of a mesh that is in memory in parts.

#include <memory>
#include <string>

#include "viz/mesh_panel.h"
#include "viz/mesh_samples.h"

namespace clsurf::viz {

/// Draws the mesh of a panel in parts, which are in memory one at a time. All parts give the same samples as the whole mesh.
class MeshPainter {
public:
    /// For the panels of a sheet of that size. Throws SystemError.
    MeshPainter(int width, int height, const std::string& gl, int supersample);
    MeshPainter(const MeshPainter&) = delete;
    MeshPainter& operator=(const MeshPainter&) = delete;
    ~MeshPainter();

    /// Adds the next part to samples of the size that empty() has. Throws SystemError.
    void draw(const MeshPanel& part, MeshSamples& samples);
    [[nodiscard]] MeshSamples empty() const;

private:
    class Window;
    std::unique_ptr<Window> window_;
};

}  // namespace clsurf::viz
