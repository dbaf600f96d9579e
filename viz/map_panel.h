#pragma once
// MapPanel: what one map shows, and how the picture is to look.

#include <functional>
#include <string>
#include <vector>

#include "field/field.h"
#include "surface/cl_surface.h"
#include "viz/canvas.h"
#include "viz/defect_map.h"
#include "viz/detail.h"
#include "viz/field_classes.h"
#include "viz/relief.h"
#include "viz/view.h"

namespace clsurf::viz {

/// How the picture is to look: the options of `render`.
struct Look {
    int width = 1600, height = 1200;
    View view;
    Zoom zoom;
    Box3 box;  ///< empty: everything
    Style style = Style::surface;
    Rgb background{255, 255, 255};
    bool legend = true;
    bool scales = true;  ///< millimetres round the map; else a scale bar
    bool names = false;  ///< room for names, of defects or classes, in place of the colour scale
    std::string gl = "osmesa";
    int supersample = 2;
    bool keep_drawing = false;  ///< for SVG and PDF
};

/// A point to be ringed, or the points of a line to be drawn bold.
struct PointMark {
    PointIndex point = 0;
    std::string label;
};
struct LineMark {
    std::vector<PointRange> points;
    std::string label;
};

/// Lines on the surface under one label, the worst first: where labels would lie on each other,
/// the first stays.
struct OutlineMark {
    std::vector<std::vector<Vec3>> lines;  ///< corners [mm]
    std::string label;
};

/// One map: what one log shows.
struct MapPanel {
    const ClSurface* surface = nullptr;
    const Field* field = nullptr;
    std::string caption;  ///< "before", "after"; empty where there is one panel
    std::vector<PointMark> points;
    std::vector<LineMark> lines;
    std::vector<OutlineMark> outlines;
    /// Corners [mm] of lines that are drawn thinly, below all marks and below points and lines of the log; nullptr: none.
    const std::vector<std::vector<Vec3>>* programmed = nullptr;
    const DefectMap* defects = nullptr;     ///< the surface is then a grey relief below them, whatever the field
    const FieldClasses* classes = nullptr;  ///< of a field whose values are names
    const Relief* relief = nullptr;         ///< drawn in place of the surface; the field is then one of its vertices
    std::vector<PointRange> pale = {};      ///< points in a lighter tone, rising: ramps that all passes have
    std::function<Vec3(PointIndex)> place_of = {};  ///< where points and lines are marked [mm]; empty: on the surface
};

struct MapTexts {
    std::string title;               ///< "Path speed, commanded surface"
    std::string frame;               ///< of the coordinates: "G54"; may be empty
    std::string subtitle;            ///< program · log · counts
    std::vector<std::string> notes;  ///< window, range: one line where they fit, else one each
};

/// Whether a position lies in the picture and, where there is one, in the box.
[[nodiscard]] bool shows(const Camera& camera, const Look& look, const Vec3& p);

}  // namespace clsurf::viz
