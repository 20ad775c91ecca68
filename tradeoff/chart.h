// Charts of speed and size against accuracy: what was measured, as CSV and as one picture of panels.
#pragma once

#include <string>
#include <vector>

namespace cleft {

/// One measurement.
struct ChartPoint {
  std::string series;     ///< what is compared: "tip", "zfp", ...
  std::string setting;    ///< what made it: "tolerance 0.01"
  double x = 0, y = 0;    ///< in the units of the panel's axes
  bool standard = false;  ///< the setting that is taken where nobody says otherwise
};

/// A panel: one quantity against another. Less of both is better where a front is drawn.
struct Chart {
  std::string name;  ///< as in the CSV's first column
  std::string title;
  std::string x_label, y_label;  ///< with units
  bool log_x = true, log_y = true;
  bool front = true;  ///< mark the points that no other beats in both
  std::vector<ChartPoint> points = {};
};

/// The points that no other of the chart beats in one coordinate without losing in the other, by increasing
/// x; indices into points.
std::vector<std::size_t> pareto_front(const Chart& chart);

/// Columns chart,series,setting,x,x_label,y,y_label,standard,front: a row for each point.
std::string csv_of(const std::vector<Chart>& charts);

/// Draws all panels into picture.svg and picture.png through gnuplot. `stem`: the path without its ending;
/// `caption`: a line below the heading. Throws std::runtime_error where gnuplot is missing or fails.
void draw_charts(const std::vector<Chart>& charts, const std::string& stem, const std::string& heading,
                 const std::string& caption);

}  // namespace cleft
