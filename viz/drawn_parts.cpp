#include "viz/drawn_parts.h"

#include <span>
#include <utility>

#include "viz/byte_reader.h"

namespace clsurf::viz {

void DrawnParts::add(const DrawnParts& later) {
    samples.add(later.samples);
    depth.add(later.depth);
    beyond.widen(later.beyond);
}

std::string DrawnParts::bytes() const {
    std::string bytes = samples.bytes();
    append_bytes(bytes, depth.cells());
    for (const bool flag : {beyond.below, beyond.above, beyond.missing}) bytes += flag ? '\1' : '\0';
    return bytes;
}

std::optional<DrawnParts> DrawnParts::read(std::string_view bytes, const Camera& camera) {
    std::optional<MeshSamples> samples = MeshSamples::read(bytes);
    DrawnParts parts{samples ? std::move(*samples) : MeshSamples(), DepthBuffer(camera), {}};
    std::array<char, 3> flags{};
    if (!samples || !take_bytes(bytes, parts.depth.cells()) || !take_bytes(bytes, std::span(flags)) || !bytes.empty())
        return std::nullopt;
    parts.beyond = {flags[0] != 0, flags[1] != 0, flags[2] != 0};
    return parts;
}

}  // namespace clsurf::viz
