#pragma once
// The content of a SINUMERIK Edge recording, read in one pass over its JSON.
// Used inside io only.

#include <cstdint>
#include <string>
#include <vector>

#include "core/diagnostic.h"
#include "io/files/mapped_file.h"

namespace clsurf::io {

/// HFBlockEvent or HFCallEvent.
struct EdgeEvent {
    bool call = false;        ///< a program is called or returns; otherwise a block begins
    std::int64_t cycle = -1;  ///< HFProbeCounter; < 0: missing
    std::int64_t line = -1;   ///< SeekOffset; < 0: missing
    std::int64_t level = 0;   ///< CallStackLevel of a call
    std::string path;         ///< path of the program in a call
};

struct EdgeRecording {
    struct Signal {
        std::string name;  ///< "DES_POS|1"
        std::string axis;  ///< "X1"
    };
    std::vector<Signal> signals;
    std::vector<std::vector<double>> columns;  ///< one for each signal
    std::size_t rows = 0;
    std::vector<EdgeEvent> events;
    double cycle_ms = 0;      ///< CycleTimeMs; 0: not given
    std::string about;        ///< a JSON object: machine, start
    bool closed = true;       ///< false: the text ends in the middle
    Diagnostics diagnostics;  ///< log.ragged-row, log.unclosed
};

/// Throws InputError with line and column: not JSON, nested too deep, rows before their signals.
[[nodiscard]] EdgeRecording read_edge_recording(const Source& source);

}  // namespace clsurf::io
