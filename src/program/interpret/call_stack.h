#pragma once
// CallStack: the active calls, loops and repeated sections, and where each continues. ReadingPlace: the current line.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/point.h"
#include "program/interpret/modal_state.h"
#include "program/text/control.h"

namespace clsurf {

/// An active call: where the caller continues.
struct CallFrame {
    std::size_t file = 0;
    LineNumber line = 0;         ///< the calling line
    std::size_t start_file = 0;  ///< of the subprogram, for repeats
    LineNumber start_line = 0;
    std::uint32_t call = 0;                 ///< the call active before this one: index into Motions::calls, from 1
    int repeats = 0;                        ///< repeats that remain after this one
    bool locals = false;                    ///< a set of local variables was pushed
    std::map<LineNumber, double> counters;  ///< counters of the caller's repeat and for loops
};

/// Lines that Siemens' REPEAT executes again.
struct Section {
    LineNumber begin = 0, end = 0;
    double left = 0;        ///< remaining repetitions
    std::size_t level = 0;  ///< of calls
    LineNumber back = 0;    ///< the line of REPEAT
};

/// Fanuc's G66 and Siemens' MCALL: called after every block that moves, at the call level at which it was programmed.
struct ModalCall {
    bool active = false;
    std::string name;
    int repeats = 1;
    std::vector<double> arguments;  ///< NaN: not given
    std::size_t level = 0;          ///< of calls
    std::size_t column = 0;
};

struct CallStack {
    std::vector<CallFrame> frames;
    std::vector<Section> sections;
    LineNumber behind_section = 0;  ///< the line before which to stop; 0: none
    std::uint32_t running = 0;      ///< index into Motions::calls, from 1; 0: the main program
    std::map<std::array<std::uint32_t, 3>, std::uint32_t> known;  ///< by caller, file and line
    std::vector<std::optional<ModalState>> kept_modes{1};         ///< by level: modes saved by M70 and M73
    std::vector<bool> restores_modes{false};                      ///< M73: modes are restored on return
    std::map<LineNumber, double> counters;                        ///< counters of the active loops
    std::uint64_t jumps = 0;
};

/// Results of analysing the texts, by file.
struct KnownTexts {
    std::vector<ControlIndex> indexes;
    std::vector<bool> indexed;
    std::map<std::string, std::size_t> loaded;    ///< files of subprograms, by the name they were called by
    std::map<std::size_t, BlockNumbers> numbers;  ///< block numbers of files in which a jump went to one
};

struct ReadingPlace {
    std::size_t file = 0;
    LineNumber line = 0;  ///< of the current block
    LineNumber next_line = 1;
    std::size_t next_byte = 0;
    std::string_view text;  ///< of the current line
};

}  // namespace clsurf
