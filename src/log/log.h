#pragma once
// Log: the record of a controller, one row per interpolation period, as views on the raw data. A Log owns its storage
// without knowing files: `keep_alive` is a mapping or vectors.

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/channel_view.h"
#include "core/diagnostic.h"
#include "core/geometry.h"
#include "core/point.h"

namespace clsurf {

/// The three kinds of recorded positions: set points of the interpolator, feedback of the motor encoder, measurement
/// of the linear or ring scale.
enum class Role : std::uint8_t { commanded, feedback, actual };

[[nodiscard]] std::string_view name_of(Role role);    ///< "commanded", …
[[nodiscard]] std::string_view prefix_of(Role role);  ///< "cmd", "fb", "act"

struct Channel {
    std::string name;  ///< "cmd.x", "line", …: docs/formats/biip.md
    std::string unit;  ///< UTF-8; from log/channel.h if the name is known
    ChannelView values;
};

struct ProgramReference {
    std::string name;
    std::string sha256;                 ///< 64 hexadecimal digits; empty: not recorded
    std::optional<std::uint64_t> size;  ///< [bytes]
    std::string sha256_lf = {};         ///< with all line ends LF; empty: same as sha256, or not recorded
};

struct Log {
    std::string name;    ///< the file, as the user named it
    std::string format;  ///< "biip", "layout", "csv", "halsampler"
    PointIndex records = 0;
    double period = 0;   ///< [s], > 0
    bool closed = true;  ///< false: the writer was stopped before it finished
    std::vector<Channel> channels;
    std::vector<ProgramReference> programs;
    std::string metadata;             ///< the JSON text of the file; empty: none
    double work_rotation = 0;         ///< of the work system about Z [deg], with work_offset
    std::optional<Vec3> work_offset;  ///< [mm], machine = workpiece + offset, if the log gives it
    Diagnostics diagnostics;
    std::shared_ptr<const void> keep_alive;

    /// The channel of that name, or nullptr.
    [[nodiscard]] const Channel* find(std::string_view channel) const;
    /// Whether all three linear axes of the role exist; or X and Z, if no role has a Y (a lathe).
    [[nodiscard]] bool has(Role role) const;
    /// Time of a point since the first record [s]: the channel `time`, or index · period.
    [[nodiscard]] double time_of(PointIndex point) const;
    /// The median positive step of the channel `time` over the first 10^4 records [s]; 0: unknown.
    [[nodiscard]] double measured_period() const;
};

}  // namespace clsurf
