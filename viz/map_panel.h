#pragma once
// MapPanel: the content of a map, and the look of the picture.

#include <functional>
#include <string>
#include <vector>

#include "field/field.h"
#include "surface/cl_surface.h"
#include "viz/canvas.h"
#include "viz/defect_map.h"
#include "viz/detail.h"
#include "viz/field_classes.h"
#include "viz/height_map.h"
#include "viz/view.h"

namespace clsurf::viz {

/// The look of the picture: the options of `render`.
struct Look {
    int width = 1600, height = 1200;
    View view;
    Zoom zoom;
    Box3 box;  ///< empty: everything
    Style style = Style::surface;
    Rgb background{255, 255, 255};
    bool legend = true;
    bool scales = true;  ///< millimetres around the map; otherwise a scale bar
    bool names = false;  ///< room for names of defects or classes instead of the colour scale
    std::string gl = "osmesa";
    int supersample = 2;
    bool keep_drawing = false;  ///< for SVG and PDF
};

/// A point to mark with a ring, or the points of a line to draw bold.
struct PointMark {
    PointIndex point = 0;
    std::string label;
};
struct LineMark {
    std::vector<PointRange> points;
    std::string label;
};

/// Lines on the surface with one label, the worst first: of overlapping labels
/// the first one is kept.
struct OutlineMark {
    std::vector<std::vector<Vec3>> lines;  ///< corners [mm]
    std::string label;
};

/// One map: the view of one log.
struct MapPanel {
    const ClSurface* surface = nullptr;
    const Field* field = nullptr;
    std::string caption;  ///< "before", "after"; empty if there is one panel
    std::vector<PointMark> points;
    std::vector<LineMark> lines;
    std::vector<OutlineMark> outlines;
    /// Corners [mm] of lines that are drawn thinly, below all marks and below points and lines of the log; nullptr: none.
    const std::vector<std::vector<Vec3>>* programmed = nullptr;
    const DefectMap* defects = nullptr;     ///< drawn over the surface in grey, for any field
    const FieldClasses* classes = nullptr;  ///< classes of a field whose values are names
    const HeightMap* height_map = nullptr;  ///< drawn instead of the surface; the field then has one value per vertex
    std::vector<PointRange> pale = {};      ///< points in a lighter tone, increasing: ramps that all passes have
    std::function<Vec3(PointIndex)> place_of = {};  ///< position of marked points and lines [mm]; empty: on the surface
};

struct MapTexts {
    std::string title;               ///< "Path speed, commanded surface"
    std::string frame;               ///< name of the coordinates: "G54"; may be empty
    std::string subtitle;            ///< program · log · counts
    std::vector<std::string> notes;  ///< window, range: in one line if they fit, otherwise one line each
};

/// Whether a position is inside the picture and, if there is one, the box.
[[nodiscard]] bool shows(const Camera& camera, const Look& look, const Vec3& p);

}  // namespace clsurf::viz
