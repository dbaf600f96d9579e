#pragma once
// DrawnParts: what was drawn of a map whose surface was in memory in parts (scene.h).

#include <optional>
#include <string>
#include <string_view>

#include "viz/beyond.h"
#include "viz/depth_buffer.h"
#include "viz/mesh_samples.h"

namespace clsurf::viz {

struct DrawnParts {
    MeshSamples samples;
    DepthBuffer depth;  ///< of what hides the edges of the box
    Beyond beyond;

    /// Parts that come after these on the path. Domain: of the same map, in a picture of the same size.
    void add(const DrawnParts& later);

    /// What read() takes.
    [[nodiscard]] std::string bytes() const;
    /// Of a picture with that camera. Nothing: these are not all of its bytes.
    [[nodiscard]] static std::optional<DrawnParts> read(std::string_view bytes, const Camera& camera);
};

}  // namespace clsurf::viz
