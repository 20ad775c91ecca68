// Charts of speed and size against accuracy, as CSV and as one picture with panels.
#pragma once

#include <string>
#include <vector>

namespace cleft {

/// One measurement.
struct ChartPoint {
  std::string series;     ///< what is compared: "tip", "zfp", ...
  std::string setting;    ///< its setting: "tolerance 0.01"
  double x = 0, y = 0;    ///< in the units of the panel's axes
  bool standard = false;  ///< whether this is the default setting
};

/// A panel: one quantity against another. If a front is drawn, less of both is better.
struct Chart {
  std::string name;  ///< as in the CSV's first column
  std::string title;
  std::string x_label, y_label;  ///< with units
  bool log_x = true, log_y = true;
  bool front = true;  ///< mark the Pareto front
  std::vector<ChartPoint> points = {};
};

/// The Pareto front: points that no other point dominates, by increasing x; indices into points.
std::vector<std::size_t> pareto_front(const Chart& chart);

/// Columns chart,series,setting,x,x_label,y,y_label,standard,front: a row for each point.
std::string csv_of(const std::vector<Chart>& charts);

/// Draws all panels into picture.svg and picture.png through gnuplot. `stem`: the path without its ending;
/// `caption`: a line below the heading. Throws std::runtime_error if gnuplot is missing or fails.
void draw_charts(const std::vector<Chart>& charts, const std::string& stem, const std::string& heading,
                 const std::string& caption);

}  // namespace cleft
