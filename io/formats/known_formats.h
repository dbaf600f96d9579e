#pragma once
// The log formats that clsurf reads, each in its own file: those of log_formats.def.

#include "io/formats/log_format.h"

namespace clsurf::io {

#define LOG_FORMAT(name, source) extern const LogFormat name##_format;
#include "io/formats/log_formats.def"
#undef LOG_FORMAT

}  // namespace clsurf::io
