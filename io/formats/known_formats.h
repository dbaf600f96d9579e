#pragma once
// The log formats that clsurf reads, each in its own file. Listed in log_formats.cpp.

#include "io/formats/log_format.h"

namespace clsurf::io {

extern const LogFormat biip_format;           // biip.cpp
extern const LogFormat layout_format;         // record_layout.cpp
extern const LogFormat halsampler_format;     // delimited.cpp
extern const LogFormat halscope_format;       // halscope.cpp
extern const LogFormat twincat_format;        // twincat_csv.cpp
extern const LogFormat edge_format;           // edge_json.cpp
extern const LogFormat sinumerik_xml_format;  // sinumerik_xml.cpp
extern const LogFormat delimited_format;      // delimited.cpp

}  // namespace clsurf::io
