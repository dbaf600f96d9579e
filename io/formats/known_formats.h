#pragma once
// The log formats that clsurf reads, one file each, listed in log_formats.def.

#include "io/formats/log_format.h"

namespace clsurf::io {

#define LOG_FORMAT(name, source) extern const LogFormat name##_format;
#include "io/formats/log_formats.def"
#undef LOG_FORMAT

}  // namespace clsurf::io
