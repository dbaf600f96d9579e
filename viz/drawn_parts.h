#pragma once
// DrawnParts: the drawn parts of a map whose surface was in memory in parts (scene.h).

#include <optional>
#include <string>
#include <string_view>

#include "viz/beyond.h"
#include "viz/depth_buffer.h"
#include "viz/mesh_samples.h"

namespace clsurf::viz {

struct DrawnParts {
    MeshSamples samples;
    DepthBuffer depth;  ///< for hiding the edges of the box
    Beyond beyond;

    /// Adds parts that are later on the path. Domain: the same map, in a picture of the same size.
    void add(const DrawnParts& later);

    /// The input of read().
    [[nodiscard]] std::string bytes() const;
    /// For a picture with that camera. Nothing: incomplete or wrong bytes.
    [[nodiscard]] static std::optional<DrawnParts> read(std::string_view bytes, const Camera& camera);
};

}  // namespace clsurf::viz
